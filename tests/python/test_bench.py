"""The virtual bench: each test has a figure, numbers and a sentence, and measures known values."""

import re
from math import log10

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.bench import TESTS, bench, scene_file
from bevel_differential.command import main
from bevel_differential.scene_file import read_toml
from PIL import Image

PRELOAD, RATIO, COLD = 60.0, 1.3, 1.5
# gears without teeth, and only friction of the packs
PLAIN = {"scene.gear_contact": "ideal", "effects.tooth_friction": False, "effects.thrust_friction": False, "limited_slip.preload": PRELOAD,
         "limited_slip.torque_coefficient": 0.0, "limited_slip.static_ratio": RATIO, "limited_slip.stribeck_speed": 0.0,
         "limited_slip.cold_factor": COLD, "limited_slip.hot_factor": 1.0}


def table(file):
    return np.genfromtxt(file, delimiter=",", names=True, deletechars="", skip_header=1)


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


def test_breakaway_is_reported_separately_from_bias(fmu_file, tmp_path):
    says = bench("breakaway", tmp_path, values=PLAIN, fmu=fmu_file, workers=0)
    for torque, direction, temperature, left, _, _, effect in table(tmp_path / "breakaway.csv").tolist():
        clutch = RATIO * PRELOAD * (1.0 + (COLD - 1.0) * max(0.0, (353.15 - temperature) / 100.0))
        assert left == pytest.approx(torque / 2.0 - direction * clutch, abs=0.1) and effect == pytest.approx(200.0 * clutch / torque, abs=0.1)
    assert "1.30 to 1.30 times" in says


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
    record = np.genfromtxt(tmp_path / "winter_start.csv", delimiter=",", names=True, deletechars="", skip_header=2)

    def viscosity(kelvin):
        x0, x1 = log10(313.15), log10(373.15)
        y0, y1 = log10(log10(100.7)), log10(log10(15.7))
        return (10.0 ** 10.0 ** (y0 + (y1 - y0) * (log10(kelvin) - x0) / (x1 - x0)) - 0.7) * (870.0 - 0.65 * (kelvin - 288.15))

    for at in (1, -1):
        viscous = (1e-3 + 2.0 * 2e-4) * viscosity(record["temperature.oil"][at]) / viscosity(353.15)
        # viscosity is updated in steps of temperature
        assert record["power.loss"][at] == pytest.approx((0.5 + 2.0 * 0.2) * 50.0 + viscous * 50.0**2 + 1e-4 * 50.0**3, rel=0.02)
    assert loss == round(record["power.loss"][1]) > 5.0 * later


def test_the_command_writes_figure_numbers_and_scene(fmu_file, tmp_path, capsys):
    assert main(["bench", "winter_start", "--out", str(tmp_path / "out"), "--fmu", fmu_file]) == 0
    assert capsys.readouterr().out.startswith("winter_start: the loss is ")
    assert {file.name for file in (tmp_path / "out").iterdir()} == {"winter_start.png", "winter_start.csv", "winter_start.toml"}
    with Image.open(tmp_path / "out" / "winter_start.png") as picture:
        assert len(picture.getcolors(maxcolors=1 << 20)) > 10


def test_speeds_and_temperatures_are_in_the_units_that_are_wanted(fmu_file, tmp_path):
    plain, turned = (numbers(bench("judder", tmp_path, fmu=fmu_file, display_units=units)) for units in (["rad/s"], ["rpm"]))
    assert turned[:2] == pytest.approx([60.0 / (2.0 * np.pi) * number for number in plain[:2]], rel=6e-3)
    assert "left.speed [rpm]" in (tmp_path / "judder.csv").read_text(encoding="utf-8")


def test_wrong_tests_are_one_line(capsys, tmp_path):
    for words, said in ((["hotlap"], "did you mean hot_lap"), (["--scene", "clunk"], "name the one test")):
        assert main(["bench", *words, "--out", str(tmp_path)]) == 2
        assert said in capsys.readouterr().err
