"""Dog clutches: engagement against the kinematics of imposed speeds, lash, release, waiting, energy, mirror images."""

import numpy as np
import pytest

from bevel_differential import Differential

TEETH, LASH, MOST_SPEED, MOST_TORQUE, STIFFNESS = 24, 0.02, 5.0, 20.0, 1e4
PITCH = 2.0 * np.pi / TEETH
DOG = {"effects.disconnect": True, "disconnect.sides": "right", "disconnect.teeth": TEETH, "disconnect.lash": LASH,
       "disconnect.most_speed": MOST_SPEED, "disconnect.most_torque": MOST_TORQUE, "half_shaft.right_stiffness": STIFFNESS}
# both wheels have imposed speeds, and the carrier is so heavy that it keeps its speed; so does the right side gear
RIG = DOG | {"scene.carrier_drive": "torque", "inertia.carrier": 1e3, "carrier.torque_command": 0.0,
             "scene.left_drive": "speed", "scene.right_drive": "speed", "scene.gear_contact": "ideal",
             "left.speed_command": 50.0, "right.speed_command": 50.0, "right.dog_command": 0.0,
             "solver.relative_tolerance": 1e-8}
OPEN, SPEED, GAP, CLOSED, TORQUE = range(5)
OUTPUTS = ["right.dog_phase", "right.shaft_torque", "right.twist", "heat.disconnect", "solver.energy_residual"]


def engages(turned, slip, times, commanded):
    """First time at which the command is on, the slip small, and a tooth within a gap."""
    off = np.abs(turned - PITCH * np.round(turned / PITCH))
    ready = (times >= commanded) & (np.abs(slip) <= MOST_SPEED) & (off <= 0.5 * LASH)
    return times[np.argmax(ready)] if ready.any() else np.inf


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("seed", range(5))
def test_the_teeth_engage_in_the_first_gap_at_a_small_difference_of_speeds(run, seed, sign):
    drawn = np.random.default_rng(seed)
    first, last, commanded = drawn.uniform(6.0, 30.0), drawn.uniform(-4.0, 4.0), drawn.uniform(0.05, 0.4)
    times, stop = np.linspace(0.0, 1.5, 1_500_001), 1.5
    # the wheel starts with the gears and soon lags behind; its speed then approaches theirs
    corners = [0.0, 0.04, 1.0, stop]
    slip = np.interp(times, corners, [0.0, first, last, last])
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (slip[1:] + slip[:-1]) * np.diff(times))])
    wanted = engages(turned, slip, times, commanded)
    wheel = {"right.speed_command": (corners, [sign * (50.0 - s) for s in (0.0, first, last, last)]),
             "right.dog_command": ([0.0, commanded, commanded, stop], [0.0, 0.0, 1.0, 1.0])}
    values = RIG | {name: sign * RIG[name] for name in ("left.speed_command", "right.speed_command")}
    found = run(values, stop, output=OUTPUTS, inputs=wheel)
    phase, time = found["right.dog_phase"], found["time"]
    assert set(phase[time < commanded]) == {OPEN}
    if not np.isfinite(wanted):
        assert CLOSED not in phase
        return
    closed = time[np.argmax(phase == CLOSED)]
    # the record has a point in each millisecond
    assert wanted - 1e-6 <= closed <= wanted + 1.1e-3
    waiting = phase[(time > commanded) & (time < wanted - 1e-3)]
    assert set(waiting) <= {SPEED, GAP}
    # it transmits no torque until the lash is taken up, and then the torque of the shaft
    after = np.flatnonzero(phase == CLOSED)
    twist, torque = found["right.twist"][after], found["right.shaft_torque"][after]
    assert abs(torque[0]) < 1e-6 or abs(twist[0]) > 0.5 * LASH
    assert np.abs(found["solver.energy_residual"]).max() < 1e-7 * 0.5 * 1e3 * 50.0**2


def test_a_closed_clutch_is_a_shaft_with_lash_and_opens_at_low_torque(run):
    """The wheel turns back and forth: torque over twist has the lash, and the released energy is heat."""
    values = RIG | {"right.dog_command": 1.0, "half_shaft.right_damping": 1.0}
    wheel = {"right.speed_command": ([0.0, 0.1, 0.1, 0.3, 0.3, 0.6], [50.0, 50.0, 49.7, 49.7, 50.2, 50.2]),
             "right.dog_command": ([0.0, 0.25, 0.25, 0.6], [1.0, 1.0, 0.0, 0.0])}
    found = run(values, 0.6, output=OUTPUTS, inputs=wheel)
    twist, torque, phase, time = (found[name] for name in ("right.twist", "right.shaft_torque", "right.dog_phase", "time"))
    steady = (time > 0.12) & (time < 0.29)
    depth = np.sign(twist) * np.maximum(np.abs(twist) - 0.5 * LASH, 0.0)
    assert np.abs(torque - STIFFNESS * depth)[steady].max() < 1.0
    assert torque[steady].max() > 10.0 * MOST_TORQUE
    assert set(phase[(time > 0.251) & (time < 0.3)]) == {TORQUE}
    assert phase[-1] == OPEN and not torque[-1] and not twist[-1]
    # a fraction of the limit torque is that of the damper
    released = torque[phase == TORQUE][-1]
    assert MOST_TORQUE < released < MOST_TORQUE + 1e-3 * 0.5 * STIFFNESS + 1.0
    assert found["heat.disconnect"][-1] == pytest.approx(MOST_TORQUE**2 / (2.0 * STIFFNESS), rel=0.03)


def test_radau_takes_a_light_gear_along_as_the_default_method_does(run):
    """At rest, the wheel creeps through the lash. Its teeth touch those of a gear without load, whose acceleration jumps."""
    values = RIG | {"right.dog_command": 1.0, "half_shaft.right_damping": 100.0, "left.speed_command": 0.0, "right.speed_command": 0.0,
                    "inertia.carrier": 0.1}
    wheel = {"right.speed_command": ([0.0, 0.01, 0.3], [0.0, 0.3, 0.3])}
    twists = [run(values | {"solver.method": method}, 0.3, output=OUTPUTS, inputs=wheel)["right.twist"] for method in ("adaptive", "radau")]
    assert np.ptp(twists[0]) > 0.5 * LASH and np.abs(twists[0] - twists[1]).max() < 1e-6


def test_tooth_on_tooth_at_equal_speeds_waits_for_ever(run):
    """The wheel turns by half a pitch, and then as fast as its side gear."""
    back = PITCH / 0.1
    wheel = {"right.speed_command": ([0.0, 0.05, 0.1, 3600.0], [50.0, 50.0 - back, 50.0, 50.0]),
             "right.dog_command": ([0.0, 0.2, 0.2, 3600.0], [0.0, 0.0, 1.0, 1.0])}
    found = run(RIG, 3600.0, 10.0, OUTPUTS, wheel)
    assert set(found["right.dog_phase"][found["time"] > 1.0]) == {GAP}
    assert not found["right.shaft_torque"].any()


# the wheels have inertia and loads, the carrier is driven by torque
FREE = DOG | {"effects.half_shaft": True, "inertia.left_end": 2.0, "inertia.right_end": 2.0, "scene.gear_contact": "ideal",
              "scene.carrier_drive": "torque", "scene.left_drive": "torque", "scene.right_drive": "torque", "carrier.speed_command": 40.0,
              "disconnect.ratchet_torque": 5.0}


def test_random_engagements_end_closed_or_wait_for_a_reason(run):
    """200 drives: the clutch opens, the wheel slows down or not, and the clutch is closed again, in both directions."""
    for seed in range(200):
        drawn = np.random.default_rng(seed)
        sign = drawn.choice([-1.0, 1.0])
        contact = drawn.choice(["ideal", "lumped"], p=[0.8, 0.2])
        load, brake = drawn.uniform(20.0, 200.0), drawn.uniform(0.0, 200.0)
        opened, closed, stop = 0.05, drawn.uniform(0.2, 0.5), 1.5
        values = FREE | {"scene.gear_contact": contact, "carrier.speed_command": 40.0 * sign, "right.dog_command": 1.0,
                         "disconnect.teeth": int(drawn.integers(8, 60)), "disconnect.lash": drawn.uniform(0.005, 0.05),
                         "disconnect.most_speed": drawn.uniform(1.0, 20.0), "carrier.torque_command": 2.0 * load * sign,
                         "left.load_torque": load * sign, "right.load_torque": load * sign}
        drives = {"right.dog_command": ([0.0, opened, opened, closed, closed, stop], [1.0, 1.0, 0.0, 0.0, 1.0, 1.0]),
                  "carrier.torque_command": ([0.0, opened, opened, stop], [2.0 * load * sign, 2.0 * load * sign, 0.0, 0.0]),
                  "right.load_torque": ([0.0, opened, opened, closed, closed, stop],
                                        [load * sign, load * sign, brake * sign, brake * sign, 0.0, 0.0]),
                  "left.load_torque": ([0.0, opened, opened, stop], [load * sign, load * sign, 0.0, 0.0])}
        found = run(values, stop, 5e-3, [*OUTPUTS, "right.speed", "right.wheel_speed"], drives)
        phase = found["right.dog_phase"]
        assert phase[0] == CLOSED and phase[-1] in (SPEED, GAP, CLOSED), (seed, phase[-1])
        slip = abs(found["right.speed"][-1] - found["right.wheel_speed"][-1])
        assert (phase[-1] == SPEED) == (phase[-1] != CLOSED and slip > values["disconnect.most_speed"]), seed
        assert np.diff(found["heat.disconnect"]).min() > -1e-9, seed
        # kinetic energy of two wheels is the measure
        assert np.abs(found["solver.energy_residual"]).max() < 1e-4 * 2.0 * 40.0**2, seed


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_drives_are_mirrored_and_continue_from_saved_states(started, contact):
    def run(sign):
        values = FREE | {"scene.gear_contact": contact, "carrier.speed_command": 40.0 * sign, "right.load_torque": 60.0 * sign,
                         "left.load_torque": 60.0 * sign, "carrier.torque_command": 120.0 * sign, "right.dog_command": 1.0}
        rows = []
        unit = started(values)
        for k in range(240):
            if k == 20:
                unit.set({"right.dog_command": 0.0, "carrier.torque_command": 0.0,
         "left.load_torque": 0.0})
            if k == 60:
                unit.set({"right.dog_command": 1.0, "right.load_torque": -10.0 * sign})
            if k in (40, 80):
                unit.restore(unit.save())
            unit.step(2e-3)
            rows.append(unit.read(["right.dog_phase", "right.shaft_torque", "right.wheel_speed", "heat.disconnect"]))
        return np.array(rows)

    forward, backward = run(1.0), run(-1.0)
    assert set(forward[:, 0]) >= {OPEN, CLOSED}
    factor = np.array([1.0, -1.0, -1.0, 1.0])
    assert np.array_equal(forward, factor * backward) or np.abs(forward - factor * backward).max() < 1e-6


def test_model_exchange_agrees(through_fmpy):
    values = FREE | {"carrier.torque_command": 120.0, "left.load_torque": 60.0, "right.load_torque": 60.0, "right.dog_command": 1.0}
    signals = np.array([(0.0, 1.0, 60.0), (0.1, 1.0, 60.0), (0.1, 0.0, 60.0), (0.2, 0.0, 60.0), (0.2, 1.0, -30.0), (0.6, 1.0, -30.0)],
                       dtype=[("time", float), ("right.dog_command", float), ("right.load_torque", float)])
    outputs = ["right.dog_phase", "right.wheel_speed", "left.wheel_speed"]
    own, theirs = (through_fmpy(values, 0.6, fmi_type=kind, input=signals, output=outputs, **options)
                   for kind, options in (("CoSimulation", {}), ("ModelExchange", {"solver": "CVode", "relative_tolerance": 1e-8})))
    assert own["right.dog_phase"][-1] == theirs["right.dog_phase"][-1] == CLOSED
    switch = [run["time"][np.flatnonzero(run["right.dog_phase"] == CLOSED)] for run in (own, theirs)]
    again = [times[times > 0.2][0] for times in switch]
    assert abs(again[0] - again[1]) < 2e-3
    for name in outputs[1:]:
        assert abs(own[name][-1] - theirs[name][-1]) < 1e-2 * abs(own[name][-1]), name


def test_a_clutch_without_a_wheel_of_its_own_is_refused(fmu):
    with pytest.raises(Exception, match=r"effects.disconnect.*the right wheel cannot turn separately"):
        Differential(DOG, fmu=fmu.file).run(outputs=["left.speed"], stop=0.01)
    with pytest.raises(Exception, match=r"disconnect.lash: 17.188734 deg is not below the pitch of disconnect.teeth = \d+, [\d.]+ deg"):
        Differential(RIG | {"disconnect.lash": 0.3}, fmu=fmu.file).run(outputs=["left.speed"], stop=0.01)
