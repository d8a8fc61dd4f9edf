"""`Car`: contact patches deflect only until they slide, so a tyre returns no more energy than it stores."""

from math import sin

import numpy as np
import pytest
from bevel_differential.vehicle import Body, Car, Motor, Tyre
from bevel_differential.vehicle.equations import patch_rate, patch_slip, tyre_force, tyre_full_slide
from bevel_differential.vehicle.motion import Motion
from scipy.integrate import solve_ivp
from test_vehicle import magic

BRAKED = {"scene.gear_contact": "ideal", "effects.wheel_brake": True}
OUTPUTS = ["body.speed", "body.lateral_speed", "body.yaw_rate", "left.wheel_speed", "left_tyre.slip", "left_tyre.force"]
MASS = Body().mass
# communication step [s]
STEP = 2e-3
# Speed at rest [m/s], and time in which a stopped car comes to rest [s].
REST, SETTLES = 0.01, 3.0


def stored(tyre, slip):
    """Energy [J] that a tyre stores at a slip: the integral of its force over its deflection. Up to two thirds of the deflection
    3 μ F_z/C of a sliding brush the patch adheres; the sliding fraction then grows with a square up to 1."""
    y = np.linspace(0.0, 1.0, 20001)[:-1]
    most, sliding = 3.0 * tyre.friction * tyre.load / tyre.slip_stiffness, np.maximum(3.0 * y - 2.0, 0.0) ** 2
    slips = most * y / (1.0 - sliding)
    forces = np.array([magic(tyre, each) for each in slips])
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (forces[1:] + forces[:-1]))]) * most * tyre.relaxation * y[1]
    return float(np.interp(abs(slip), slips, energy))


def stopping(fmu, frictions, brake, speed, stop):
    """Record of a stop by brakes on both wheels [N.m], and the instant of standstill."""
    car = Car(BRAKED, left=Tyre(friction=frictions[0]), right=Tyre(friction=frictions[1]), fmu=fmu)
    brakes = {"left.brake_torque": brake, "right.brake_torque": brake}
    record = car.run(OUTPUTS, stop, STEP, speed=speed, controller=lambda *_: brakes)
    return car, record, int(np.argmax(np.sign(speed) * record["body.speed"] < 0.0))


def time_to_rest(record, name, stand):
    moving = np.flatnonzero(np.abs(record[name]) > REST)
    return record["time"][max(moving[-1], stand) if len(moving) else stand] - record["time"][stand]


@pytest.mark.parametrize("friction, brake, speed", [(0.9, 3000.0, 2.5), (0.15, 3000.0, 0.5), (0.9, 600.0, 1.5)])
def test_a_stopped_car_gets_back_at_most_the_energy_of_its_tyres_and_comes_to_rest(fmu, friction, brake, speed):
    car, record, stand = stopping(fmu, (friction, friction), brake, speed, 4.0)
    assert 0 < stand * STEP < 4.0 - SETTLES
    back = 0.5 * MASS * record["body.speed"][stand:].min() ** 2
    # tyres are springs, so they return most of it
    assert 0.5 < back / (2.0 * stored(car.tyres[0], record["left_tyre.slip"][stand])) <= 1.0
    assert time_to_rest(record, "body.speed", stand) < SETTLES


def test_a_car_that_drives_backward_stops_as_the_mirror_image(fmu):
    (_, ahead, _), (_, back, _) = (stopping(fmu, (0.9, 0.9), 3000.0, speed, 0.6) for speed in (1.5, -1.5))
    assert np.abs(ahead["body.speed"][-1]) > 0.1
    for name in ("body.speed", "left_tyre.slip", "left_tyre.force"):
        assert np.array_equal(ahead[name], -back[name])


def test_after_a_stop_on_uneven_friction_no_motion_remains(fmu):
    _, record, stand = stopping(fmu, (0.15, 0.9), 3000.0, 2.0, 4.0)
    assert 0 < stand * STEP < 4.0 - SETTLES and np.abs(record["body.yaw_rate"]).max() > 0.05
    for name in ("body.speed", "body.lateral_speed", "body.yaw_rate"):
        assert time_to_rest(record, name, stand) < SETTLES


@pytest.mark.parametrize("friction, speed", [(0.15, 10.0), (0.9, 3.0), (0.9, -25.0)])
def test_a_locked_wheel_slides_with_the_force_of_slip_one(fmu, friction, speed):
    car, record, _ = stopping(fmu, (friction, friction), 3000.0, speed, 0.25)
    sliding = record[(record["time"] > 0.15) & (np.abs(record["body.speed"]) > 2.0)]
    assert len(sliding) > 40 and np.abs(sliding["left.wheel_speed"]).max() < 1e-3
    assert sliding["left_tyre.force"] == pytest.approx(-np.sign(speed) * magic(car.tyres[0], 1.0), rel=0.01)
    assert sliding["left_tyre.slip"] == pytest.approx(-np.sign(speed), rel=0.01)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_wheel_that_spun_and_is_held_does_no_more_work_than_its_tyre_stored(fmu, sign):
    car = Car(BRAKED, left=Tyre(friction=0.15), right=Tyre(friction=0.9), fmu=fmu)
    record = car.run(OUTPUTS, 1.2, 1e-3, request=([0.0, 0.3, 0.5, 0.5], [0.0, sign * 120.0, sign * 120.0, 0.0]),
                     controller=lambda time, _: {"left.brake_torque": 800.0 if time > 0.5 else 0.0})
    speed, rolling, force = (sign * record[name] for name in ("body.speed", "left.wheel_speed", "left_tyre.force"))
    assert rolling.max() * car.tyres[0].radius > 20.0 and rolling[-1] < 0.01 < 0.1 < speed[-1]
    slower = (car.tyres[0].radius * rolling < speed) & (record["time"] > 0.5)
    work = np.trapezoid(np.where(slower, np.maximum(force * speed, 0.0), 0.0), record["time"])
    assert slower.sum() > 200 and work <= stored(car.tyres[0], 100.0)
    assert force[-1] == pytest.approx(-magic(car.tyres[0], 1.0), rel=0.01)


def held(body, tyres, x, end):
    """States of the parts every millisecond with both wheels held, from `x` on."""
    motion, states = Motion(Motor(), tyres, body, 0.0), []
    motion.x[:] = x
    for _ in range(round(end / 1e-3)):
        states.append(list(motion.x))
        motion.advance(1e-3, lambda _: (0.0, 0.0, 0.0), lambda _: 0.0, lambda _: 0.0)
    return np.array(states)


def test_a_car_that_slid_sideways_is_not_thrown_back():
    body, tyres = Body(), (Tyre(), Tyre())
    aside, mirrored = (held(body, tyres, [0.0, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0], 4.0)[:, 4] for speed in (4.0, -4.0))
    assert np.array_equal(aside, -mirrored)
    stand = int(np.argmax(aside < 0.0))
    # the deflection of an axle is at most 3 F_max/C relaxation lengths, and its force at most F_max
    grip, length = body.grip * 9.80665 * body.mass, body.front + body.rear
    limits = grip * body.rear / length, grip * body.front / length
    energy = sum(3.0 * limit**2 / stiffness * body.relaxation
                 for limit, stiffness in zip(limits, (body.front_stiffness, body.rear_stiffness)))
    assert 0 < stand < 700 and 0.01 * energy < 0.5 * body.mass * aside[stand:].min() ** 2 < energy
    assert np.abs(aside[stand + round(SETTLES / 1e-3):]).max() < REST


def test_held_tyres_never_return_more_energy_than_they_store():
    """Random motion of the road under a held tyre, of all sizes."""
    random, tyre = np.random.default_rng(7), Tyre(friction=0.5)
    full, h = tyre_full_slide(tyre), 2e-5
    for size in (0.02, 0.1, 0.5, 3.0):
        amplitudes, rates, phases = size * random.normal(size=4), random.uniform(2.0, 60.0, 4), random.uniform(0.0, 6.0, 4)
        speeds = np.sum(amplitudes[:, None] * np.cos(np.outer(rates, h * np.arange(25_000)) + phases[:, None]), axis=0)
        u, work, energy = 0.0, 0.0, 0.0
        for speed in speeds.tolist():
            slip = patch_slip(u, full)
            # work of the tyre on the car since the patch had no deflection, at most 0
            work += h * tyre_force(tyre, slip, 0.0, speed) * speed
            u += h * patch_rate(u, full, tyre.relaxation, -speed, speed)
            energy = max(energy, work)
        assert abs(u) <= full and work < 0.0
        assert energy <= 1e-3 * abs(work), (size, energy, work)


@pytest.mark.parametrize("friction", [0.1, 0.9])
def test_fast_wheel_spin_is_integrated_as_a_solver_with_variable_steps_does(friction):
    tyre, ahead = Tyre(friction=friction), 2.0
    motion = Motion(Motor(), (tyre, tyre), Body(mass=1e9), ahead)
    full = tyre_full_slide(tyre)

    def rolling(time):
        return ahead + 60.0 * sin(30.0 * time)

    for k in range(150):
        motion.advance(1e-3, lambda t, k=k: [rolling(1e-3 * k + t) / tyre.radius] * 3, lambda _: 0.0, lambda _: 0.0)
    right = solve_ivp(lambda t, u: [patch_rate(u[0], full, tyre.relaxation, rolling(t) - ahead, ahead)], (0.0, 0.15), [0.0], "LSODA",
                      rtol=1e-10, atol=1e-14).y[0, -1]
    assert motion.x[1] == pytest.approx(right, rel=1e-4)


def test_a_spinning_wheel_of_a_standing_car_has_a_finite_slip():
    tyre = Tyre(friction=0.15)
    assert patch_slip(tyre_full_slide(tyre), tyre_full_slide(tyre)) == 100.0
    assert patch_slip(-2.0 * tyre_full_slide(tyre), tyre_full_slide(tyre)) == -100.0
