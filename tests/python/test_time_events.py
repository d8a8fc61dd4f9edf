"""Time events on, just before and just after communication points, without loss of motion. The carrier turns at an imposed speed, so
its angle at every communication point is known."""

from collections import Counter

import numpy as np
import pytest
from bevel_differential import Scene
from driving import CARRIER, SIDES, put

METHODS = ["adaptive", "radau", "fixed_step"]
SIZES = [1e-4, 5e-4, 1e-3, 2e-3, 1e-2]
COUNTS = range(3, 60)
# longest time to an event [s] with a method that always takes short steps
LONGEST = {"fixed_step": 0.2}
# tested points for each kind of rounding; the default method tests all
OF_A_KIND = 3
TIMES = {"multiplied": lambda k, h: k * h, "rounded": lambda k, h: round(k * h, 9), "summed": lambda k, h: sum([h] * k)}
# fixed_step would take a minute with its default step
SPEED = {"carrier.speed_command": CARRIER, "solver.fixed_step": 1e-4}
FAULT = {"effects.tooth_fault": True, "tooth_fault.gear": "planet", "tooth_fault.missing_fraction": 0.6}
# values of the start, values that begin the event, values that end it
EVENTS = {
    "trigger": (FAULT, {"fault.trigger": 1.0}, {"fault.trigger": 0.0}),
    "lock": ({}, {"lock.command": 1.0}, {"lock.command": 0.0}),
    "brake": ({"effects.wheel_brake": True}, {"left.brake_torque": 600.0}, {"left.brake_torque": 0.0}),
    "load": ({}, {f"{side}.load_torque": 400.0 for side in SIDES}, {f"{side}.load_torque": 835.0 for side in SIDES}),
}


def method(name):
    return SPEED | {"solver.method": name}


def step(instance, begin, end):
    instance.raw.doStep(currentCommunicationPoint=begin, communicationStepSize=end - begin)


def assert_nothing_is_lost(instance, times, change=lambda k: None):
    """Steps through `times` and checks the carrier's angle after each; `change(k)` is called before step k."""
    for k, (begin, end) in enumerate(zip(times, times[1:], strict=False)):
        change(k)
        step(instance, begin, end)
        turned, expected = instance.get("carrier.angle"), CARRIER * end
        assert turned == pytest.approx(expected, rel=1e-9), f"step {k + 1}, {begin!r} to {end!r} s"


def grid(way, count, size):
    """Regular times, then one long step and a short one."""
    times = [TIMES[way](k, size) for k in range(count + 1)]
    return [*times, times[-1] + 7.3 * size, times[-1] + 8.3 * size]


def rounding(way, count, size):
    """Signs of the distances from the event to its communication point: by the time of the host, and by the sum of the FMU."""
    before, at = (TIMES[way](k, size) for k in (count - 1, count))
    return tuple(np.sign([at - count * size, before + (at - before) - count * size]))


def breaking(onset):
    return FAULT | {"tooth_fault.at_onset": True, "tooth_fault.onset": onset}


def counts(name, way, size):
    """Numbers of steps before an event for a method: all, or the first ones of each kind of rounding."""
    found, kinds = [], Counter()
    for count in COUNTS:
        kind = rounding(way, count, size)
        kinds[kind] += 1
        if name == METHODS[0] or kinds[kind] <= OF_A_KIND:
            found.append(count)
    return short(name, found, size)


def short(name, counts, size):
    """Numbers of steps that a method simulates quickly."""
    return [count for count in counts if count * size <= LONGEST.get(name, np.inf)]


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("way", TIMES)
def test_no_step_is_lost_where_a_tooth_breaks_on_a_communication_point(fmu, name, way):
    with fmu.open() as instance:
        for size in SIZES:
            for count in counts(name, way, size):
                instance.initialise(method(name) | breaking(count * size))
                assert_nothing_is_lost(instance, grid(way, count, size))


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("off", [-1e-3, -1e-9, -1e-13, -2e-16, 2e-16, 1e-13, 1e-9, 1e-3])
def test_no_step_is_lost_where_a_tooth_breaks_just_before_or_after_a_communication_point(fmu, name, off):
    with fmu.open() as instance:
        for size in SIZES:
            for count in short(name, (3, 10, 20, 59), size):
                instance.initialise(method(name) | breaking((count + off) * size))
                assert_nothing_is_lost(instance, grid("multiplied", count, size))


@pytest.mark.parametrize("off", [0.0, -2e-16, 1e-13])
def test_a_tooth_breaks_at_its_time_wherever_communication_points_are(started, off):
    """The contact loses the energy of the broken tooth: equal heat in steps that end at the onset and in one step past it."""
    onset = 7e-3
    values = SPEED | breaking(onset * (1.0 + off)) | {"solver.relative_tolerance": 1e-9}
    heats = []
    for times in ([0.0, 9e-3], [1e-3 * k for k in range(10)], [0.0, onset, 9e-3]):
        instance = started(values)
        assert_nothing_is_lost(instance, times)
        heats.append(instance.get("heat.contact"))
    assert heats[0] > 0.0
    assert heats == pytest.approx([heats[0]] * 3, rel=1e-6)


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("kind", EVENTS)
def test_no_step_is_lost_where_an_input_steps(fmu, name, kind):
    effects, begin, end = EVENTS[kind]
    with fmu.open() as instance:
        for size in SIZES:
            for way in TIMES:
                for count in short(name, (3, 10, 31, 59), size):
                    instance.initialise(method(name) | effects)

                    def change(k, count=count):
                        for name, value in {count: begin, count + 1: end}.get(k, {}).items():
                            put(instance, name, value)

                    assert_nothing_is_lost(instance, grid(way, count, size), change)


@pytest.mark.parametrize("name", METHODS)
def test_an_onset_with_simultaneous_steps_of_inputs_loses_nothing(fmu, name):
    """All inputs step at the onset, while brakes and a lock hold."""
    effects = breaking(5e-3) | {"effects.wheel_brake": True}
    with fmu.open() as instance:
        for size in SIZES[:3]:
            count = round(5e-3 / size)
            instance.initialise(method(name) | effects)

            def change(k, count=count):
                if k == count:
                    for event in ("lock", "brake", "load"):
                        instance.set(EVENTS[event][1])

            assert_nothing_is_lost(instance, grid("summed", count, size), change)


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("off", [-1e-3, -1e-10, 0.0, 1e-10, 1e-3])
def test_tables_that_jump_on_communication_points_lose_nothing(run, name, off):
    """Loads jump, in steps of the package, and the carrier's speed jumps: its angle is the integral of the table."""
    size, count = 1e-3, 24
    jumps = (np.array([3, 7, 8, 20]) + off) * size
    speeds = CARRIER * np.array([1.0, 0.5, -1.0, 2.0, 0.25])
    steps = np.repeat(np.concatenate([[0.0], jumps, [1.0]]), 2)[1:-1]
    inputs = {"left.load_torque": (steps, np.repeat([835.0, 0.0, 400.0, -300.0, 835.0], 2)),
              "carrier.speed_command": (steps, np.repeat(speeds, 2))}
    record = run(method(name), count * size, size, ["carrier.angle"], inputs)
    bounds = np.concatenate([[0.0], jumps, [1.0]])
    expected = [sum(w * max(0.0, min(t, b) - a) for w, a, b in zip(speeds, bounds, bounds[1:], strict=False) if t > a)
                for t in record["time"]]
    # a jump closer to a communication point than 1e-9 of the step counts as on it
    assert record["carrier.angle"] == pytest.approx(expected, abs=1e-9 * size * CARRIER * 4 + 1e-12)


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("time", [0.005, 0.005 - 1e-12, 0.005 + 1e-12, 0.0053])
def test_scenes_whose_settings_change_on_communication_points_lose_nothing(fmu_file, tmp_path, name, time):
    scene = tmp_path / "changes.toml"
    scene.write_text(f'description = "changes"\nstop_time = 0.012\nstep = 0.0005\noutputs = ["carrier.angle"]\n'
                     f'[set]\nsolver.method = "{name}"\nsolver.fixed_step = 1e-4\ncarrier.speed_command = {float(CARRIER)!r}\n'
                     f'effects.tooth_fault = true\ntooth_fault.gear = "planet"\ntooth_fault.missing_fraction = 0.6\n'
                     f'tooth_fault.at_onset = true\ntooth_fault.onset = 0.005\neffects.wheel_brake = true\n'
                     f'[[at]]\ntime = {time!r}\nlock.command = 1.0\nleft.brake_torque = 500.0\n'
                     '[[at]]\ntime = 0.006\nlock.command = 0.0\nright.load_torque = 0.0\n')
    record = Scene.load(scene, fmu=fmu_file).run()
    assert record["carrier.angle"] == pytest.approx(CARRIER * record["time"], rel=1e-9)


def test_a_host_that_integrates_itself_breaks_the_tooth_on_rounded_times(fmu):
    """In model exchange the event's time is known in advance, and a host whose summed time reaches it does not find it ahead."""
    with fmu.open("ModelExchange") as instance:
        onset = 0.3
        instance.initialise(SPEED | breaking(onset))
        raw = instance.raw
        assert raw.newDiscreteStates()[4:] == (True, onset)
        raw.enterContinuousTimeMode()
        raw.setTime(onset - 5e-17)
        raw.enterEventMode()
        assert raw.newDiscreteStates()[4] is False
