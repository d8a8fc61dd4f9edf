"""The longest stable communication step: against hand calculation, and against coupled runs with hosts of its own definition."""

from itertools import product
from math import exp, inf, log, pi, sqrt

import numpy as np
import pytest
from command_line import command
from host_loops import Spring, drawn, grows, predicted
from scipy.linalg import expm

from bevel_differential import DifferentialError, DifferentialWarning, Scene
from bevel_differential.coupling import GAUSS_SEIDEL, HELD, JACOBI, LINES, ROLLBACK, Host, Linear, coupling, linearised, longest, stability
from bevel_differential.coupling.linear import balancing, exponential
from bevel_differential.vehicle import Car, Tyre
from refusals import refused

# the accuracy that is promised
WITHIN = 0.03
# scene with loaded teeth whose carrier is driven by torque
LOADED = {"scene.carrier_drive": "torque", "carrier.torque_command": 800.0, "left.load_torque": 400.0, "right.load_torque": 400.0,
          "carrier.speed_command": 10.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5}


def inertia(j):
    """Inertia whose load torque is the input, with angle and speed."""
    return Linear.of([[0.0, 1.0], [0.0, 0.0]], [[0.0], [-1.0 / j]], np.eye(2), np.zeros((2, 1)))


@pytest.fixture
def scene(fmu):
    def opened(values):
        return Scene("coupled", stop=1.0, step=1e-3, outputs=["carrier.speed"], set=values, fmu=fmu)

    return opened


@pytest.mark.parametrize("j, k, c", [(1.0, 9000.0, 12.0), (0.3, 500.0, 40.0), (2.0, 1e5, 900.0), (1.0, 9000.0, 1200.0)])
def test_without_delay_the_limit_of_an_inertia_on_a_spring_is_that_of_the_hand_calculation(j, k, c):
    # x' = M x with the held torque k q + c v: det M = 1 - h c/j + h2 k/(2 j) < 1, and 1 + trace + det = 4 - 2 h c/j > 0
    made = stability(inertia(j), [Host.spring("left", k, c, reads="both")], GAUSS_SEIDEL)
    assert made.limit == pytest.approx(min(2.0 * c / k, 2.0 * j / c), rel=1e-6)
    # beyond 2 c/k a slow swing grows, beyond 2 j/c the speed changes its sign at each step
    swings = made.mode().frequency * made.limit
    assert swings < 0.45 if c / k < j / c else swings == pytest.approx(0.5, rel=0.01)


@pytest.mark.parametrize("j, k, c", [(1.0, 9000.0, 12.0), (2.0, 1e5, 90.0)])
def test_beyond_the_limit_a_swing_doubles_as_the_hand_calculation_says(j, k, c):
    # det M = 1 - h c/j + h2 k/(2 j) is the square of the growth in a step
    step = 4.0 * c / k
    made = stability(inertia(j), [Host.spring("left", k, c, reads="both")], GAUSS_SEIDEL)
    growth = sqrt(1.0 - step * c / j + step**2 * k / (2.0 * j))
    assert made.doubling(step) == pytest.approx(step * log(2.0) / log(growth), rel=1e-6)
    assert made.doubling(0.9 * made.limit) == inf


def test_one_step_later_the_limit_is_two_thirds_of_damping_by_stiffness():
    made = stability(inertia(1.0), [Host.spring("left", 9000.0, 12.0, reads="both")], JACOBI)
    assert made.limit == pytest.approx(0.885e-3, abs=5e-7)
    soft = stability(inertia(1.0), [Host.spring("left", 90.0, 0.12, reads="both")], JACOBI)
    assert soft.limit == pytest.approx(2.0 * 0.12 / (3.0 * 90.0), rel=1e-3)


def test_gauss_seidel_with_held_inputs_has_the_same_limit_in_both_orders():
    for reads in ("speed", "angle", "both"):
        unit = inertia(0.7) if reads != "speed" else Linear.of([[0.0]], [[-1.0 / 0.7]], [[1.0]], [[0.0]])
        host = Host.spring("left", 9000.0, 12.0, 2.0, reads)
        limits = [stability(unit, [host], GAUSS_SEIDEL, first=first).limit for first in ("unit", "host")]
        assert limits[0] == pytest.approx(limits[1], rel=1e-6), reads


def test_an_inertia_between_two_springs_swings_as_the_hand_calculation_says():
    # the frequency at the limit is that of the undamped swing, if the step is far below its period
    made = stability(inertia(1.0), [Host.spring("left", 100.0, 0.2, 4.0, "both")], JACOBI)
    assert made.mode().frequency == pytest.approx(sqrt(100.0 * (1.0 + 0.25)) / (2.0 * pi), rel=2e-3)
    assert made.exchange.rigid == 2


# kind of gears, ports, signals and masters: see `drawn`; SEEDS are those of the 60 that cover all of them in the shortest time
SEEDS = [101, 105, 106, 108, 112, 113, 115, 118]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_limit_is_that_of_coupled_runs(seed, fmu):
    values, hosts, master, lines = drawn(seed)
    limit = predicted(values, hosts, master, lines, fmu).limit
    with fmu.open() as instance:
        for part in (0.3, 0.7, 1.0 - WITHIN):
            assert not grows(instance, values, hosts, master, lines, part * limit), part
        # the range of growth may be narrow
        assert any(grows(instance, values, hosts, master, lines, part * limit) for part in (1.0 + WITHIN, 1.01))


def test_a_ramp_halves_the_limit_without_delay(fmu):
    # docs/coupling.md: a torque on a ramp is twice as late
    host = Host.spring("left", 90.0, 0.12, reads="both")
    made = [stability(inertia(1.0), [host], GAUSS_SEIDEL, ramp=ramp).limit for ramp in (False, True)]
    assert made[0] == pytest.approx(2.0 * 0.12 / 90.0, rel=1e-6) and made[1] == pytest.approx(0.12 / 90.0, rel=1e-3)
    values, hosts, master, lines = drawn(118)
    values = values | {"solver.input_ramp": True}
    limit = predicted(values, hosts, master, lines, fmu).limit
    with fmu.open() as instance:
        assert [grows(instance, values, hosts, master, lines, part * limit) for part in (1.0 - WITHIN, 1.0 + WITHIN)] == [False, True]


def test_the_seeds_cover_all_kinds():
    made = [drawn(seed) for seed in SEEDS]
    assert {values["scene.gear_contact"] for values, *_ in made} == {"ideal", "lumped", "tooth"}
    assert {(master, lines) for *_, master, lines in made} == {*product((JACOBI, GAUSS_SEIDEL), (False, True))}
    assert {host.port for _, hosts, *_ in made for host in hosts} == {"carrier", "left", "right"}
    assert {host.reads for _, hosts, *_ in made for host in hosts} == {"speed", "angle", "both"}
    assert {len(hosts) for _, hosts, *_ in made} == {1, 2}


# in 725, another motion decays more slowly on both sides of the range
@pytest.mark.parametrize("seed", [103, 725])
def test_a_narrow_range_of_growth_counts(seed, fmu):
    # above this range, which is 2 % wide, steps are stable again
    values, hosts, master, lines = drawn(seed)
    made = predicted(values, hosts, master, lines, fmu)
    with fmu.open() as instance:
        assert [grows(instance, values, hosts, master, lines, part * made.limit) for part in (0.97, 1.01, 1.1)] == [False, True, False]


def test_the_search_looks_closer_at_a_maximum_between_its_points():
    # growth in a range of 0.2 %, on a peak that is wider
    peak = longest(lambda step: 1.1 if 1.003e-3 < step < 1.005e-3 else 0.98 + 0.01 * exp(-(log(step / 1.004e-3) / 0.02)**2))
    assert peak == pytest.approx(1.003e-3, rel=1e-6)


def test_repetitions_of_a_step_converge_up_to_the_limit_of_rollback(scene, fmu):
    host = Spring("left", 9000.0, 12.0, inf, "both")
    values = LOADED | {"scene.gear_contact": "ideal", "solver.relative_tolerance": 1e-10}
    made = coupling(scene(values), [Host.spring("left", 9000.0, 12.0, reads="both")], ROLLBACK)
    with fmu.open() as instance:
        port = instance.port(["left.load_torque"], ["left.wheel_angle", "left.wheel_speed"])
        for part, converges in ((0.97, True), (1.03, False)):
            instance.initialise(values)
            saved, torque, changes = instance.save(), 400.0, []
            at_rest = None
            for _ in range(60):
                angle, speed = port.do_step(torque, 0.0, part * made.limit)
                instance.restore(saved)
                # the wall follows the steady rotation
                at_rest = at_rest or (angle, speed)
                answer = 400.0 + host.k * (angle - at_rest[0]) + host.c * (speed - at_rest[1]) + (1e-3 if not changes else 0.0)
                changes.append(abs(answer - torque))
                torque = answer
            assert (changes[-1] < changes[5]) == converges, (part, changes[5], changes[-1])


@pytest.mark.parametrize("damper", [0.0, 30.0])
def test_a_side_driven_by_speed_meets_an_inertia_with_a_damper_to_the_ground(scene, damper):
    # the other wheel stands as a rock behind a rigid shaft, so the half-shaft is a spring to the ground
    k, c = 9000.0, 12.0
    values = {"scene.left_drive": "speed", "effects.half_shaft": True, "half_shaft.left_stiffness": k, "half_shaft.left_damping": c,
              "half_shaft.right_stiffness": 1e8, "half_shaft.right_damping": 1e4, "inertia.right_end": 1e5, "scene.gear_contact": "ideal",
              "carrier.speed_command": 0.0, "left.speed_command": 0.0, "left.load_torque": 0.0, "right.load_torque": 0.0}
    made = coupling(scene(values), [Host.parse(f"left:J=1,c={damper}" if damper else "left:J=1")])

    def radius(h):
        # speed, twist and torque of the last step, all held; the inertia decays exactly
        keep, per_torque = np.exp(-damper * h), -np.expm1(-damper * h) / damper if damper else h
        return np.abs(np.linalg.eigvals([[keep, 0.0, per_torque], [-h, 1.0, 0.0], [-k * h - c, k, 0.0]])).max()

    steps = np.linspace(1e-4, 5e-3, 5000)
    assert made.limit == pytest.approx(next(step for step in steps if radius(step) > 1.0), rel=0.01)
    # slow motion meets the spring and the damper
    assert made.apparent()["left"].stiffness == pytest.approx(k + c / made.limit, rel=0.01)
    same = coupling(scene(values), [Host.of("left", [[-damper]], [[1.0]], [[1.0]], [[0.0]], "torque")])
    assert same.limit == made.limit


def test_a_host_in_front_of_a_final_drive_has_the_limit_of_its_values_at_the_carrier(scene):
    """A rigid final drive with a pinion of nearly no inertia only changes units: torque by 1/i, speed by i."""
    final = {"effects.final_drive": True, "inertia.pinion": 1e-9, "pinion.torque_command": 800.0 / 4.1, "pinion.speed_command": 41.0}
    at_port = {name: value for name, value in LOADED.items() if not name.startswith("carrier.")} | final
    k, c, inertia = 8000.0, 5.0, 0.4
    one = coupling(scene(LOADED), [Host.spring("carrier", k, c, inertia)]).limit
    other = coupling(scene(at_port), [Host.spring("carrier", k / 4.1**2, c / 4.1**2, inertia / 4.1**2)]).limit
    assert other == pytest.approx(one, rel=1e-4)


def test_a_carrier_driven_by_speed_meets_an_inertia(scene, fmu):
    values = {"scene.gear_contact": "tooth", "carrier.speed_command": 10.0, "left.load_torque": 400.0, "right.load_torque": 400.0,
              "inertia.left_end": 1.0, "inertia.right_end": 1.0, "solver.relative_tolerance": 1e-9}
    limit = coupling(scene(values), [Host.inertia("carrier", 5.0)]).limit
    swell = []
    with fmu.open() as instance:
        port = instance.port(["carrier.speed_command"], ["carrier.torque"])
        for step in ((1.0 - WITHIN) * limit, (1.0 + WITHIN) * limit):
            instance.initialise(values)
            [rest] = port.read()
            speed, torque, added = 10.0 + 1e-5, rest, []
            for n in range(3000):
                # both sides use values at the start of the step
                [next_torque] = port.do_step(speed, n * step, step)
                speed, torque = speed - step * (torque - rest) / 5.0, next_torque
                added.append(abs(torque - rest))
            swell.append(max(added[-100:]) / max(added[1000:1100]))
    assert swell[0] < 1.0 < swell[1], swell


def test_gears_without_teeth_have_the_apparent_inertia_of_willis_equation(scene):
    carrier, side, planet, ratio = 0.3, 0.02, 1e-9, 16 / 10
    values = LOADED | {"scene.gear_contact": "ideal", "inertia.from_geometry": False, "inertia.carrier": carrier, "inertia.side_gear": side,
                       "inertia.planet": planet}
    made = coupling(scene(values), [Host.spring("left", 1000.0, 5.0, 1.0)])
    # kinetic energy by the speeds of both sides, with w_c = (w_L + w_R)/2 and the spin (z_s/z_p) (w_L - w_R)/2
    both, apart, wheel = 0.25 * carrier, 0.25 * 2 * planet * ratio**2, side + 0.5
    mass = np.array([[wheel + both + apart, both - apart], [both - apart, wheel + both + apart]])
    found = made.apparent()["left"]
    assert found.inertia == pytest.approx(1.0 / np.linalg.inv(mass)[0, 0], rel=1e-3)
    assert found.stiffness == pytest.approx(found.inertia / made.limit**2, rel=1e-9)


def test_the_exponential_of_stiff_teeth_is_that_of_scipy(scene):
    made = coupling(scene(LOADED | {"scene.gear_contact": "tooth"}), [Host.spring("left", 9000.0, 12.0, reads="both")])
    for step in (1e-6, 1e-4, 1e-2):
        right = expm(made.unit.a * step)
        np.testing.assert_allclose(exponential(made.unit.a * step, balancing(made.unit.a)), right, rtol=1e-7, atol=1e-7 * np.abs(right).max())


def test_the_linearised_unit_predicts_a_small_step(started):
    values = LOADED | {"scene.gear_contact": "tooth", "solver.relative_tolerance": 1e-10}
    instance = started(values)
    unit = linearised(instance, ["left.load_torque"], ["left.wheel_speed", "carrier.speed"])
    free, held, _ = unit.exact(1e-4)
    expected, x = [], np.zeros((len(unit.a), 1))
    for _ in range(20):
        x = free @ x + held * 1.0
        expected.append(unit.c @ x)
    found = []
    for load in (400.0, 401.0):
        instance.initialise(values)
        port = instance.port(["left.load_torque"], ["left.wheel_speed", "carrier.speed"])
        found.append(np.array([port.do_step(load, n * 1e-4, 1e-4) for n in range(20)]))
    difference, expected = found[1] - found[0], np.array(expected)[:, :, 0]
    np.testing.assert_allclose(difference, expected, atol=5e-3 * np.abs(expected).max())


@pytest.mark.parametrize("text, words", [
    ("front:k=1,c=1", "front: it is no port"), ("left:k=-1,c=1", "k is a number above 0"), ("left:k=x,c=1", "k is a number"),
    ("left:k=1,c=1,c=2", "each once"), ("left:c=1", "give k, c and reads"), ("left:k=1,c=1,reads=force", "reads=force: it is one of"),
    ("left:k=1,c=1,reads=torque", "reads speed, angle or both"), ("left:9000", "write PORT:"), ("left", "J and c at a port driven by speed")])
def test_a_wrong_host_is_named(text, words):
    with pytest.raises(DifferentialError, match=words):
        Host.parse(text)


def test_wrong_uses_are_named(scene):
    spring = Host.spring("left", 1.0, 1.0)
    with refused("left: the scene drives it by torque, so its host has only k, c and J"):
        coupling(scene(LOADED), [Host.inertia("left", 1.0)])
    with refused("carrier: the scene drives it by speed, so its host has only J and c"):
        coupling(scene({}), [Host.spring("carrier", 1.0, 1.0)])
    with refused("carrier: gears without teeth follow its speed at once"):
        coupling(scene({"scene.gear_contact": "ideal"}), [Host.inertia("carrier", 1.0)])
    with refused("left: it has two hosts"):
        coupling(scene(LOADED), [spring, spring])
    with refused("no port has a host"):
        coupling(scene(LOADED), [])
    with refused("master = 'euler': it is one of jacobi"):
        coupling(scene(LOADED), [spring], "euler")
    with refused("has 2 inputs and one output"):
        Host.of("left", [[0.0]], [[1.0]], [[1.0]], [[0.0]], "both")
    with pytest.warns(DifferentialWarning, match="the teeth are not loaded at 0 s"):
        coupling(scene(LOADED | {"scene.start": "rolling"}), [spring])
    with pytest.warns(DifferentialWarning) as warned:
        coupling(scene(LOADED | {"scene.start": "rolling", "left.load_torque": 300.0}), [spring], at="50 ms")
    assert not any("not loaded" in str(one.message) for one in warned)


def test_the_command_prints_what_python_returns_and_draws_it(tmp_path):
    said = command("coupling one_wheel_on_ice --set scene.start=equilibrium --host right:k=9000,c=12,J=1,reads=both --master gauss-seidel "
                   f"--input lines --plot {tmp_path / 'a.png'}").out
    with Scene.load("one_wheel_on_ice") as loaded:
        loaded.set({"scene.start": "equilibrium"})
        made = coupling(loaded, [Host.spring("right", 9000.0, 12.0, 1.0, "both")], GAUSS_SEIDEL, LINES)
    assert f"longest stable step: {made.limit * 1e3:.3g} ms (gauss-seidel, inputs on lines)" in said
    assert f"{made.mode().frequency:.3g} Hz at the port right" in said
    for master in ("jacobi", "gauss-seidel", "rollback"):
        assert f"{made.limits()[master, HELD] * 1e3:.3g} ms" in next(line for line in said.splitlines() if line.startswith(f"{master} "))
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_without_a_damper_no_step_is_stable_one_step_later():
    made = stability(inertia(1.0), [Host.spring("left", 9000.0, 0.0, reads="both")], JACOBI)
    assert made.limit == 0.0 and made.mode() is not None


@pytest.mark.parametrize("left", [Tyre(damping=1e4), Tyre(damping=200.0, inertia=0.3)], ids=["at rest", "at speed"])
def test_a_car_is_stable_up_to_its_longest_step(left, monkeypatch):
    car = Car({"scene.gear_contact": "ideal"}, left=left, right=Tyre())
    longest = car.longest_step()
    with refused("the car is stable with steps up to"):
        car.run(step=1.001 * longest)
    monkeypatch.setattr(Car, "_check_step", lambda *_: None)
    # the speed at which the tyres are least stable
    speed = 0.0 if left.damping > 1e3 else 4.0 * left.walk
    swell = []
    for part in (1.0 - WITHIN, 1.0 + WITHIN):
        step = part * longest
        record = car.run(["left.wheel_speed"], 1500 * step, step, request=lambda time: 2.0 if time < 0.01 else 0.0, speed=speed)
        jumps = np.abs(np.diff(record["left.wheel_speed"], 2))
        swell.append(jumps[1000:].max() / jumps[:100].max())
    assert swell[0] < 0.1 and swell[1] > 10.0 * swell[0], swell


def test_a_motion_that_grows_without_a_cut_has_no_influence_on_the_limit(fmu, tmp_path):
    """Without friction, planets leave some positions of their teeth as a ball leaves the top of a hill."""
    text = """description = "launch without friction"
stop_time = "0.4 s"
step = "1 ms"
outputs = ["left.shaft_torque"]
accept_start_values = true
[set]
contact.law = "line"
scene.carrier_drive = "torque"
scene.start = "rest"
carrier.torque_command = 500.0
effects.half_shaft = true
inertia.left_end = 1.0
inertia.right_end = 1.0
left.load_torque = 200.0
right.load_torque = 200.0
"""
    (tmp_path / "launch.toml").write_text(text, encoding="utf-8")
    hosts = [Host.spring(port, 17400.0, 10.0, 79.0, reads="both") for port in ("left", "right")]
    found = {}
    for gears in ("tooth", "lumped"):
        with Scene.load(tmp_path / "launch.toml", fmu) as scene:
            made = coupling(scene.set({"scene.gear_contact": gears}), hosts, GAUSS_SEIDEL, at=0.3)
            found[gears] = made.departure, made.limit
    assert found["tooth"][0] > 0.0 and found["lumped"][0] == 0.0
    assert 0.0 < found["tooth"][1] == pytest.approx(found["lumped"][1], rel=0.05)
    hosts = " ".join(f"--host {port}:k=17400,c=10,J=79,reads=both" for port in ("left", "right"))
    assert "the teeth do not rest at this time" in command(f"coupling {tmp_path / 'launch.toml'} --at '0.3 s' --master gauss-seidel {hosts}").out
