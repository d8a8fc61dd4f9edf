"""Brake torques as inputs: ramped, released; saved states, mirror images, model exchange, derivatives."""

import numpy as np
import pytest
from braking import BRAKED, CONTACTS, END, EXACT, MASSLESS, STIFFNESS, WHOLE, brakes, drive_torque, wheel_angles
from driving import SIDES

IDEAL = BRAKED | MASSLESS | {"scene.gear_contact": "ideal"}
STOP = IDEAL | brakes(400.0) | drive_torque(300.0) | {"carrier.speed_command": 30.0}
OUTPUTS = ["left.angle", "left.speed", "left.acceleration", "left.shaft_torque", "left.thrust_force", "right.angle",
           "right.speed", "right.shaft_torque", "carrier.torque", "carrier.speed", "planet[1].spin_angle", "heat.brake",
           "held.wheels", "solver.steps", "solver.energy_residual", "power.in", "power.out", "power.loss"]


def ramp(driven, rate):
    """Both brake torques change at `rate` [N·m/s] in the following steps."""
    driven.set_slopes({f"{side}.brake_torque": rate for side in SIDES})


def slowed(torque, drive, speed, time, rate):
    """Speed, angle, and heat of both brakes while the wheels slide under T = torque + rate t against a constant drive."""
    t = np.polynomial.Polynomial([0.0, 1.0])
    brake = torque + rate * t
    omega = speed + ((drive - 2.0 * brake) / WHOLE).integ()
    return omega(time), omega.integ()(time), (2.0 * brake * omega).integ()(time)


def test_a_torque_that_is_ramped_slows_wheels_by_its_closed_form(drive):
    """The ramp is one step of 0.2 s with derivatives, then steps of 1 ms, each with the torque at its middle."""
    torque, rate, speed, time = 50.0, 1500.0, 30.0, 0.2
    expected = slowed(torque, 300.0, speed, time, rate)
    base = IDEAL | EXACT | drive_torque(300.0) | {"carrier.speed_command": speed, "scene.start": "rolling"}
    once = drive(base | brakes(torque))
    ramp(once, rate)
    once.step(time)
    assert once.read(["left.speed", "left.angle", "heat.brake"]) == pytest.approx(expected, rel=1e-9)
    assert once.residual() < 1e-9 * once["heat.brake"]
    # held constant in each step, work and angle follow the steps of torque
    steps, size, stepped = 200, time / 200, drive(base)
    angle = heat = 0.0
    for k in range(steps):
        held = torque + rate * (k + 0.5) * size
        stepped.set(brakes(held))
        stepped.step((k + 1) * size - stepped.time)
        speed, turned, made = slowed(held, 300.0, speed, size, 0.0)
        angle, heat = angle + turned, heat + made
    assert stepped.read(["left.speed", "left.angle", "heat.brake"]) == pytest.approx([speed, angle, heat], rel=1e-9)
    assert speed == pytest.approx(expected[0], rel=1e-9)


@pytest.mark.parametrize("lowest", [0.0, 30.0])
def test_held_wheels_slide_once_their_brakes_are_ramped_below_the_load(drive, lowest):
    """In one communication step the brake falls to `lowest` and remains there."""
    carried, rate = 50.0, -1000.0
    driven = drive(IDEAL | EXACT | brakes(200.0) | drive_torque(2.0 * carried) | {"scene.start": "rest"}).to(0.5, 1e-2)
    assert driven["held.wheels"] == 2.0
    spring = 2.0 * 0.5 * carried**2 / STIFFNESS
    before = driven["heat.brake"]
    ramp(driven, rate)
    if lowest:
        driven.step((lowest - 200.0) / rate)
        ramp(driven, 0.0)
        driven.set(brakes(lowest))
        driven.step(1.0 - driven.time)
    else:
        driven.step(0.5)
    begin, end = 0.5 + (carried - 200.0) / rate, 0.5 + (lowest - 200.0) / rate
    speed, _, heat = slowed(carried, 2.0 * carried, 0.0, end - begin, rate)
    more, _, later = slowed(lowest, 2.0 * carried, speed, 1.0 - end, 0.0)
    assert driven["left.speed"] == pytest.approx(more, rel=1e-5)
    assert driven["heat.brake"] - before == pytest.approx(heat + later + spring, rel=1e-5)
    assert driven["held.wheels"] == 0.0
    assert driven.imbalance() < 1e-6
    assert driven["solver.steps"] < 1000.0


def test_wheels_at_rest_are_held_by_a_torque_that_grows_from_nothing(drive):
    """Driven from rest, the wheels slide while T < T_e, and stop where ∫(T − T_e) dt = 0."""
    carried, rate = 50.0, 1000.0
    driven = drive(IDEAL | EXACT | brakes(0.0) | drive_torque(2.0 * carried) | {"scene.start": "rest"})
    ramp(driven, rate)
    driven.step(0.3)
    stop = 2.0 * carried / rate
    _, turned, _ = slowed(0.0, 2.0 * carried, 0.0, stop, rate)
    # they stop at T = 2 T_e, and the spring releases the part beyond T_e
    assert driven["held.wheels"] == 2.0
    assert driven["left.angle"] == pytest.approx(turned - carried / STIFFNESS, rel=1e-6)
    assert driven.imbalance() < 1e-6


@CONTACTS
def test_a_brake_that_is_released_while_it_holds_turns_its_spring_into_heat(drive, contact):
    carried = 50.0
    driven = drive(BRAKED | EXACT | brakes(750.0) | drive_torque(2.0 * carried)
                   | {"scene.start": "rest", "scene.gear_contact": contact}).to(1.0, 1e-2)
    before = driven["heat.brake"]
    driven.set(brakes(0.0))
    driven.to(1.1, 1e-2)
    assert driven["heat.brake"] - before == pytest.approx(carried**2 / STIFFNESS, rel=1e-6)
    assert driven["held.wheels"] == 0.0
    assert driven["left.speed"] == pytest.approx(2.0 * carried / WHOLE * 0.1, rel=0.01)
    # applied again while rolling
    driven.set(brakes(100.0))
    begin = wheel_angles(driven)
    driven.to(1.12, 1e-3)
    assert driven["heat.brake"] - before - carried**2 / STIFFNESS == pytest.approx(
        100.0 * (wheel_angles(driven) - begin).sum(), rel=1e-5)
    assert driven.imbalance() < 1e-6


@CONTACTS
def test_torques_are_read_with_the_brakes_that_were_just_set(drive, contact):
    driven = drive(BRAKED | drive_torque(100.0) | {"scene.gear_contact": contact, "carrier.speed_command": 20.0})
    driven.to(0.1, 1e-2)
    residual, before = driven["solver.energy_residual"], driven["left.acceleration"]
    driven.set(brakes(300.0, 0.0))
    delivered = 300.0 + END * driven["left.acceleration"]
    assert driven["left.shaft_torque"] == pytest.approx(delivered, rel=1e-9)
    assert driven["left.acceleration"] < before - 50.0
    assert driven["solver.energy_residual"] == residual


@CONTACTS
def test_a_state_saved_while_a_wheel_is_held_continues_with_the_same_bits(drive, contact):
    values = BRAKED | brakes(750.0, 20.0) | drive_torque(100.0) | {"scene.start": "rest", "scene.gear_contact": contact}

    def go_on(driven):
        driven.to(0.15, 1e-3).set(brakes(30.0, 20.0))
        return driven.to(0.2, 1e-3).read(OUTPUTS)

    driven = drive(values).to(0.1, 1e-3)
    assert driven["held.wheels"] == 1.0
    kept, within = driven.save(), driven.raw.getFMUstate()
    first = go_on(driven)
    driven.raw.setFMUstate(within)
    driven.raw.freeFMUstate(within)
    driven.time = kept[0]
    assert go_on(driven) == first
    assert go_on(driven.restore(kept)) == first
    assert go_on(drive(values).restore(kept)) == first


@CONTACTS
def test_without_the_effect_a_brake_torque_changes_no_bit(drive, contact):
    base = BRAKED | {"effects.wheel_brake": False, "scene.gear_contact": contact}
    runs = [drive(base | by | drive_torque(300.0)).to(0.1, 1e-3).read(OUTPUTS) for by in (brakes(0.0), brakes(500.0))]
    assert runs[0] == runs[1]


METHODS = {"adaptive": (1e-6, 500), "radau": (1e-6, 500), "fixed_step": (2e-3, 10_010)}


@pytest.mark.parametrize("method", METHODS)
def test_every_method_stops_a_wheel_at_the_same_angle(drive, method):
    tolerance, steps = METHODS[method]
    driven = drive(STOP | {"solver.method": method, "scene.start": "rolling"}).to(1.0, 1e-2)
    slip = 0.5 * 30.0**2 * WHOLE / (2.0 * 400.0 - 300.0)
    assert driven["held.wheels"] == 2.0
    assert driven["left.angle"] == pytest.approx(slip - (400.0 - 150.0) / STIFFNESS, rel=tolerance)
    assert driven["left.speed"] == pytest.approx(0.0, abs=1e-6)
    assert driven["solver.steps"] < steps


@pytest.fixture
def exchange(through_fmpy):
    """exchange(values, signals, stop): final speed and angle of the left wheel, heat and held wheels, by a solver of the host."""

    def run(values, signals, stop):
        names = ["left.speed", "left.angle", "heat.brake", "held.wheels"]
        record = through_fmpy(values, stop, fmi_type="ModelExchange", input=signals, relative_tolerance=1e-9, output=names,
                              solver="CVode")
        return [record[name][-1] for name in names]

    return run


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_solver_of_the_host_stops_a_wheel_as_that_of_the_fmu_does(drive, exchange, contact):
    values = BRAKED | brakes(400.0, 300.0) | drive_torque(300.0) | {"scene.gear_contact": contact,
                                                                     "carrier.speed_command": 5.0}
    own = drive(values | EXACT).to(0.3, 1e-3)
    speed, angle, heat, held = exchange(values, None, 0.3)
    assert held == own["held.wheels"] == 2.0
    assert angle == pytest.approx(own["left.angle"], rel=1e-4)
    assert heat == pytest.approx(own["heat.brake"], rel=1e-2)
    assert speed == pytest.approx(0.0, abs=1e-4)


def test_a_solver_of_the_host_follows_a_brake_that_is_ramped_up_from_nothing_and_released(exchange):
    """Continuous inputs whose brake begins and ends between events."""
    shape = [("time", float), ("left.brake_torque", float), ("right.brake_torque", float)]
    points = [(0.0, 0.0), (0.1, 0.0), (0.2, 400.0), (0.3, 0.0), (0.5, 0.0)]
    signals = np.array([(time, torque, torque) for time, torque in points], dtype=shape)
    values = IDEAL | drive_torque(300.0) | {"carrier.speed_command": 60.0, "scene.start": "rolling"}
    speed, angle, heat, held = exchange(values, signals, 0.5)
    omega, turned, made = 60.0, 0.0, 0.0
    for torque, rate, time in [(0.0, 0.0, 0.1), (0.0, 4000.0, 0.1), (400.0, -4000.0, 0.1), (0.0, 0.0, 0.2)]:
        omega, more, warm = slowed(torque, 300.0, omega, time, rate)
        turned, made = turned + more, made + warm
    assert held == 0.0
    assert [speed, angle] == pytest.approx([omega, turned], rel=1e-4)
    assert heat == pytest.approx(made, rel=1e-3)


def test_derivatives_by_the_brake_torque_are_those_of_the_closed_form(drive):
    driven = drive(STOP | {"scene.start": "rolling"}).to(0.02, 1e-2)
    known, unknown = ([driven.fmu.variable(name).reference for name in names]
                      for names in (brakes(0.0), ("left.acceleration", "left.shaft_torque")))
    # both wheels: −2/J of the total inertia J; each wheel's end keeps 1 − 2 J_w/J of its brake torque
    expected = [-2.0 / WHOLE, 1.0 - 2.0 * END / WHOLE]
    assert driven.raw.getDirectionalDerivative(unknown, known, [1.0, 1.0]) == pytest.approx(expected, rel=1e-6)
    ramp(driven, -700.0)
    driven.step(0.01)
    slopes = driven.raw.getRealOutputDerivatives(unknown, [1, 1])
    assert slopes == pytest.approx([-700.0 * slope for slope in expected], rel=1e-6)
    # a held wheel does not depend on its brake torque
    ramp(driven, 0.0)
    driven.to(1.0, 1e-2)
    assert driven["held.wheels"] == 2.0
    assert driven.raw.getDirectionalDerivative(unknown, known, [1.0, 1.0]) == pytest.approx([0.0, 0.0], abs=1e-9)
