"""Examples of the car: a launch on split friction, a turn with torque vectoring and an axle disconnect, against closed forms and in the
mirror."""

import runpy
from math import pi, sin
from pathlib import Path

import numpy as np
import pytest
from bevel_differential.vehicle import Car, Tyre

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "vehicle"
LAUNCH, VECTORING, PLAIN, AXLE = (runpy.run_path(str(EXAMPLES / f"{name}.py"))
                                  for name in ("launch", "torque_vectoring", "split_friction_fmpy", "disconnect"))
TYRE = Tyre()


@pytest.mark.parametrize("name, words", [("launch", ["open", "limited slip", "electronic", "lock"]),
                                         ("torque_vectoring", ["off", "brakes", "clutches"])])
def test_the_examples_run_and_no_case_is_worse_than_the_one_before(fmu_file, tmp_path, monkeypatch, capsys, name, words):
    """Cases are compared by the speed after the launch, and by the yaw rate in the bend."""
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)
    monkeypatch.setattr("sys.argv", [name, str(tmp_path / "picture.png")])
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()[1:]
    assert [line[:13].strip() for line in lines] == words
    figures = [float(line[13:].split()[0]) for line in lines]
    assert all(after > 0.999 * before for before, after in zip(figures, figures[1:])) and figures[-1] > 1.2 * figures[0]
    assert (tmp_path / "picture.png").is_file()


def slope(record, name):
    return np.polyfit(record["time"], record[name], 1)[0]


def test_the_electronic_limited_slip_moves_the_torque_of_its_clutch(fmu_file):
    record = LAUNCH["launched"]("electronic", fmu_file)
    late = record[record["time"] > 0.7]
    left, right = (late[f"{side}.shaft_torque"].mean() for side in ("left", "right"))
    difference = (late["left.wheel_speed"] - late["right.wheel_speed"]).mean()
    # T_R - T_L = C
    assert right - left == pytest.approx(LAUNCH["TORQUE"] * difference / LAUNCH["FULL"], rel=0.01)
    # far beyond its peak, the magic formula tends to sin(C pi/2) of the friction limit
    ice = 0.15 * TYRE.load * sin(TYRE.shape * pi / 2.0)
    assert left == pytest.approx(TYRE.radius * ice + TYRE.inertia * slope(late, "left.wheel_speed"), rel=0.02)
    # traction accelerates the car
    dry = (right - TYRE.inertia * slope(late, "right.wheel_speed")) / TYRE.radius
    resisted = 0.012 * 1455.0 * 9.80665
    assert slope(late, "body.speed") == pytest.approx((ice + dry - resisted) / 1455.0, rel=0.01)


def test_the_clutch_of_the_left_side_also_helps_a_wheel_on_ice_at_the_right(fmu_file):
    """With the ratio 1, a clutch at either side moves the torque from the faster to the slower wheel."""
    parameters = {"scene.gear_contact": "ideal", "effects.clutches": True, "clutches.torque": LAUNCH["TORQUE"]}
    tyres = Tyre(friction=0.15), Tyre(friction=0.9)
    one, other = (Car(parameters, left=left, right=right, fmu=fmu_file).run(
        LAUNCH["OUTPUTS"], 1.0, request=LAUNCH["PEDAL"], controller=LAUNCH["press_the_clutch"]) for left, right in (tyres, tyres[::-1]))
    assert one["body.speed"][-1] > 1.5
    for name, twin in (("body.speed", "body.speed"), ("left.wheel_speed", "right.wheel_speed"), ("left.shaft_torque", "right.shaft_torque")):
        assert one[name][100:] == pytest.approx(other[twin][100:], rel=1e-3, abs=1e-3 * np.abs(one[name]).max())


def test_the_script_for_fmpy_moves_the_torque_of_the_clutch_and_needs_no_other_package(fmu_file):
    assert "import bevel" not in (text := (EXAMPLES / "split_friction_fmpy.py").read_text()) and "from bevel" not in text
    left, right, left_torque, right_torque, clutch = PLAIN["simulate"](fmu_file, PLAIN["FULL"]).values()
    moved = PLAIN["TORQUE"] * (left - right) / PLAIN["FULL"]
    assert -clutch == pytest.approx(moved, rel=0.01) and right_torque - left_torque == pytest.approx(moved, rel=0.05)
    # the right wheel moves wheel and car, apart from what the ice moves
    open_right = PLAIN["simulate"](fmu_file, float("inf"))["right.wheel_speed"]
    assert right > 1.4 * open_right


@pytest.fixture(scope="module")
def turns(fmu_file):
    """Record of the last half second of each case; the motor's ratio is 9, and the track 1.5 m."""
    records = {name: VECTORING["turned"](name, fmu=fmu_file)[1] for name in VECTORING["CASES"]}
    return {name: record[record["time"] > 2.0] for name, record in records.items()}


def mean(record, name):
    return record[name].mean()


def rate(record, name):
    return (record[name][-1] - record[name][0]) / (record["time"][-1] - record["time"][0])


def wanted(record):
    """Torque that the controller moves: yaw moment per missing yaw rate, as a force at each wheel, times the radius."""
    missing = mean(record, "body.speed") * VECTORING["STEER"] / 2.6 - mean(record, "body.yaw_rate")
    return VECTORING["GAIN"] * missing / 0.75 * TYRE.radius


def test_brakes_and_clutches_move_the_same_force_to_the_outer_wheel(turns):
    off, brakes, clutches = turns.values()
    assert mean(brakes, "body.yaw_rate") == pytest.approx(mean(clutches, "body.yaw_rate"), rel=1e-3)
    for record in (brakes, clutches):
        moved = wanted(record)
        assert 0.0 < moved < VECTORING["MOST"] and mean(record, "body.yaw_rate") > 1.2 * mean(off, "body.yaw_rate")
        assert TYRE.radius * (mean(record, "right_tyre.force") - mean(record, "left_tyre.force")) == pytest.approx(moved, rel=0.01)
    # brakes act outside the differential, clutches inside
    shafts = [mean(record, "right.shaft_torque") - mean(record, "left.shaft_torque") for record in turns.values()]
    assert shafts == pytest.approx([0.0, 0.0, wanted(clutches)], abs=0.01 * wanted(clutches))


def test_clutches_need_an_eighth_of_the_torque_and_their_slip_is_the_loss(turns):
    _, brakes, clutches = turns.values()
    moved = wanted(clutches)
    # T_L + T_R = T_c - 0.125 C
    for record, share in ((brakes, 0.0), (clutches, 0.125)):
        sides = mean(record, "left.shaft_torque") + mean(record, "right.shaft_torque")
        assert 9.0 * mean(record, "motor.torque") == pytest.approx(sides + share * moved, abs=0.02 * moved)
    # wheels roll on their circles, and the slip of the tyres is their force over the slope
    outer, inner = (mean(clutches, "body.speed") + sign * 0.75 * mean(clutches, "body.yaw_rate") for sign in (1.0, -1.0))
    outer, inner = (speed * (1.0 + mean(clutches, f"{side}_tyre.force") / TYRE.slip_stiffness) / TYRE.radius
                    for side, speed in (("right", outer), ("left", inner)))
    assert rate(clutches, "heat.clutch_command") == pytest.approx(moved * (1.125 * 0.5 * (outer + inner) - outer), rel=0.02)
    assert rate(brakes, "heat.brake") == pytest.approx(wanted(brakes) * inner, rel=0.02)


def test_a_turn_to_the_right_is_the_mirror_image(fmu_file):
    one, other = (VECTORING["turned"]("clutches", sign, fmu_file)[1] for sign in (1.0, -1.0))
    assert one["body.yaw_rate"] == pytest.approx(-other["body.yaw_rate"], abs=1e-4 * np.abs(one["body.yaw_rate"]).max())
    for name, twin in (("left_tyre.force", "right_tyre.force"), ("motor.torque", "motor.torque"), ("heat.clutch_command", "heat.clutch_command")):
        assert one[name] == pytest.approx(other[twin], abs=0.01 * np.abs(one[name]).max())


@pytest.fixture(scope="module")
def coasting(fmu_file):
    """Records of the car that opens its dog clutch, and of the car that does not."""
    return [AXLE["coasted"](opens, fmu_file) for opens in (True, False)]


def test_an_axle_disconnect_opens_stops_the_carrier_and_closes_near_the_speed_of_the_wheel(coasting):
    record, closed = coasting
    rows = AXLE["changes"](record)
    assert rows["right.dog_phase"].tolist()[:3] == [3, 0, 1] and rows["right.dog_phase"][-1] == 3
    assert rows["time"][1:3] == pytest.approx([AXLE["OPENS"], AXLE["CLOSES"]], abs=2e-3)
    # teeth engage up to a difference of 5 rad/s, the start value
    assert abs(rows["right.speed"][-1] - rows["right.wheel_speed"][-1]) <= 5.0
    late = (record["time"] > 10.0) & (record["time"] < AXLE["CLOSES"])
    assert np.abs(record["carrier.speed"][late]).max() < 0.1 and not record["right.shaft_torque"][late].any()
    assert record["right.speed"][late] == pytest.approx(-record["right.wheel_speed"][late], abs=0.2)
    # both wheels have the drag of one side gear
    drag = np.diff(record["heat.drag"][late][[0, -1]])[0]
    turned = 2.0 * np.trapezoid(record["right.wheel_speed"][late], record["time"][late])
    assert drag == pytest.approx(AXLE["SIDE"] * turned, rel=0.01)
    assert np.ptp(closed["right.dog_phase"]) == 0.0


def test_the_saved_drag_is_the_energy_of_the_faster_car(coasting):
    """Energy of body, wheels and motor with the resistance of the road, of both cars, until the clutch closes."""
    energies = []
    for record in coasting:
        record = record[record["time"] < AXLE["CLOSES"]]
        time, speed, wheel, carrier = (record[name] for name in ("time", "body.speed", "right.wheel_speed", "carrier.speed"))
        road = np.trapezoid((0.012 * 1455.0 * 9.80665 + 0.4 * speed**2) * speed, time)
        kinetic = 0.5 * (1455.0 * speed**2 + 2.0 * TYRE.inertia * wheel**2 + 0.03 * 81.0 * carrier**2)
        energies.append((kinetic[-1] - kinetic[0] + road, record["heat.drag"][-1]))
    (gained, heat), (plain, more_heat) = energies
    # slip of the tyres and the carrier's own inertia are left out
    assert gained - plain == pytest.approx(more_heat - heat, rel=0.02)


def test_the_axle_disconnect_prints_its_phases_and_draws(fmu_file, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)
    monkeypatch.setattr("sys.argv", ["disconnect", str(tmp_path / "picture.png")])
    runpy.run_path(str(EXAMPLES / "disconnect.py"), run_name="__main__")
    printed = capsys.readouterr().out
    assert [line[11:35].strip() for line in printed.splitlines()[1:4]] == ["closed", "open", "waits for equal speeds"]
    assert (tmp_path / "picture.png").is_file()
