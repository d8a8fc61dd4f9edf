"""A car that brakes to a stop and waits: the solver takes few steps, brakes hold, and hosts that integrate agree."""

import warnings

import numpy as np
import pytest
import theory
from bevel_differential import Differential

# both wheels start at 50 rad/s and are braked
STOP = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "scene.start": "rolling", "effects.wheel_brake": True,
        "carrier.torque_command": 0.0, "left.load_torque": 0.0, "right.load_torque": 0.0, "left.brake_torque": 100.0,
        "right.brake_torque": 100.0, "inertia.left_end": 1.0, "inertia.right_end": 1.0}
LAWS = {"lumped": {"scene.gear_contact": "lumped"}}
LAWS |= {law: {"scene.gear_contact": "tooth", "contact.law": law} for law in ["impact", "line", "line_weber"]}
LEVELS = {"ideal": {}} | LAWS | {"solid": {"scene.gear_contact": "solid"}}
WAYS = {"plain": {}, "half-shafts": {"effects.half_shaft": True}, "drag": {**theory.DRAG},
        "limited slip": {**theory.CLUTCHES, "limited_slip.torque_coefficient": 0.0}}
# friction of planets and drag of the carrier, which end the rattle of teeth
QUIET = {"effects.thrust_friction": True, **theory.DRAG}
# solver steps in two seconds at rest, in addition to one for each communication step
STANDING = 400


def loaded(torque):
    """Load torques of both wheels."""
    return {"left.load_torque": torque, "right.load_torque": torque}


def stopped(run, values, stop):
    """Record of a car that stops before half of the time; at the end the wheels are at rest and the brakes hold them."""
    record = run(STOP | values, stop, 0.1, ["left.wheel_speed", "right.wheel_speed", "solver.steps", "held.wheels", "power.in"])
    assert np.abs([record["left.wheel_speed"][-1], record["right.wheel_speed"][-1]]).max() < 1e-6
    assert record["held.wheels"][-1] == 2
    return record


def steps_in_last(record, seconds):
    """Solver steps in the last seconds of a record, less one for each communication step."""
    points = round(seconds / (record["time"][1] - record["time"][0]))
    return record["solver.steps"][-1] - record["solver.steps"][-1 - points] - points


@pytest.mark.parametrize("load", [0.0, 1e-9, 1e-3, 10.0])
@pytest.mark.parametrize("method", ["adaptive", "radau"])
@pytest.mark.parametrize("way", WAYS)
def test_braked_wheels_stop_and_stand(run, way, method, load):
    record = stopped(run, WAYS[way] | loaded(load) | {"solver.method": method}, 4.0)
    assert steps_in_last(record, 2.0) <= STANDING
    # braking from 50 rad/s takes half a second, and all of it takes a few hundred steps
    assert record["solver.steps"][-1] <= 400


def test_heavy_wheels_stop_and_stand(run):
    heavy = {"inertia.left_end": 60.0, "inertia.right_end": 60.0, "left.brake_torque": 1500.0, "right.brake_torque": 1500.0}
    assert steps_in_last(stopped(run, heavy, 6.0), 2.0) <= STANDING


@pytest.mark.parametrize("load", [0.0, 1e-9, 1e-3, 10.0])
@pytest.mark.parametrize("law", LAWS)
def test_teeth_come_to_rest_with_friction_and_drag(run, law, load):
    record = stopped(run, LAWS[law] | QUIET | loaded(load), 5.0)
    assert steps_in_last(record, 2.0) <= STANDING


@pytest.mark.parametrize("law", LAWS)
def test_gears_in_equilibrium_under_a_billionth_of_a_newton_metre_roll_on(run, law):
    record = run(LAWS[law] | loaded(1e-9) | {"scene.start": "equilibrium"}, 2.0, 0.1, ["left.speed", "carrier.speed", "solver.steps"])
    np.testing.assert_allclose(record["left.speed"], record["carrier.speed"], rtol=1e-9)
    assert record["solver.steps"][-1] <= 100


@pytest.mark.parametrize("load", [0.0, 30.0, -30.0])
@pytest.mark.parametrize("level", LEVELS)
def test_an_hour_parked_takes_one_step_a_second(fmu_file, level, load):
    parked = STOP | LEVELS[level] | loaded(load) | {"scene.start": "rest", "effects.half_shaft": True}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        car = Differential(parked, fmu=fmu_file)
    with car:
        record = car.run(outputs=["left.wheel_angle", "held.wheels", "solver.steps"], stop=3600.0, step=1.0)
    assert record["held.wheels"][-1] == 2
    # the spring of the brake winds up in the first second, and nothing creeps afterwards
    assert np.ptp(record["left.wheel_angle"][1:]) < 1e-9
    assert record["left.wheel_angle"][-1] == pytest.approx(-load / 1e5, rel=1e-6, abs=1e-12)
    assert record["solver.steps"][-1] <= 3600 + 100


@pytest.mark.parametrize("inertia", [1e-3, 1.0, 60.0])
@pytest.mark.parametrize("torque", [1e-3, 1.0, 1e4])
@pytest.mark.parametrize("stiffness", [1e3, 1e5, 1e9])
def test_brakes_of_any_stiffness_and_torque_stop_a_wheel(run, stiffness, torque, inertia):
    slow = min(50.0, 0.8 * torque / inertia)
    values = {"wheel_brake.stiffness": stiffness, "left.brake_torque": torque, "right.brake_torque": torque,
              "inertia.left_end": inertia, "inertia.right_end": inertia, "carrier.speed_command": slow}
    record = run(STOP | values, 2.0, 0.1, ["left.wheel_speed", "solver.steps"])
    # the smallest torque does not stop the lightest wheels before the gears, which have no brake
    assert record["solver.steps"][-1] <= 400


def test_rattle_is_reported_with_its_share_and_with_the_effects_that_end_it(fmu_file):
    """Planets without friction and a carrier without drag continue to bounce between the flanks when the wheels are at rest."""
    rattling = STOP | {"scene.gear_contact": "tooth", "contact.law": "line"}
    with Differential(rattling, fmu=fmu_file) as car:
        record = car.run(outputs=["solver.steps"], stop=2.0, step=0.1)
        texts = [text for text in car.warnings if "rattle" in text]
    assert record["solver.steps"][-1] > 10_000
    assert len(texts) == 1 and "effects.thrust_friction = true" in texts[0] and "effects.bearing_drag = true" in texts[0], texts
    with Differential(rattling | QUIET, fmu=fmu_file) as car:
        car.run(outputs=["solver.steps"], stop=2.0, step=0.1)
        assert not [text for text in car.warnings if "rattle" in text]


def random_stop(seed):
    """Values of a random stop of ideal gears, and its duration [s]."""
    r = np.random.default_rng(seed)
    inertia, stiffness = 10.0 ** r.uniform(-0.3, 1.9), 10.0 ** r.uniform(4.5, 6.0)
    torque = inertia * r.uniform(3.0, 60.0)
    torques = [torque, torque * r.choice([1.0, 1.0, 0.7, 1.4])]
    speed = r.uniform(0.5, 40.0) * r.choice([-1.0, 1.0])
    load = r.choice([0.0, 0.0, 0.3, -0.3]) * min(torques)
    values = {"carrier.speed_command": speed, "left.brake_torque": torques[0], "right.brake_torque": torques[1],
              "inertia.left_end": inertia, "inertia.right_end": inertia, "wheel_brake.stiffness": stiffness,
              "effects.half_shaft": bool(r.random() < 0.3)} | loaded(load)
    return values, 1.6 * abs(speed) * inertia / min(torques) + 0.1


def test_cvode_stops_where_the_fmu_s_solver_stops_and_brakes_hold(through_fmpy, request):
    """Random stops in model exchange. CVode often enters an event at a speed of zero or of a few ulps, with either sign."""
    outputs = ["left.wheel_speed", "right.wheel_speed", "left.angle", "right.angle", "held.wheels", "heat.brake"]
    for seed in range(request.config.getoption("--scenes") // 5):
        values, stop = random_stop(seed)
        values = STOP | values
        options = {"output_interval": stop / 400, "output": outputs}
        own = through_fmpy(values, stop, fmi_type="CoSimulation", **options)
        tolerance = 10.0 ** np.random.default_rng(seed).uniform(-7.0, -4.5)
        theirs = through_fmpy(values, stop, fmi_type="ModelExchange", solver="CVode", relative_tolerance=tolerance,
                              record_events=True, **options)
        assert own["held.wheels"][-1] == 2 and theirs["held.wheels"][-1] == 2, seed
        for s, side in enumerate(["left", "right"]):
            expected = np.interp(theirs["time"], own["time"], own[f"{side}.angle"])
            apart = np.abs(theirs[f"{side}.angle"] - expected).max()
            assert apart < 0.01 * np.abs(expected).max(), (seed, side, apart)
            # a holding brake turns a wheel back by no more than the wind-up of its spring, at the speed of that spring
            rate = (values["wheel_brake.stiffness"] / values[f"inertia.{side}_end"]) ** 0.5
            wound = values[f"{side}.brake_torque"] / values["wheel_brake.stiffness"]
            first = np.argmax(theirs["held.wheels"] == 2)
            back = np.abs(theirs[f"{side}.wheel_speed"][first:]).max()
            assert back < 2.0 * wound * rate, (seed, side, back)
        heat = theirs["heat.brake"]
        springs = sum(0.5 * values[f"{side}.brake_torque"] ** 2 / values["wheel_brake.stiffness"] for side in ["left", "right"])
        assert np.max(np.maximum.accumulate(heat) - heat) <= 1.001 * springs + 1e-6 * heat.max(), seed
