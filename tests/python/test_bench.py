"""The virtual bench: each test has a figure, numbers and a sentence, and measures known values."""

import re
from math import log10

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.bench import TESTS, bench, scene_file
from bevel_differential.bench.step_response import Actuator
from bevel_differential.scene_file import read_toml
from bevel_differential.values import DifferentialError
from command_line import command
from PIL import Image
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator

PRELOAD, RATIO, COLD = 60.0, 1.3, 1.5
# gears without teeth, and only friction of the packs
PLAIN = {"scene.gear_contact": "ideal", "effects.tooth_friction": False, "effects.thrust_friction": False, "limited_slip.preload": PRELOAD,
         "limited_slip.torque_coefficient": 0.0, "limited_slip.static_ratio": RATIO, "limited_slip.stribeck_speed": 0.0,
         "limited_slip.cold_factor": COLD, "limited_slip.hot_factor": 1.0}


def table(file):
    return np.genfromtxt(file, delimiter=",", names=True, deletechars="")


def numbers(text):
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


@pytest.mark.parametrize("name", sorted({of for _, of in TESTS.values()}))
def test_scenes_set_only_values_that_have_an_effect(name, fmu_file):
    file = scene_file(next(test for test, (_, of) in TESTS.items() if of == name))
    assert read_toml(file)["description"]
    with Scene.load(file, fmu=fmu_file) as scene:
        assert scene.unfelt_of() == {}


def test_bias_is_that_of_the_packs(fmu_file, tmp_path):
    says = bench("bias", tmp_path, values=PLAIN, fmu=fmu_file, workers=0)
    rows = table(tmp_path / "bias.csv")
    assert len(rows) == 6 * 3 * 2
    for torque, difference, temperature, left, right, ratio, effect in rows.tolist():
        # 40 °C is three fifths of the interval from -20 to 80 °C
        clutch = PRELOAD * (1.0 + (COLD - 1.0) * max(0.0, (353.15 - temperature) / 100.0))
        shift = np.sign(difference) * clutch
        assert [left, right] == pytest.approx([torque / 2.0 - shift, torque / 2.0 + shift], rel=1e-4)
        assert ratio == pytest.approx((torque / 2.0 + clutch) / (torque / 2.0 - clutch), rel=1e-3)
        assert effect == pytest.approx(200.0 * clutch / torque, rel=1e-3)
    assert numbers(says)[:2] == [round(value, 2) for value in (rows["torque_bias_ratio_[1]"][rows["carrier.torque_[N.m]"] < 251.0].min(),
                                                               rows["torque_bias_ratio_[1]"].max())]


def test_a_bias_in_proportion_to_the_torque_does_not_fall(fmu_file, tmp_path):
    only = {"scene.gear_contact": "lumped", "limited_slip.preload": 0.0, "limited_slip.torque_coefficient": 0.2, "limited_slip.cold_factor": 1.0}
    says = bench("bias", tmp_path, values=PLAIN | only, fmu=fmu_file, workers=0)
    # (1 + 0.2)/(1 − 0.2)
    assert says.startswith("TBR is 1.50 at ") and " and 1.50 at " in says and "friction that grows with the torque determines it" in says


def test_breakaway_is_reported_separately_from_bias(fmu_file, tmp_path):
    says = bench("breakaway", tmp_path, values=PLAIN, fmu=fmu_file, workers=0)
    for torque, direction, temperature, left, _, _, effect in table(tmp_path / "breakaway.csv").tolist():
        clutch = RATIO * PRELOAD * (1.0 + (COLD - 1.0) * max(0.0, (353.15 - temperature) / 100.0))
        assert left == pytest.approx(torque / 2.0 - direction * clutch, abs=0.1) and effect == pytest.approx(200.0 * clutch / torque, abs=0.1)
    assert "1.30 to 1.30 times" in says


@pytest.mark.parametrize("preload", [0.0, 15.0])
def test_ramps_shift_their_fraction_of_the_carrier_torque(fmu_file, tmp_path, preload):
    says = bench("ramps", tmp_path, values={"limited_slip.preload": preload}, fmu=fmu_file, workers=0)
    rows = table(tmp_path / "ramps.csv")
    assert sorted(set(rows["coast_ratio_[1]"])) == [0.0, 0.25, 1.0] and len(rows) == 3 * 39
    for coast, torque, left, right, difference, ratio, effect in rows.tolist():
        clutch = preload + 0.4 * (coast if torque < 0.0 else 1.0) * abs(torque) / 2.0
        # the left wheel is the faster one, so the packs take torque from it
        assert [left, right] == pytest.approx([torque / 2.0 - clutch, torque / 2.0 + clutch], rel=1e-6, abs=0.05 if torque == 0.0 else 1e-6)
        assert difference == pytest.approx(right - left, abs=1e-9)
        if left * right > 0.0:
            assert ratio == pytest.approx((abs(torque) / 2.0 + clutch) / (abs(torque) / 2.0 - clutch), rel=1e-6)
            assert effect == pytest.approx(200.0 * clutch / abs(torque), rel=1e-6, abs=1e-6)
    assert ("preload remains" in says) == (preload > 0.0)
    # at 1600 N·m: 0.4 T, and of it a quarter in coast
    shares = [0.4, 0.4, 0.1, 0.0]
    assert [numbers(says)[1], *numbers(says)[2:8:2]] == pytest.approx([share * 1600.0 + 2.0 * preload for share in shares], abs=1e-2)


def test_ramps_of_both_sides_shift_the_same_torque_while_both_meshes_have_the_same(fmu_file, tmp_path):
    # without friction of the gears, both side gears have half the torque of the carrier
    for name in ("own_side", "both_sides"):
        (tmp_path / name).mkdir()
        bench("ramps", tmp_path / name, values={"limited_slip.pressed_by": name}, fmu=fmu_file, workers=0)
    own, both = (table(tmp_path / name / "ramps.csv") for name in ("own_side", "both_sides"))
    assert both["torque_difference_[N.m]"] == pytest.approx(own["torque_difference_[N.m]"], rel=1e-6, abs=0.05)


# viscous torque is switched off for the measured curves, so its other values change nothing there
@pytest.mark.filterwarnings("error::bevel_differential.values.DifferentialWarning")
@pytest.mark.parametrize("exponent", [0.5, 1.0, 1.6])
def test_torque_over_slip_is_a_power_law_or_the_measured_curve(fmu_file, tmp_path, exponent):
    says = bench("clutch_curve", tmp_path, values={"limited_slip.viscous_exponent": exponent}, fmu=fmu_file, workers=0)
    rows = np.genfromtxt(tmp_path / "clutch_curve.csv", delimiter=",", names=True, deletechars="", dtype=None,
                         encoding="utf-8")
    seen = {name: rows[rows["clutch"] == name] for name in dict.fromkeys(rows["clutch"])}
    viscous, curve, holding = seen.values()
    rpm = np.pi / 30.0
    law = 80.0 * (viscous["slip_[rad/s]"] / (100.0 * rpm)) ** exponent
    # below a tenth of its reference slip, the law is regularised
    apart = viscous["slip_[rad/s]"] > 10.0 * rpm
    assert sum(apart) > 40 and viscous["clutch_torque_[N.m]"][apart] == pytest.approx(law[apart], rel=1e-4)
    slips, torques = np.array([0.0, 30.0, 100.0, 250.0]) * rpm, np.array([90.0, 75.0, 110.0, 150.0])
    for found, first in ((curve, 0.0), (holding, 90.0)):
        between = PchipInterpolator(slips, [first, *torques[1:]])(np.minimum(found["slip_[rad/s]"], slips[-1]))
        assert found["clutch_torque_[N.m]"] == pytest.approx(between, rel=1e-4, abs=0.1)
        points = np.isin(found["slip_[rad/s]"].round(9), slips.round(9))
        assert found["clutch_torque_[N.m]"][points] == pytest.approx(torques[0 if first else 1:], rel=1e-3)
    # only the pack with a breakaway torque is measured without slip
    assert [found["slip_[rad/s]"][0] == 0.0 for found in seen.values()] == [False, False, True]
    assert "breaks loose at 90 N·m" in says and "within 0.001 N·m" in says


def test_the_bench_of_clutches_shows_what_the_scene_has(fmu_file, tmp_path):
    def shown(values):
        bench("clutch_curve", tmp_path, values=values, fmu=fmu_file, workers=0)
        return {row.split(",")[0] for row in (tmp_path / "clutch_curve.csv").read_text(encoding="utf-8").splitlines()[2:]}

    dry = {"limited_slip.viscous_torque": 0.0, "limited_slip.preload": 40.0}
    assert shown(dry | {"limited_slip.curve[1].torque": 0.0}) == {"measured curve"}
    unset = {f"limited_slip.curve[{i}].{of}": 0.0 for i in range(1, 5) for of in ("slip", "torque")}
    assert shown(unset) == {"viscous torque"}
    with pytest.raises(DifferentialError, match="needs limited_slip.viscous_torque, or points"):
        shown(unset | dry)
    with pytest.raises(DifferentialError, match="limited_slip.torque_coefficient = 0"):
        bench("ramps", tmp_path, values={"limited_slip.torque_coefficient": 0.0}, fmu=fmu_file, workers=0)


@pytest.mark.parametrize("ratios", [(1.125, 0.875), (1.0, 0.0)])
@pytest.mark.parametrize("other", [{}, {"effects.limited_slip": True, "limited_slip.preload": 30.0}])
def test_clutches_on_command_have_the_torque_of_their_command_against_their_slip(fmu_file, tmp_path, ratios, other):
    of = dict(zip(("left", "right"), ratios))
    values = other | {f"clutches.{side}_ratio": ratio for side, ratio in of.items()}
    says = bench("clutch_command", tmp_path, values=values, fmu=fmu_file, workers=0)
    rows = np.genfromtxt(tmp_path / "clutch_command.csv", delimiter=",", names=True, deletechars="", dtype=None, encoding="utf-8")
    assert len(rows) == 2 * 2 * 21
    # means settle within a thousandth of the torques of the wheels
    for side, slip, command, left, right, torque, housing in rows.tolist():
        assert torque == pytest.approx(np.sign(slip) * command * 400.0, abs=0.3)
        assert housing == pytest.approx((of[side] - 1.0) * torque, abs=0.3)
        assert left + right == pytest.approx(600.0 - housing, abs=0.3)
    expected = [number for ratio in ratios for number in (400.0, -400.0, 400.0 * (ratio - 1.0), -400.0 * (ratio - 1.0))]
    assert numbers(says.replace("\N{MINUS SIGN}", "-")) == pytest.approx([*expected, 0.0], abs=0.3)
    with pytest.raises(DifferentialError, match="needs clutches on command"):
        bench("clutch_command", tmp_path, values={"effects.clutches": False}, fmu=fmu_file, workers=0)


@pytest.mark.parametrize("command, dead_band", [(0.0, 0.0), (0.7, 0.1)])
def test_the_step_response_of_a_clutch_is_that_of_its_actuator(fmu_file, tmp_path, command, dead_band):
    tau, stroke = 0.03, 0.2
    values = {"clutches.response_time": tau, "clutches.stroke_time": stroke, "clutches.dead_band": dead_band, "left.clutch_command": command}
    says = bench("clutch_command", tmp_path, values=values, fmu=fmu_file, workers=0)
    rows = table(tmp_path / "clutch_command_step.csv")
    time, torque = rows["time_[s]"], rows["clutch_torque_[N.m]"]
    target = ((command or 1.0) - dead_band) / (1.0 - dead_band)
    length = time[rows["clutch_command_[1]"] > 0.0].max()

    def ramp(after):
        t = np.maximum(after, 0.0)
        return t - 2.0 * tau + (t + 2.0 * tau) * np.exp(-t / tau)

    def risen(after):
        """Critically damped response to a ramp that ends at the target."""
        return 400.0 / stroke * (ramp(after) - ramp(after - target * stroke))

    assert torque == pytest.approx(np.maximum(risen(time) - risen(time - length), 0.0), abs=1e-3)
    assert rows["closed_form_[N.m]"] == pytest.approx(torque, abs=1e-3)
    fine = np.linspace(0.0, length, 100_001)
    times = [1e3 * fine[np.argmax(risen(fine) >= level * risen(length))] for level in (0.01, 0.1, 0.5, 0.9)]
    dead, _, _, _, *rise = numbers(says[says.index(" is ", says.index("After a step")):says.index("After the step back")])
    # printed with three digits
    assert [dead, *rise] == pytest.approx(times, rel=5e-3)


@pytest.mark.parametrize("values, says", [({}, "No actuator delays the torque"),
                                          ({"clutches.response_time": 0.1, "clutches.dead_band": 0.5, "left.clutch_command": 0.2},
                                           "left.clutch_command = 0.2 is within the dead band")])
def test_without_a_delay_or_within_the_dead_band_no_step_is_drawn(fmu_file, tmp_path, values, says):
    assert says in bench("clutch_command", tmp_path, values=values, fmu=fmu_file, workers=0)
    assert not (tmp_path / "clutch_command_step.csv").exists()


@pytest.mark.parametrize("damping", [0.1, 0.999999, 1.0, 1.000001, 10.0])
def test_the_closed_form_of_the_step_agrees_with_a_numerical_integration(damping):
    actuator, times = Actuator(0.0, 0.3, 0.05, damping), np.linspace(-0.1, 4.0, 200)

    def force(time):
        return min(max(time / 0.3, 0.0), 1.0) - min(max((time - 2.0) / 0.3, 0.0), 1.0)

    found = solve_ivp(lambda t, y: [y[1], (force(t) - y[0]) / 0.05**2 - 2.0 * damping * y[1] / 0.05], (-0.1, 4.0), [0.0, 0.0], t_eval=times,
                      rtol=1e-9, atol=1e-11, max_step=5e-3)
    assert actuator.pulse(times, 1.0, 2.0) == pytest.approx(np.maximum(found.y[0], 0.0), abs=1e-6)


def test_judder_ends_where_linear_theory_excludes_it(fmu_file, tmp_path):
    # T (s - 1) r/v_S exp(-v/v_S) is below the damping of a half-shaft if the wheels differ by more than 3.3 rad/s
    says = bench("judder", tmp_path, fmu=fmu_file)
    # rad/s of rpm
    swing, slip, rising = (number * np.pi / 30.0 for number in numbers(says)[:3])
    limit = 2.0 * 0.1 / 0.055 * np.log(150.0 * 0.15 * 0.055 / (0.1 * 5.0))
    assert limit < slip < 2.0 * limit and swing > 1.0 > rising
    damped = bench("judder", tmp_path, values={"half_shaft.left_damping": 20.0, "half_shaft.right_damping": 20.0}, fmu=fmu_file)
    assert numbers(damped)[0] * np.pi / 30.0 < 1.0


def test_a_pack_that_keeps_its_friction_does_not_fade(fmu_file, tmp_path):
    first, last, hottest = numbers(bench("hot_lap", tmp_path, fmu=fmu_file))[:3]
    kept = numbers(bench("hot_lap", tmp_path, values={"limited_slip.hot_factor": 1.0}, fmu=fmu_file))
    assert first - last > 1.0 and abs(kept[0] - kept[1]) <= 0.1 and 100.0 < hottest < kept[2]


def test_a_winter_start_begins_with_the_drag_of_its_oil(fmu_file, tmp_path):
    loss, later, *_ = numbers(bench("winter_start", tmp_path, fmu=fmu_file))
    record = np.genfromtxt(tmp_path / "winter_start.csv", delimiter=",", names=True, deletechars="")

    def viscosity(kelvin):
        x0, x1 = log10(313.15), log10(373.15)
        y0, y1 = log10(log10(100.7)), log10(log10(15.7))
        return (10.0 ** 10.0 ** (y0 + (y1 - y0) * (log10(kelvin) - x0) / (x1 - x0)) - 0.7) * (870.0 - 0.65 * (kelvin - 288.15))

    for at in (0, 1, -1):
        viscous = (1e-3 + 2.0 * 2e-4) * viscosity(record["temperature.oil"][at]) / viscosity(353.15)
        # viscosity is updated in steps of temperature
        assert record["power.loss"][at] == pytest.approx((0.5 + 2.0 * 0.2) * 50.0 + viscous * 50.0**2 + 1e-4 * 50.0**3, rel=0.02)
    assert loss == round(record["power.loss"][0]) > 5.0 * later


def test_an_own_scene_needs_none_of_the_outputs_of_the_test(fmu_file, tmp_path):
    given = scene_file("winter_start").read_text(encoding="utf-8").replace("stop_time = 1800.0", "stop_time = 60.0")
    own = re.sub(r"outputs = \[.*\]", 'outputs = ["carrier.torque"]', given)
    assert own != given
    for name, text in (("given", given), ("own", own)):
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    said, expected = (command(f"bench winter_start --scene {tmp_path / name}.toml --out {tmp_path / name}").out for name in ("own", "given"))
    assert said.split(" (")[0] == expected.split(" (")[0]


@pytest.mark.parametrize("name, words", [
    ("judder", "tables of both wheel speeds, also of 'left.speed_command'"), ("winter_start", "effects.warm_up = false"),
    ("hot_lap", "stop_time = 0.5 s")])
def test_an_own_scene_without_what_a_test_needs_is_refused(tmp_path, name, words):
    assert words in command(f"bench {name} --scene limited_slip --out {tmp_path / 'out'}", status=2).err


def test_speeds_and_temperatures_are_in_the_units_that_are_wanted(fmu_file, tmp_path):
    plain, turned = (numbers(bench("judder", tmp_path, fmu=fmu_file, display_units=units)) for units in (["rad/s"], ["rpm"]))
    assert turned[:2] == pytest.approx([60.0 / (2.0 * np.pi) * number for number in plain[:2]], rel=6e-3)
    assert "left.speed [rpm]" in (tmp_path / "judder.csv").read_text(encoding="utf-8")


def test_the_command_writes_figure_numbers_and_scene(tmp_path):
    assert command(f"bench winter_start --out {tmp_path / 'out'}").out.startswith("winter_start: the loss is ")
    assert {file.name for file in (tmp_path / "out").iterdir()} == {"winter_start.png", "winter_start.csv", "winter_start.toml"}
    with Image.open(tmp_path / "out" / "winter_start.png") as picture:
        assert len(picture.getcolors(maxcolors=1 << 20)) > 10


@pytest.mark.parametrize("law, shaft, contact", [("impact", False, "tooth"), ("line", False, "tooth"), ("line", True, "tooth"), ("line", False, "lumped")])
def test_the_play_at_the_pinion_is_that_of_both_meshes(fmu_file, tmp_path, law, shaft, contact):
    """Lash of 0.1 mm on the outer pitch radius of the side gears, 36 mm, and of 0.12 mm on the ring gear at 90 mm, times the ratio."""
    values = {"contact.law": law, "effects.propeller_shaft": shaft, "scene.gear_contact": contact}
    says = bench("lash", tmp_path, values=values if contact == "tooth" else {"scene.gear_contact": contact}, fmu=fmu_file)
    play = np.degrees(4.1 * (0.1 / 36.0 + 0.12 / 90.0))
    assert play == pytest.approx(0.96575, abs=5e-6)
    assert float(says.split(" deg")[0].split()[-1]) == pytest.approx(play, abs=1e-5)
    if shaft:
        wound = float(says.split("wind up by ")[1].split()[0])
        assert wound > np.degrees(2.0 * 300.0 / 2e4)
