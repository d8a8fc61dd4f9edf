"""Actuators of commanded clutches and of the lock: responses against a separate integration, saved states, model exchange, rates."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp


TORQUE, TAU = 300.0, 0.05
# the wheels have imposed speeds that differ, so both clutches slip
RIG = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "scene.gear_contact": "ideal",
       "effects.clutches": True, "clutches.torque": TORQUE, "left.speed_command": 50.0, "right.speed_command": 40.0,
       "clutches.response_time": TAU, "solver.relative_tolerance": 1e-8}
OUTPUTS = ["left.clutch_torque", "right.clutch_torque"]
# dead band, time of a full stroke and damping ratio
ACTUATORS = [(0.0, 0.0, 0.7), (0.1, 0.4, 1.0), (0.2, 0.15, 0.3), (0.05, 0.3, 2.5)]
# commands of the left and right clutch, and the times from which they hold
COMMANDS = [(0.0, 0.8, 0.15), (0.3, 0.4, 1.0), (0.6, 0.0, 0.05)]
STOP = 1.2


def values_of(dead_band, stroke, damping):
    return RIG | {"clutches.dead_band": dead_band, "clutches.stroke_time": stroke, "clutches.response_damping": damping}


def expected(side, points, dead_band, stroke, damping):
    """Output of the actuator at `points`, by an explicit method of order 8 between the corners of its input."""
    commands = [pair[1 + side] for pair in COMMANDS]
    target = [max(0.0, (u - dead_band) / (1.0 - dead_band)) for u in commands]
    limited, state, out = target[0], [target[0], 0.0], np.zeros(len(points))
    out[0] = target[0]
    ends = [time for time, *_ in COMMANDS[1:]] + [STOP]
    for (begin, *_), goal, end in zip(COMMANDS, target, ends):
        meets = begin + abs(goal - limited) * stroke
        for start, stop in ((begin, min(meets, end)), (min(meets, end), end)):
            if stop <= start:
                continue
            slope = np.sign(goal - limited) / stroke if start < meets and stroke else 0.0
            level = limited if slope else goal
            found = solve_ivp(
                lambda t, y: [y[1], (level + slope * (t - start) - y[0]) / TAU**2 - 2.0 * damping * y[1] / TAU],
                (start, stop), state, method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True)
            inside = (points > start) & (points <= stop + 1e-12)
            out[inside] = found.sol(points[inside])[0]
            state, limited = found.y[:, -1], level + slope * (stop - start)
    return np.maximum(out, 0.0)


def inputs():
    """Tables of both commands, which hold and jump."""
    times = [*np.repeat([time for time, *_ in COMMANDS], 2)[1:], STOP]
    return {f"{side}.clutch_command": (times, list(np.repeat([pair[1 + s] for pair in COMMANDS], 2)))
            for s, side in enumerate(("left", "right"))}


@pytest.mark.parametrize("method", [{}, {"solver.method": "fixed_step", "solver.fixed_step": TAU / 200}])
@pytest.mark.parametrize("actuator", ACTUATORS)
def test_responses_agree_with_a_separate_integration(run, actuator, method):
    found = run(values_of(*actuator) | method, STOP, output=OUTPUTS, inputs=inputs())
    points, first = np.unique(found["time"], return_index=True)
    for side, (name, sign) in enumerate(zip(OUTPUTS, (-1.0, 1.0))):
        # the faster wheel is braked, the slower one driven
        wanted = sign * TORQUE * expected(side, points, *actuator)
        # the clutches slip as soon as the half-shafts are wound up
        assert np.abs(found[name][first] - wanted)[points > 0.01].max() < 1e-6 * TORQUE, name
    assert np.ptp(found["right.clutch_torque"]) > 0.2 * TORQUE


def test_a_rate_of_a_command_passes_the_actuator(started):
    """A steady ramp lags behind by 2 zeta tau, and the rates of the torque are its differences."""
    damping, slope = 0.8, 0.5
    unit = started(values_of(0.0, 0.0, damping))
    unit.set_slopes({"left.clutch_command": slope})
    unit.step(1.0)
    torque = unit.get("left.clutch_torque")
    assert torque == pytest.approx(-TORQUE * (slope * 1.0 - 2.0 * damping * TAU * slope), rel=1e-6)


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_state_saved_during_a_response_continues_with_the_same_bits(started, contact):
    values = values_of(*ACTUATORS[1]) | {"scene.gear_contact": contact, "solver.relative_tolerance": 1e-6}
    names = [*OUTPUTS, "carrier.speed", "heat.clutch_command", "solver.energy_residual"]

    def follow(unit):
        rows = []
        for _ in range(20):
            unit.step(2e-3)
            rows.append(unit.read(names))
        return rows

    unit = started(values)
    unit.set({"left.clutch_command": 0.9, "right.clutch_command": 0.5})
    unit.step(0.0231)
    saved = unit.save()
    expected_rows = follow(unit)
    unit.restore(saved)
    assert follow(unit) == expected_rows


def test_model_exchange_agrees(through_fmpy):
    """The actuators are no continuous states: between completed steps, they follow their closed form."""
    values = values_of(*ACTUATORS[1]) | {"left.clutch_command": 0.0, "right.clutch_command": 0.0}
    signals = np.array([(0.0, 0.0, 0.0), (0.05, 0.0, 0.0), (0.05, 0.9, 0.4), (0.25, 0.9, 0.4), (0.25, 0.2, 0.0), (0.5, 0.2, 0.0)],
                       dtype=[("time", float), ("left.clutch_command", float), ("right.clutch_command", float)])
    own, theirs = (through_fmpy(values, 0.5, fmi_type=kind, input=signals, output=[*OUTPUTS, "carrier.speed"], **options)
                   for kind, options in (("CoSimulation", {}), ("ModelExchange", {"solver": "CVode", "relative_tolerance": 1e-8})))
    for name in (*OUTPUTS, "carrier.speed"):
        there = np.array([theirs[name][np.flatnonzero(np.abs(theirs["time"] - time) < 1e-9)[-1]] for time in own["time"]])
        assert np.abs(there - own[name]).max() < 1e-6 * np.abs(own[name]).max(), name


def test_the_lock_follows_its_actuator_in_small_steps(run):
    """The lock's limit is its command behind the actuator; it follows in steps of about one hundredth."""
    values = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "scene.gear_contact": "ideal",
              "left.speed_command": 50.0, "right.speed_command": 40.0, "lock.torque": TORQUE, "lock.response_time": TAU,
              "lock.stroke_time": 0.3, "lock.dead_band": 0.1}
    stop = 0.6
    found = run(values, stop, 5e-3, ["left.shaft_torque", "right.shaft_torque"],
                {"lock.command": ([0.0, 0.1, 0.1, stop], [0.0, 0.0, 0.7, 0.7])})
    points, first = np.unique(found["time"], return_index=True)
    limit = 0.5 * (found["right.shaft_torque"] - found["left.shaft_torque"])[first]
    goal = 0.6 / 0.9
    state = solve_ivp(lambda t, y: [y[1], (min(max(t - 0.1, 0.0) / 0.3, goal) - y[0]) / TAU**2 - 2.0 * y[1] / TAU],
                      (0.0, stop), [0.0, 0.0], rtol=1e-10, atol=1e-12, max_step=1e-3, t_eval=points)
    error = limit / TORQUE - state.y[0]
    assert np.abs(error).max() < 0.012 and np.abs(error[-1]) < 1e-3


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_actuated_clutch_holds_is_released_and_is_mirrored(run, sign):
    """A wheel that the clutch holds starts to slip when the output of the actuator has fallen to the torque that it carries."""
    values = {"scene.carrier_drive": "speed", "scene.right_drive": "torque", "scene.left_drive": "torque", "scene.gear_contact": "lumped",
              "carrier.speed_command": 30.0 * sign, "effects.clutches": True, "clutches.torque": TORQUE, "clutches.response_time": TAU,
              "left.clutch_command": 1.0, "left.load_torque": 60.0 * sign, "right.load_torque": -60.0 * sign}
    outputs = ["held.clutches", "left.clutch_torque", "solver.energy_residual"]
    found = run(values, 0.8, output=outputs, inputs={"left.clutch_command": ([0.0, 0.4, 0.4, 0.8], [1.0, 1.0, 0.0, 0.0])})
    assert found["held.clutches"][200] == 1.0
    assert found["left.clutch_torque"][200] == pytest.approx(120.0 * sign, rel=0.02)
    # critically damped: (1 + s) e^-s = 120/300
    late = found["time"][np.flatnonzero(found["held.clutches"] > 0.5)[-1]] - 0.4
    s = late / TAU
    assert (1.0 + s) * np.exp(-s) == pytest.approx(0.4, abs=0.02)
