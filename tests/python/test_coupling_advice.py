"""Advice about the communication step: energy errors against an exact exchange, the advice followed, and warnings only for real causes."""

import math
import random

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.coupling import Host as Spring
from bevel_differential.coupling import coupling
from bevel_differential.vehicle import Car, Tyre
from coupled_hosts import ADVISED, ERRORS, FREE, LAG, LOADS, MOTION, Coupled, Host, couple

ADVICE = ["coupling.energy_ratio", "coupling.step_advice"]
# meanings of coupling.advice_state
STATE = "coupling.advice_state"
GIVEN, STILL, NO_REACTION, NOT_POSSIBLE, UNSTABLE = 1.0, 2.0, 3.0, 4.0, 5.0


def shaft():
    return {"left": Host(9000.0, 12.0, 5.0, 2.0, speed=0.0)}, {"carrier.torque_command": 60.0}


def both_sides():
    return {"left": Host(500.0, 6.0, 2.0, 1.0, speed=0.0), "right": Host(800.0, 8.0, 3.0, 0.5, speed=20.0)}, {
        "carrier.torque_command": 100.0}


def motor():
    return {"carrier": Host(2000.0, 10.0, 0.5, 0.2, lambda time: 40.0 + 80.0 * math.sin(20.0 * time), sign=-1.0)}, {
        "left.load_torque": 15.0, "right.load_torque": 12.0}


def swing():
    return {"right": Host(300.0, 2.0, 50.0, speed=3.0)}, {"carrier.speed_command": 0.0}


SYSTEMS = {made.__name__: made for made in (shaft, both_sides, motor, swing)}
BRAKES = ["left.brake_torque", "right.brake_torque"]
EXCHANGES = [(0, False), (1, False), (0, True), (1, True)]
ORDERS = [(0, False, 1), (1, False, 1), (0, True, 2)]
SIZE = 4e-4


@pytest.fixture
def coupled(fmu):
    """coupled(system, size, delay, lines, **values): run of 1 s."""
    def run(system, size, delay, lines, stop=1.0, **more):
        hosts, values = SYSTEMS[system]()
        return couple(fmu, hosts, size, stop, delay=delay, lines=lines, values=values | more)

    return run


@pytest.mark.parametrize(("delay", "lines"), EXCHANGES)
@pytest.mark.parametrize("system", ["shaft", "both_sides", "motor"])
def test_the_energy_error_is_that_of_the_exact_exchange(coupled, system, delay, lines):
    run = coupled(system, SIZE, delay, lines)
    for port, errors in run.errors.items():
        assert errors[-1] == pytest.approx(run.exact[port][-1 - LAG], rel=0.1), port


@pytest.mark.parametrize(("delay", "lines", "order"), ORDERS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_half_the_step_halves_the_ratio_or_quarters_it(coupled, system, delay, lines, order):
    whole, half = (coupled(system, size, delay, lines).ratio[-1] for size in (SIZE / 2, SIZE / 4))
    assert whole / half == pytest.approx(2**order, rel=0.15)


@pytest.mark.parametrize(("delay", "lines", "order"), ORDERS)
@pytest.mark.parametrize("system", [name for name in SYSTEMS if name != "motor"])
def test_the_advised_step_gives_the_wanted_ratio(coupled, system, delay, lines, order):
    # steps in which the ratio is too large
    wanted = 0.3 * coupled(system, SIZE / 2, delay, lines).ratio[-1]
    advice = coupled(system, SIZE / 2, delay, lines, **{"coupling.wanted_ratio": wanted}).advice[-1]
    followed = coupled(system, 1.0 / round(1.0 / advice), delay, lines)
    assert wanted / 1.5 < followed.ratio[-1] < 1.5 * wanted


@pytest.mark.parametrize(("delay", "lines", "order"), ORDERS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_the_advice_is_never_longer_than_the_present_step(coupled, system, delay, lines, order):
    # one step size cannot show that a longer one is stable
    advice = coupled(system, SIZE / 2, delay, lines, **{"coupling.wanted_ratio": 0.5}).advice
    assert max(advice) == pytest.approx(SIZE / 2, rel=1e-9)


def test_a_launch_gets_advice_although_the_wheels_accelerate(fmu):
    # the springs oscillate with a period of 0.2 s while their inertias accelerate
    hosts = {side: Host(900.0, 3.0, 2.0, 0.5, speed=0.0) for side in ("left", "right")}
    run = couple(fmu, hosts, 5e-4, 1.0, values={"scene.start": "rest", "carrier.torque_command": 50.0})
    assert min(run.advice[600:]) > 0.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_hour_at_a_standstill_changes_nothing_and_the_advice_returns(started, sign):
    host = Host(500.0, 0.5, 1.0, 0.2)

    def drive(port, torque, steps):
        rows = [port.read()]
        for _ in range(steps):
            before = rows[-1][:2]
            rows.append(port.step([sign * torque, host.torque(*before)], 1e-3))
            host.advance(1e-3, before, rows[-1][:2])
        return np.array(rows)[:, 2:]

    instance = started(ADVISED | {"effects.wheel_brake": True, "scene.start": "rest"})
    port = instance.port(["carrier.torque_command", LOADS["left"]], [*MOTION["left"], *ERRORS, *ADVICE])
    host.start(*port.read()[:2])
    first = drive(port, 20.0, 2000)
    instance.set(dict.fromkeys(BRAKES, 300.0))
    host.damping = 20.0
    held = drive(port, 0.0, 3000)
    waited = [port.step([0.0, 0.0], 36.0)[2:] for _ in range(100)]
    assert waited[-1][:-1] == pytest.approx(held[-1, :-1], rel=1e-6) and waited[-1][-1] == 0.0
    instance.set(dict.fromkeys(BRAKES, 0.0))
    host.damping = 0.5
    again = drive(port, 20.0, 2000)
    assert not [message for message in instance.messages if "coupling" in message]
    assert first[-1, -1] > 0.0 and again[-1, -1] > 0.0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_reversal_keeps_the_advice(started, sign):
    host, size, states = Host(500.0, 0.5, 1.0, 0.2), 1e-3, []
    instance = started(ADVISED | {"scene.start": "rest"})
    port = instance.port(["carrier.torque_command", LOADS["left"]], [*MOTION["left"], STATE])
    row = port.read()
    host.start(*row[:2])
    for step in range(4000):
        before = row[:2]
        row = port.step([sign * (20.0 if step < 2000 else -20.0), host.torque(*before)], size)
        host.advance(size, before, row[:2])
        states.append(row[2])
    assert states[2000:].count(GIVEN) > 0.9 * 2000


@pytest.mark.parametrize("gears", ["ideal", "lumped"])
def test_wheels_that_stand_in_their_brakes_get_no_old_advice(started, gears):
    host, size = Host(500.0, 0.5, 1.0, 0.2), 1e-3
    instance = started(ADVISED | {"effects.wheel_brake": True, "scene.gear_contact": gears, "contact.law": "line", "scene.start": "rest"})
    port = instance.port(["carrier.torque_command", *BRAKES, LOADS["left"]], [*MOTION["left"], STATE, ADVICE[1]])
    row = port.read()
    host.start(*row[:2])
    for step in range(3000):
        before, brake = row[:2], 0.0 if step < 1000 else 300.0
        row = port.step([20.0 if step < 1000 else 0.0, brake, brake, host.torque(*before)], size)
        host.advance(size, before, row[:2])
        if step == 999:
            assert row[2] == GIVEN and row[3] > 0.0
            # the inertia behind the spring soon stands, too
            host.damping = 20.0
    assert row[2:] == [STILL, 0.0]


def test_an_exchange_without_an_energy_error_has_no_advice_and_says_so(started):
    # a spring behind a Gauss-Seidel master
    run, host, angle = [], Host(500.0, 0.5, 1e3), 0.0
    instance = started(ADVISED | {"coupling.host_delay": -0.5, "scene.start": "rest"})
    port = instance.port(["carrier.torque_command", LOADS["left"]], [MOTION["left"][1], STATE, ADVICE[1]])
    row = port.read()
    for _ in range(600):
        angle += 1e-3 * row[0]
        row = port.step([20.0, host.stiffness * angle + host.damping * row[0]], 1e-3)
        run.append(row[1:])
    assert run[-1] == [NOT_POSSIBLE, 0.0]


def test_inputs_with_derivatives_are_no_ramps(coupled):
    def end(ramps):
        run = coupled("shaft", SIZE, 0, True, stop=0.1, **{"solver.input_ramp": ramps})
        return run.errors["left"][-1], run.ratio[-1]

    assert end(True) == end(False)


@pytest.mark.parametrize("wanted", [1e-4, 2e-5])
def test_a_car_that_follows_the_advice_has_the_wanted_ratio(fmu, wanted):
    car = Car({"contact.law": "line", "effects.coupling_advice": True, "coupling.wanted_ratio": wanted}, left=Tyre(friction=0.15),
              right=Tyre(friction=0.9), fmu=fmu)

    def end(step):
        return car.run(ADVICE, stop=1.0, step=step, request=([0.0, 0.3], [0.0, 120.0]))[-1]

    followed = end(end(5e-4)["coupling.step_advice"])
    assert wanted / 1.5 < followed["coupling.energy_ratio"] < 1.5 * wanted


def test_a_car_records_the_state_of_the_advice(fmu):
    car = Car({"contact.law": "line", "effects.coupling_advice": True}, left=Tyre(), right=Tyre(), fmu=fmu)
    record = car.run([*ADVICE, STATE], stop=1.0, request=([0.0, 0.1], [0.0, 150.0]))
    given = np.isin(record[STATE], [GIVEN, UNSTABLE])
    assert 100 < given.sum() < len(record) and np.all(given == (record["coupling.step_advice"] > 0.0))


@pytest.mark.parametrize("lines", [False, True])
@pytest.mark.parametrize("ports", [("left",), ("left", "right")])
@pytest.mark.parametrize("stiffness, damping", [(9000.0, 5.0), (9000.0, 50.0), (500.0, 5.0)])
def test_steps_above_the_longest_stable_one_get_an_advice_below_it(fmu, ports, stiffness, damping, lines):
    scene = Scene("free", stop=1.0, step=1e-3, outputs=["left.speed"], set=FREE, fmu=fmu.file)
    springs = [Spring.spring(port, stiffness, damping, 1e3, reads="both") for port in ports]
    stable = coupling(scene, springs, "gauss-seidel", "lines" if lines else "held").limit
    for share in (1.05, 1.15):
        hosts = {port: Host(stiffness, damping, 1e3, driven=lambda time: 200.0 * math.sin(20.0 * time)) for port in ports}
        run = couple(fmu, hosts, share * stable, 80.0 * share * stable, lines=lines, values={"carrier.torque_command": 20.0})
        # the host's law is learned from noisy differences
        assert 0.0 < run.advice[-1] < 1.2 * stable and run.advice[-1] < share * stable


@pytest.mark.parametrize("delay, ramp", [(1, False), (0, True), (1, True)])
@pytest.mark.parametrize("stiffness, damping", [(9000.0, 5.0), (8000.0, 50.0)])
def test_the_advice_knows_that_late_hosts_and_ramps_allow_shorter_steps(fmu, stiffness, damping, delay, ramp):
    values = {"solver.input_ramp": ramp, "inertia.left_end": 0.1, "carrier.torque_command": 20.0}
    scene = Scene("free", stop=1.0, step=1e-3, outputs=["left.speed"], set=FREE | values, fmu=fmu.file)
    spring = Spring.spring("left", stiffness, damping, 1e3, reads="both")
    stable = coupling(scene, [spring], "jacobi" if delay else "gauss-seidel", "held").limit
    host = Host(stiffness, damping, 1e3, driven=lambda time: 200.0 * math.sin(20.0 * time))
    run = couple(fmu, {"left": host}, 1.5 * stable, 60.0 * stable, delay=delay, values=values)
    assert 0.0 < run.advice[-1] < 1.05 * stable


def test_a_step_that_is_far_too_long_is_reported_before_the_run_fails(fmu):
    # the limit is 1.1 ms
    hosts = {port: Host(17400.0, 10.0, 79.0) for port in ("left", "right")}
    run = couple(fmu, hosts, 12e-3, 0.4, values={"carrier.torque_command": 500.0})
    assert len(run.warnings) == 1 and "with steps of 0.012 s" in run.warnings[0]


def test_the_cut_of_a_car_costs_less_energy_than_the_page_says(fmu):
    car = Car({"contact.law": "line", "effects.coupling_advice": True}, left=Tyre(friction=0.15), right=Tyre(friction=0.9), fmu=fmu)
    record = car.run(ADVICE, stop=1.0, request=([0.0, 0.3], [0.0, 120.0]))
    assert 0.0 < max(record["coupling.energy_ratio"][200:]) < 3e-3
    assert car.longest_step() == pytest.approx(6.9e-3, rel=0.01)


def played(fmu, torque):
    """Run with a torque on the left side that depends only on time."""
    run = Coupled()
    with fmu.open() as instance:
        instance.initialise(ADVISED | {"carrier.torque_command": 20.0, "right.load_torque": 10.0})
        port = instance.port([LOADS["left"]], [*ADVICE, STATE])
        run.states = []
        for step in range(1000):
            ratio, advice, state = port.step([torque(step * 1e-3)], 1e-3)
            run.ratio.append(ratio)
            run.advice.append(advice)
            run.states.append(state)
        run.messages = instance.messages
    return run


def noise(seed):
    drawn = random.Random(seed)
    return lambda time: drawn.uniform(-30.0, 30.0)


TABLES = {"constant": lambda time: 10.0, "ramp": lambda time: 100.0 * time, "jumps": lambda time: 10.0 if time % 0.1 < 0.05 else -10.0,
          "sine": lambda time: 10.0 + 20.0 * math.sin(12.0 * time), **{f"noise {seed}": noise(seed) for seed in range(5)}}


@pytest.mark.parametrize("table", TABLES)
def test_a_host_that_does_not_react_gets_no_warning(fmu, table):
    assert not played(fmu, TABLES[table]).warnings


def test_a_constant_torque_has_no_error_and_needs_no_advice(fmu):
    run = played(fmu, TABLES["constant"])
    assert not any(run.ratio) and not any(run.advice) and set(run.states) == {NO_REACTION}


def test_jumps_at_given_times_are_no_reaction(fmu):
    run = played(fmu, TABLES["jumps"])
    assert run.ratio[-1] > 0.0 and not any(run.advice)


def test_a_standstill_gets_no_advice(started):
    instance = started(ADVISED | {"carrier.speed_command": 0.0})
    port = instance.port([LOADS["left"]], ADVICE)
    assert all(port.step([0.0], 1e-3) == [0.0, 0.0] for _ in range(50))


def test_a_costly_cut_is_reported_once_with_port_ratio_step_advice_and_remedies(coupled):
    run = coupled("shaft", 3e-3, 0, False)
    assert len(run.warnings) == 1
    for said in ("left side", "coupling.energy_ratio is 0.", "steps of 0.003 s", "coupling.step_advice is 0.00", "shorter steps",
                 "input derivatives", "moving the cut inside"):
        assert said in run.warnings[0]


def test_a_growing_oscillation_is_reported_although_its_ratio_is_small(fmu):
    # the limit is 2 c/k = 0.11 ms
    run = couple(fmu, {"left": Host(9000.0, 0.5, 1e3, speed=0.0)}, 6e-4, 1.0, values={"carrier.speed_command": 1.0})
    assert max(run.ratio[100:]) < 0.1
    assert len(run.warnings) == 1 and "unstable cut at the left side" in run.warnings[0]
    stable = couple(fmu, {"left": Host(9000.0, 0.5, 1e3, speed=0.0)}, 8e-5, 1.0, values={"carrier.speed_command": 1.0})
    assert not stable.warnings


def test_a_side_driven_by_speed_has_the_energy_of_its_late_speed(started):
    size, acceleration, steps = 1e-3, 30.0, 400
    instance = started(ADVISED | {"scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 10.0,
                               "right.speed_command": 10.0, "carrier.speed_command": 10.0, "carrier.torque_command": 200.0})
    port = instance.port(["left.speed_command", "right.speed_command"], ["left.shaft_torque", *ERRORS])
    impulse, error = 0.0, 0.0
    for step in range(steps):
        torque, _, error, _ = port.step([10.0 + acceleration * step * size] * 2, size)
        impulse += torque * size if step < steps - LAG else 0.0
    # the speed is half a step late: the wheel turns faster than the unit's end of the shaft
    assert error == pytest.approx(0.5 * acceleration * size * impulse, rel=0.02)


def values_of(port, torques):
    return [port.step([torque], 1e-3) for torque in torques]


def test_rollback_and_saved_states_keep_all_values(started):
    shown = [*ERRORS, *ADVICE, STATE]
    torques = [20.0 * math.sin(0.3 * step) for step in range(60)]
    instance = started(ADVISED | {"carrier.torque_command": 20.0})
    port = instance.port([LOADS["left"]], shown)
    values_of(port, torques)
    at, time, state = port.read(), instance.time, instance.raw.getFMUState()
    saved = instance.raw.serializeFMUState(state)
    first = values_of(port, torques)
    for again in (state, instance.raw.deSerializeFMUstate(saved)):
        instance.raw.setFMUState(again)
        instance.time = time
        assert port.read() == at
        assert values_of(port, torques) == first


def test_all_signs_reversed_give_the_same_ratio_and_advice(started):
    def ends(sign):
        instance = started(ADVISED | {"carrier.speed_command": sign * 5.0, "carrier.torque_command": sign * 20.0})
        port = instance.port([LOADS["left"], LOADS["right"]], ["left.wheel_speed", "right.wheel_speed", *ERRORS, *ADVICE])
        row, rows = port.read(), []
        for _ in range(300):
            row = port.step([3.0 * row[0], 2.0 * row[1]], 1e-3)
            rows.append(row[2:])
        return rows

    assert np.any(ends(1.0)) and ends(1.0) == ends(-1.0)


def test_the_advice_changes_no_bit_of_the_motion(started):
    def motion(on):
        instance = started({"effects.coupling_advice": on, "scene.carrier_drive": "torque", "inertia.left_end": 0.5,
                            "inertia.right_end": 0.5})
        port = instance.port([LOADS["left"]], ["left.angle", "right.speed", "carrier.speed", "solver.steps"])
        return [port.step([800.0 + step], 1e-3) for step in range(100)]

    assert motion(True) == motion(False)
