"""Propeller shaft in front of the final drive: twist, universal joint against its closed form, and a separate integration."""

from math import pi, sqrt

import numpy as np
import pytest
from final_drive_scenes import DRIVEN, ELASTIC, RATIO, UNLOADED, loads, sampled, turning_inertia
from joint_reference import Propeller, closed_angle, output_angle, speed_ratio

SAME = 1e-9
SHAFT = {"effects.final_drive": True, "effects.propeller_shaft": True, "scene.gear_contact": "ideal"}
TURNS = pytest.mark.parametrize("quarter", [False, True])
EITHER = pytest.mark.parametrize("elastic", [False, True])


def joint(angle, quarter):
    return {"propeller_shaft.joint_angle": angle, "propeller_shaft.joint_quarter_turn": quarter}


@TURNS
@pytest.mark.parametrize("angle", [0.05, 0.4, 1.1])
def test_the_closed_form_follows_from_the_cross_of_the_joint(quarter, angle):
    for turned in np.linspace(-20.0, 20.0, 301):
        after = closed_angle(turned, angle, quarter)
        assert output_angle(turned, angle, quarter) == pytest.approx(after, abs=1e-10)
        slope = (closed_angle(turned + 1e-5, angle, quarter) - closed_angle(turned - 1e-5, angle, quarter)) / 2e-5
        assert speed_ratio(turned, angle, quarter) == pytest.approx(slope, abs=1e-8)


@TURNS
@pytest.mark.parametrize("angle", [0.1, 0.6])
def test_a_stiff_shaft_turns_as_the_joint_does(started, quarter, angle):
    speed = 2.0
    opened = started(SHAFT | joint(angle, quarter) | loads(500.0) | {
        "pinion.speed_command": speed, "propeller_shaft.stiffness": 1e9, "propeller_shaft.damping": 1e3,
        "solver.relative_tolerance": 1e-9})
    opened.step(0.1)
    driven, end, end_speed, angle_p, angle_c = sampled(
        opened, ["pinion.speed", "propeller.angle", "propeller.speed", "pinion.angle", "carrier.angle"], 0.05, 80).T
    ratios = [speed_ratio(turned, angle, quarter) for turned in end]
    assert end_speed == pytest.approx(np.full(len(end), speed), rel=SAME)
    assert driven == pytest.approx(speed * np.array(ratios), rel=1e-6)
    assert angle_p == pytest.approx(np.array([closed_angle(turned, angle, quarter) for turned in end]), abs=1e-5)
    assert angle_c == pytest.approx(angle_p / RATIO, abs=1e-5)


@EITHER
@TURNS
@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_the_port_bears_the_torque_of_the_shaft_times_the_ratio_of_the_joint(started, contact, quarter, elastic):
    angle = 0.5
    opened = started(SHAFT | joint(angle, quarter) | loads(500.0) | {
        "final_drive.elastic_mesh": elastic, "scene.gear_contact": contact, "pinion.speed_command": 30.0})
    seen = sampled(opened, ["pinion.torque", "propeller.torque", "propeller.angle", "propeller.speed", "power.in"], 2e-3, 150)
    torque, port, turned, speed, power = seen.T
    assert np.ptp(torque) > 1.0
    ratios = np.array([speed_ratio(each, angle, quarter) for each in turned])
    largest = np.abs(port).max()
    assert np.abs(port - torque * ratios).max() < SAME * largest
    assert np.abs(power - port * speed).max() < SAME * np.abs(power).max()


@pytest.fixture
def swing(fmu, started):
    """swing(quarter, way): course of a scene from rest (angles and speeds of both ends, torque of the shaft), and of the reference."""
    def simulate(quarter, way):
        angle, stiffness, damping, pinion, end, load, torque = 0.6, 3e3, 4.0, 0.004, 0.02, 120.0 * way, 70.0 * way
        inertia = pinion + turning_inertia(fmu) / RATIO**2
        stop, count = 0.4, 80
        names = ["propeller.angle", "pinion.angle", "propeller.speed", "pinion.speed", "pinion.torque"]
        opened = started(SHAFT | DRIVEN | joint(angle, quarter) | loads(load) | {
            "scene.start": "rest", "propeller_shaft.stiffness": stiffness, "propeller_shaft.damping": damping, "inertia.pinion": pinion,
            "inertia.propeller_end": end, "pinion.torque_command": torque, "pinion.speed_command": 0.0,
            "solver.relative_tolerance": 1e-11})
        found = sampled(opened, names, stop / count, count + 1)
        reference = Propeller(end, inertia, stiffness, damping, angle, quarter, load / RATIO)
        expected = reference.follow(np.zeros(4), lambda _: torque, np.linspace(0.0, stop, count + 1))
        assert np.ptp(expected[:, 0]) > 4.0 * pi
        return found, np.column_stack([expected, [reference.shaft(state)[0] for state in expected]])

    return simulate


WAYS = pytest.mark.parametrize("way", [1.0, -1.0])


@WAYS
@TURNS
def test_a_full_integration_agrees(swing, quarter, way):
    found, expected = swing(quarter, way)
    scale = np.abs(expected).max(axis=0)
    off = (np.abs(found - expected) / scale).max(axis=0)
    # the torque of the shaft is a difference of angles
    assert off[:4].max() < 1e-7 and off[4] < 1e-6


@TURNS
def test_an_imposed_speed_agrees_with_a_full_integration(fmu, started, quarter):
    angle, stiffness, damping, pinion, load, speed = 0.5, 3e3, 6.0, 0.004, 200.0, 60.0
    inertia = pinion + turning_inertia(fmu) / RATIO**2
    names = ["propeller.angle", "pinion.angle", "propeller.speed", "pinion.speed"]
    opened = started(SHAFT | joint(angle, quarter) | loads(load) | {
        "propeller_shaft.stiffness": stiffness, "propeller_shaft.damping": damping, "inertia.pinion": pinion,
        "pinion.speed_command": speed, "solver.relative_tolerance": 1e-11})
    found = sampled(opened, names, 2e-3, 101)
    reference = Propeller(1.0, inertia, stiffness, damping, angle, quarter, load / RATIO)
    expected = reference.follow(found[0], None, np.linspace(0.0, 0.2, 101))
    assert (np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)).max() < 1e-7


@TURNS
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_at_the_start_the_shaft_bears_the_load(started, drive, quarter):
    angle, stiffness, damping, load = 0.5, 3e3, 6.0, 200.0
    # the torque of the drive balances that of the shaft, so that nothing accelerates but by the joint
    opened = started(SHAFT | joint(angle, quarter) | loads(load) | {
        "scene.carrier_drive": drive, "propeller_shaft.stiffness": stiffness, "propeller_shaft.damping": damping,
        "pinion.speed_command": 0.0, "pinion.torque_command": load / RATIO * speed_ratio(0.0, angle, quarter)})
    state = opened.read(["propeller.angle", "pinion.angle", "propeller.speed", "pinion.speed"])
    shaft = Propeller(1.0, 1.0, stiffness, damping, angle, quarter, 0.0).shaft(state)[0]
    assert shaft == pytest.approx(load / RATIO, rel=1e-6)


@TURNS
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_at_the_start_both_ends_turn_as_the_joint_does(started, drive, quarter):
    angle = 0.5
    opened = started(SHAFT | joint(angle, quarter) | loads(200.0) | {"scene.carrier_drive": drive, "pinion.speed_command": 60.0,
                                                                   "pinion.torque_command": 200.0 / RATIO})
    turned, end, pinion = opened.read(["propeller.angle", "propeller.speed", "pinion.speed"])
    # an imposed speed gives the pinion's before the shaft is wound up
    at = 0.0 if drive == "speed" else turned
    assert pinion == pytest.approx(end * speed_ratio(at, angle, quarter), rel=SAME)


def test_a_shaft_without_joint_twists_by_its_stiffness_and_swings_with_its_end(fmu, started):
    stiffness, end, pinion, extra = 5e3, 0.02, 0.003, 10.0
    inertia = pinion + turning_inertia(fmu) / RATIO**2
    reduced = end * inertia / (end + inertia)
    period = 2.0 * pi / sqrt(stiffness / reduced)
    opened = started(SHAFT | DRIVEN | UNLOADED | {
        "propeller_shaft.stiffness": stiffness, "propeller_shaft.damping": 0.0, "inertia.propeller_end": end, "inertia.pinion": pinion,
        "pinion.torque_command": 0.0, "pinion.speed_command": 20.0, "solver.relative_tolerance": 1e-10})
    opened.set({"pinion.torque_command": extra})
    torques = sampled(opened, ["pinion.torque"], period / 40.0, 120)[:, 0]
    # share of the torque that accelerates the pinion
    share = extra * inertia / (end + inertia)
    expected = share * (1.0 - np.cos(2.0 * pi * np.arange(120) / 40.0))
    assert np.abs(torques - expected).max() < 1e-6 * share


@EITHER
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_without_a_shaft_the_port_is_the_pinion(run, elastic, drive):
    record = run({"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "scene.carrier_drive": drive}, 0.02)
    for name in ("speed", "angle", "torque"):
        assert np.array_equal(record[f"propeller.{name}"], record[f"pinion.{name}"])


@EITHER
@TURNS
def test_energy_is_in_balance_and_damping_is_the_only_heat(started, elastic, quarter):
    opened = started(SHAFT | ELASTIC | DRIVEN | joint(0.5, quarter) | loads(400.0) | {
        "final_drive.elastic_mesh": elastic, "pinion.torque_command": 120.0, "pinion.speed_command": 40.0})
    work = 0.0
    for _ in range(500):
        before = abs(opened.get("power.in"))
        opened.step(1e-3)
        work += 5e-4 * (before + abs(opened.get("power.in")))
    assert opened.get("heat.propeller_shaft") > 0.1
    assert abs(opened.get("solver.energy_residual")) < 1e-6 * work
    assert opened.get("heat.final_drive") == 0.0 or elastic
