"""Clutches on command: balances in closed form, sticking against a separate integration, holding and release, mirror images."""

import itertools

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.integrate import solve_ivp

from bevel_differential import Differential
from clutch_reference import Clutches, Gears, Reference, alternating_loads

SIDES = ("left", "right")
# all wheels have imposed speeds; the carrier is driven by torque
RIG = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "effects.clutches": True,
       "half_shaft.left_damping": 200.0, "half_shaft.right_damping": 200.0}
TORQUE = 300.0
OUTPUTS = ["carrier.speed", "carrier.torque", "clutches.housing_torque", "power.in", "power.out", "heat.clutch_command",
           *(f"{side}.{what}" for side in SIDES for what in ("shaft_torque", "clutch_torque", "clutch_slip", "speed"))]


def wheel_speeds(sign_of_carrier, difference):
    carrier = 60.0 * sign_of_carrier
    return {"left.speed_command": carrier + difference, "right.speed_command": carrier - difference}


QUADRANTS = list(itertools.product([1.0, -1.0], [1.0, -1.0]))


@pytest.mark.parametrize("forward, driving", QUADRANTS)
@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("ratio", [1.0, 1.125, 0.875, 0.0])
@pytest.mark.parametrize("contact, within", [("ideal", 1e-9), ("tooth", 1e-3)])
def test_torques_powers_and_heat_balance_in_steady_slip(run, contact, within, ratio, side, forward, driving):
    command, torque = 0.4, driving * 500.0
    values = RIG | wheel_speeds(forward, 2.0) | {
        "scene.gear_contact": contact, f"clutches.{SIDES[side]}_ratio": ratio, "clutches.torque": TORQUE,
        f"{SIDES[side]}.clutch_command": command, "carrier.torque_command": torque, "solver.relative_tolerance": 1e-9 if contact == "ideal" else 1e-6}
    found = run(values, output=OUTPUTS)
    # over whole mesh cycles of 2 rad/s between side gear and carrier: 16 teeth pass in 2 pi/2 s
    period = 2.0 * np.pi / 2.0 / 16.0
    last = found[found["time"] > 0.5 - 2.0 * period] if contact == "tooth" else found[-1:]
    mean = {name: float(last[name].mean()) for name in OUTPUTS}
    slip = ratio * 60.0 * forward - found[f"{SIDES[side]}.speed"][-1]
    expected = command * TORQUE * np.sign(slip)
    carried = [expected if s == side else 0.0 for s in (0, 1)]
    size = abs(torque)
    assert [mean[f"{name}.clutch_torque"] for name in SIDES] == pytest.approx(carried, abs=within * size)
    shafts = [mean[f"{name}.shaft_torque"] for name in SIDES]
    assert shafts[0] - shafts[1] == pytest.approx(carried[0] - carried[1], abs=within * size)
    assert sum(shafts) == pytest.approx(torque + (1.0 - ratio) * expected, abs=within * size)
    assert mean["clutches.housing_torque"] == pytest.approx((ratio - 1.0) * expected, abs=within * size)
    # what the drives give and the wheels do not get is heat
    loss = expected * slip
    assert loss > 0.0
    assert mean["power.in"] - mean["power.out"] == pytest.approx(loss, abs=within * size * 60.0)
    first = last[0] if contact == "tooth" else found[-101]
    heat = (found["heat.clutch_command"][-1] - first["heat.clutch_command"]) / (found["time"][-1] - first["time"])
    assert heat == pytest.approx(loss, rel=within)


# left gear behind a half-shaft whose wheel has an imposed speed, carrier with an imposed speed, and ideal gears: one degree of freedom
RATIO, CARRIER, RATE, SPRING, COMMAND = 1.125, 40.0, 100.0, 5e4, 0.5
SHAFT = {"half_shaft.left_stiffness": 2e4, "half_shaft.left_damping": 60.0}
STICKING = SHAFT | {
    "scene.carrier_drive": "speed", "scene.left_drive": "speed", "scene.right_drive": "torque", "scene.gear_contact": "ideal",
    "effects.clutches": True, "clutches.left_ratio": RATIO, "clutches.torque": TORQUE, "clutches.stiffness": SPRING,
    "clutches.damping_time": 0.0, "carrier.speed_command": CARRIER, "left.clutch_command": COMMAND, "right.load_torque": 0.0,
    "solver.relative_tolerance": 1e-10}


def at_start(fmu, start):
    """Twist of the half-shaft at the start."""
    with fmu.open() as opened:
        opened.initialise(STICKING | {"left.speed_command": RATIO * CARRIER + start})
        return opened.get("left.twist")


def turning_inertia(fmu):
    """Inertia of the left side gear, with right side gear and planets that follow it while the carrier turns steadily: from the
    acceleration under the clutch's torque, without a twist of the half-shaft."""
    names = ["left.acceleration", "left.clutch_torque", "left.shaft_torque"]
    with fmu.open() as opened:
        opened.initialise(STICKING | {"left.speed_command": 30.0, "scene.start": "rolling"})
        opened.step(1e-6)
        acceleration, clutch, shaft = opened.read(names)
    return (clutch - shaft) / acceleration


def expected_times(inertia, start, twist):
    """Times at which the clutch sticks, and at which its torque crosses zero, by an explicit method of order 8."""
    k, c = SHAFT["half_shaft.left_stiffness"], SHAFT["half_shaft.left_damping"]
    speed, limit = RATIO * CARRIER, COMMAND * TORQUE

    def sides(clutch):
        def rates(t, y):
            twist, omega, angle = y
            wheel = speed + start - np.sign(start) * RATE * t
            slip = omega - speed
            return [omega - wheel, (clutch(slip, angle) - k * twist - c * (omega - wheel)) / inertia, slip]
        return rates

    def ends(value):
        value.terminal = True
        return value

    options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13, "max_step": 1e-4}
    slides = solve_ivp(sides(lambda *_: -np.sign(start) * limit), (0.0, 1.0), [twist, speed + start, 0.0],
                       events=ends(lambda _, y: y[1] - speed), **options)
    wound = -np.sign(start) * limit / SPRING
    held = solve_ivp(sides(lambda _, angle: SPRING * (wound - angle)), (slides.t[-1], 1.0),
                     [slides.y[0, -1], speed, 0.0], events=ends(lambda _, y: y[2] - wound), **options)
    return slides.t[-1], held.t[-1]


# the clutch sticks after 49.96 ms, between two communication points
@pytest.mark.parametrize("start", [-4.996, 4.996])
def test_a_clutch_sticks_when_the_wheel_reaches_its_shaft_and_its_torque_crosses_zero(fmu, run, start):
    """The speed of the wheel rises or falls through that of the clutch's shaft. The clutch sticks there, and its spring unwinds."""
    sticks, crosses = expected_times(turning_inertia(fmu), start, at_start(fmu, start))
    step, end = 1e-4, sticks + 1.2 * (crosses - sticks)
    last = RATIO * CARRIER + start - np.sign(start) * RATE * end
    found = run(STICKING | {"left.speed_command": RATIO * CARRIER + start}, end, step,
                ["left.clutch_torque", "held.clutches", "left.clutch_slip"],
                {"left.speed_command": ([0.0, end], [RATIO * CARRIER + start, last])})
    time, torque, slip = (found[name] for name in ("time", "left.clutch_torque", "left.clutch_slip"))
    first = int(np.argmax(found["held.clutches"] > 0.5))
    assert time[first - 1] <= sticks <= time[first] and found["held.clutches"][first:].min() == 1.0
    assert np.abs(torque[1:first - 1] + np.sign(start) * COMMAND * TORQUE).max() < 1e-9 * TORQUE
    # the slip is straight enough between two points
    near = slice(first - 2, first)
    touch = time[near][0] + slip[near][0] * step / (slip[near][0] - slip[near][1])
    assert touch == pytest.approx(sticks, abs=1e-6)
    cross = CubicSpline(time[first + 1:], torque[first + 1:]).roots(extrapolate=False)
    assert len(cross) == 1 and cross[0] == pytest.approx(crosses, abs=1e-6)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_a_clutch_holds_for_an_hour_without_creep_and_is_released(run, direction):
    values = RIG | {
        "scene.gear_contact": "ideal", "scene.start": "rest", "scene.left_drive": "torque", "scene.right_drive": "speed",
        "right.speed_command": 0.0, "inertia.left_end": 1.0, "effects.half_shaft": True, "clutches.left_ratio": 0.0, "clutches.torque": TORQUE,
        "left.clutch_command": 0.3, "carrier.torque_command": 0.0, "left.load_torque": -direction * 50.0, "carrier.speed_command": 0.0}
    found = run(values, 3600.0, 60.0, ["left.angle", "held.clutches", "solver.steps"])
    assert found["held.clutches"][1:].min() == 1.0
    assert np.ptp(found["left.angle"][6:]) < 1e-9
    assert found["solver.steps"][-1] < 5000
    released = run(values | {"left.clutch_command": 0.1}, output=["left.speed", "held.clutches"])
    assert released["held.clutches"][-1] == 0.0 and direction * released["left.speed"][-1] > 1.0


def test_clutches_stick_and_slip_as_in_a_separate_integration(started):
    gears = Gears(stiffness=3e9, damping=2e4, depth=1e-5, side=0.5, planet=5e-4)
    # the command times the torque, independent of slip and load
    clutches = Clutches(0.3 * 100.0, 0.0, 1.0, False, [(0.0, 0.0), (1.0, 0.0)], 1e5)
    driven = started(gears.values() | {
        "effects.clutches": True, "clutches.torque": 100.0, "clutches.stiffness": clutches.stiffness, "left.clutch_command": 0.3,
        "right.clutch_command": 0.3, "solver.relative_tolerance": 1e-10})
    reference, step = Reference(gears, clutches), 0.04
    for loads in alternating_loads():
        driven.set(dict(zip(("left.load_torque", "right.load_torque"), loads)))
        reference.advance(step, loads)
        driven.step(step)
        left, right, carrier = driven.read(["left.angle", "right.angle", "carrier.angle"])
        assert np.abs(np.array([left - carrier, right - carrier]) - reference.state[:2]).max() < 1e-6
        if reference.switches >= 50:
            break
    assert reference.switches >= 50 and max(np.abs(reference.state[:2])) > 0.1


def test_a_pressed_clutch_warms_up_and_fades(run):
    """Without cooling, C dT/dt = P (1 - k (T - T_0)), if friction falls linearly to `hot_factor`."""
    capacity, fade, slip, command = 300.0, 0.4 / 120.0, 2.0, 0.5
    values = RIG | wheel_speeds(1.0, -slip) | {
        "scene.gear_contact": "ideal", "clutches.torque": TORQUE, "left.clutch_command": command, "carrier.torque_command": 300.0,
        "effects.warm_up": True, "oil.temperature": 353.15, "warm_up.clutch_capacity": capacity, "warm_up.clutch_to_oil": 0.0,
        "clutches.hot_factor": 0.6, "solver.relative_tolerance": 1e-8}
    found = run(values, 60.0, 0.1, ["temperature.clutch", "left.clutch_torque", "heat.clutch_command"])
    power = command * TORQUE * slip
    risen = (1.0 - np.exp(-fade * power / capacity * found["time"])) / fade
    assert risen[-1] > 40.0
    assert found["temperature.clutch"] - 353.15 == pytest.approx(risen, abs=0.01 * risen[-1])
    assert found["heat.clutch_command"] == pytest.approx(capacity * risen, abs=0.01 * capacity * risen[-1])
    assert found["left.clutch_torque"][-1] == pytest.approx(command * TORQUE * (1.0 - fade * risen[-1]), rel=0.01)


def test_two_clutches_that_hold_stop_the_car_and_this_is_said_once(fmu):
    values = RIG | {
        "scene.left_drive": "torque", "scene.right_drive": "torque", "scene.gear_contact": "ideal", "left.load_torque": 0.0,
        "right.load_torque": 0.0, "carrier.torque_command": 100.0, "carrier.speed_command": 5.0, "clutches.torque": 5e3,
        "left.clutch_command": 1.0, "right.clutch_command": 1.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5,
        "clutches.damping_time": 1e-2}
    for ratios, stops in (((1.1, 1.05), True), ((1.1, 0.9), False)):
        with Differential(values | {f"clutches.{side}_ratio": ratio for side, ratio in zip(SIDES, ratios)}, fmu=fmu.file) as unit:
            found = unit.run(outputs=["carrier.speed"], stop=5.0, step=1e-2)
            said = [text for text in unit.warnings if "both clutches hold" in text]
        assert len(said) == stops
        assert (abs(found["carrier.speed"][-1]) < 1e-3) == stops


@pytest.mark.parametrize("torque, is_told", [(0.0, True), (10.0, False)])
def test_clutches_without_torque_are_reported(fmu, torque, is_told):
    with fmu.open() as opened:
        opened.initialise({"effects.clutches": True, "clutches.torque": torque})
        assert any("the clutches have no torque at any command" in text for text in opened.messages) == is_told


def test_without_commands_the_effect_changes_no_bit(run):
    values = {"scene.planet_spin": "imposed", "spin.command": 3.0}
    names = ["left.speed", "carrier.torque", "left.normal_force", "solver.rhs_calls"]
    off, on = (run(values | {"effects.clutches": by}, 0.05, output=names) for by in (False, True))
    assert all(np.array_equal(off[name], on[name]) for name in names[:3])
