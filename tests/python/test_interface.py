"""The Python package: the same bits as with fmpy, reused instances, values as users write them, helpful errors."""

import doctest
import os
import pickle
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import theory

import bevel_differential
from bevel_differential import Differential, DifferentialError
from refusals import refused

TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": (954, "deg/s")}
OUTPUTS = ["left.speed", "right.speed", "planet[1].left_pairs", "left.normal_force", "held.sides", "solver.steps"]


@pytest.fixture
def turn():
    with Differential(TURN) as differential:
        yield differential


def same(here, there):
    return all(np.array_equal(here[name], there[name]) for name in here.dtype.names)


def test_a_run_has_the_bits_that_fmpy_gives(turn, through_fmpy):
    here = turn.run(outputs=OUTPUTS, stop="100 ms", step="1 ms")
    assert same(here, through_fmpy(TURN, output=OUTPUTS))


def test_an_instance_that_is_kept_gives_the_same_bits_again(turn):
    first = turn.run(outputs=OUTPUTS, stop=0.05)
    turn.set(left__load_torque=100.0).run(outputs=OUTPUTS, stop=0.02)
    again = turn.set(left__load_torque=(835.0, "N.m")).run(outputs=OUTPUTS, stop=0.05)
    assert same(first, again)


def test_one_long_step_gives_the_values_at_the_end(turn, through_fmpy):
    last = through_fmpy(TURN, 0.5, output=OUTPUTS, output_interval=0.5)[-1]
    assert turn.final(OUTPUTS, stop=0.5) == {name: last[name] for name in OUTPUTS}


def test_inputs_over_time_ramp_and_jump_as_in_fmpy(through_fmpy):
    times, loads = np.array([0.0, 0.02, 0.02, 0.05]), np.array([100.0, 200.0, 400.0, 300.0])
    signals = np.array(list(zip(times, loads)), [("time", float), ("left.load_torque", float)])
    with Differential() as straight:
        by_arrays = straight.run({"left.load_torque": (times, loads)}, ["left.speed", "left.shaft_torque"], 0.05,
                                 input_slopes=False)
        by_record = straight.run(signals, ["left.speed", "left.shaft_torque"], 0.05, input_slopes=False)
    there = through_fmpy({}, 0.05, output=["left.speed", "left.shaft_torque"], input=signals)
    assert same(by_arrays, by_record)
    # fmpy has no second row at a jump
    by_arrays = by_arrays[np.append(True, np.diff(by_arrays["time"]) > 0.0)]
    assert len(by_arrays) == len(there) and np.array_equal(by_arrays["time"], there["time"])
    # fmpy holds values within a step, and rounds a value between two points differently
    for name in ("left.speed", "left.shaft_torque"):
        assert np.allclose(by_arrays[name], there[name], rtol=1e-6, atol=1e-6)


def test_a_tunable_parameter_over_time_does_what_setting_it_between_steps_does():
    given = {**theory.CLUTCHES, "left.load_torque": 300.0, "effects.half_shaft": True,
             "inertia.left_end": 1.0, "inertia.right_end": 1.0}
    times, preloads = np.array([0.0, 0.02, 0.02, 0.05]), np.array([50.0, 50.0, 200.0, 300.0])
    names = ["left.speed", "left.shaft_torque", "heat.clutch"]
    with Differential(given) as slipping:
        here = slipping.run({"limited_slip.preload": (times, preloads)}, names, 0.06, 1e-3)
        # without the second row at the jump
        here = here[np.append(True, np.diff(here["time"]) > 0.0)]
        held = slipping.run({"limited_slip.preload": 50.0}, names, 0.06, 1e-3)
        with slipping.fmu.open() as instance:
            instance.initialise({**given, "limited_slip.preload": 50.0})
            for row in range(60):
                # two points at the same time are a jump: after it, the second one is valid
                after = np.interp(row * 1e-3, times[2:], preloads[2:]) if row >= 20 else 50.0
                instance.set({"limited_slip.preload": float(after)})
                instance.step(1e-3)
                there = instance.read(names)
                assert there == pytest.approx([here[name][row + 1] for name in names], rel=1e-6, abs=1e-9)
    assert abs(here["left.speed"][-1] - held["left.speed"][-1]) > 1e-4
    with refused("geometry.module: it is a fixed parameter; give it by `set` or `values`"):
        slipping.run({"geometry.module": ([0.0, 1.0], [4e-3, 5e-3])})


def test_a_jump_between_points_is_a_point():
    with Differential() as straight:
        found = straight.run({"left.load_torque": ([0.0, 0.0035, 0.0035], [835.0, 835.0, 0.0])}, stop=0.005)
    assert found["time"].tolist() == [0.0, 0.001, 0.002, 0.003, 0.0035, 0.0035, 0.004, 0.005]


def test_threads_and_copies_in_other_processes_give_the_same_bits(turn):
    expected = turn.run(outputs=OUTPUTS, stop=0.02)
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: turn.run(outputs=OUTPUTS, stop=0.02), range(8)))
    assert all(same(expected, one) for one in found)
    with pickle.loads(pickle.dumps(turn)) as copy:
        assert same(expected, copy.run(outputs=OUTPUTS, stop=0.02))


@pytest.mark.parametrize("use, parts", [
    (lambda d: d.set({"geometry.modul": 1.0}), "geometry.modul … did you mean geometry.module"),
    (lambda d: d.set({"geometry.module": "wide"}), "geometry.module … wide … does not begin with a number"),
    (lambda d: d.set({"effects.strength": 2}), "effects.strength … true or false"),
    (lambda d: d.set({"left.speed": 1.0}), "left.speed … cannot be set"),
    (lambda d: d.run(outputs=["left.sped"]), "left.sped … did you mean left.speed"),
    (lambda d: d.run({"left.speed": 1.0}), "left.speed … not an input"),
    (lambda d: d.run({"left.load_torque": ([0.0, 1.0], [1.0])}), "left.load_torque … 2 times for 1"),
    (lambda d: d.run({"left.load_torque": ([1.0, 0.0], [1.0, 2.0])}), "left.load_torque … must not fall"),
    (lambda d: d.run(step="1 fortnight"), "step … fortnight"),
    (lambda d: d.run(step=-1e-3), "step"),
])
def test_impossible_calls_are_refused_immediately(turn, use, parts):
    with refused(parts):
        use(turn)


def test_a_value_with_its_unit_is_not_taken_for_another_unit():
    with pytest.raises(DifferentialError) as error:
        Differential({"geometry.module": "450 mm"})
    assert str(error.value) == "geometry.module: 450 mm is outside [0.2, 100] mm"
    with pytest.raises(DifferentialError) as error:
        Differential({"geometry.shaft_angle": "80 deg"})
    assert str(error.value).startswith("geometry.shaft_angle: 80 deg is not 90 deg, the only possible value. Angle between")
    with refused("did you mean 4.5 mm"), Differential({"geometry.module": 4.5}) as bare:
        bare.run(stop=0.01)


def test_the_fmu_s_own_message_reaches_the_user_and_the_instance_goes_on(turn):
    expected = turn.run(outputs=OUTPUTS, stop=0.01)
    with refused("geometry.module: -0.0045 m is outside ["):
        Differential({**TURN, "geometry.module": -4.5e-3}, fmu=turn.fmu.file).run()
    turn.set({"geometry.module": -4.5e-3})
    with pytest.raises(DifferentialError):
        turn.run(stop=0.01)
    assert same(expected, turn.set({"geometry.module": "4.5 mm"}).run(outputs=OUTPUTS, stop=0.01))


def test_the_package_finds_the_fmu_by_the_environment(fmu_file, monkeypatch):
    assert Differential().fmu.file == Path(os.path.realpath(fmu_file))
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", "/nowhere.fmu")
    with refused("no such FMU"):
        Differential()


def test_the_example_of_the_package_holds():
    found = doctest.testmod(bevel_differential)
    assert found.attempted > 3 and found.failed == 0


def test_warnings_of_a_run_can_be_read():
    with Differential({"geometry.module": "5 mm"}) as own_gears:
        own_gears.run(stop=0.001)
        assert any("line_weber" in warning for warning in own_gears.warnings), own_gears.warnings
        own_gears.set(contact__law="line_weber", geometry__face_width="15 mm").run(stop=0.001)
        assert [text for text in own_gears.warnings if "start values of the study" not in text] == []
