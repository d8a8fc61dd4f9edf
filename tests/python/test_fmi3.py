"""The unit of FMI 3.0: valid, same bits as with FMI 2.0, events in every combination, both kinds of derivatives, states."""

import ctypes
import zipfile
from math import cos, sin
from pathlib import Path

import fmpy
import numpy as np
import pytest
import theory
from bevel_differential import Scene, shipped_scenes
from fmi3 import Unit3
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3ModelDescription.xsd"
# wheels brake to a standstill one after the other, and the brakes are released
BRAKING = {"effects.wheel_brake": True, "scene.carrier_drive": 2, "carrier.torque_command": 0.0, "left.load_torque": 0.0,
           "right.load_torque": 0.0, "inertia.left_end": 0.6, "inertia.right_end": 0.9, "left.brake_torque": 900.0,
           "right.brake_torque": 700.0, "carrier.speed_command": 30.0, "scene.start": 2}
# half-shafts that are not wound up at the start, so that the packs stick and slip
CLUTCH = {**theory.CLUTCHES, "scene.start": 2, "scene.gear_contact": 1, "effects.half_shaft": True, "limited_slip.torque_coefficient": 0.0,
          "limited_slip.preload": 120.0, "left.load_torque": 600.0, "right.load_torque": 300.0,
          "inertia.left_end": 0.5, "inertia.right_end": 0.8, "carrier.torque_command": 900.0, "scene.carrier_drive": 2}
FAULT = {"effects.tooth_fault": True, "tooth_fault.at_onset": True, "tooth_fault.onset": 0.0437}
# the study's turn, driven by a torque: teeth roll, and the solver takes about a step each millisecond
TURN = {"scene.planet_spin": 2, "spin.command": 3.5, "scene.carrier_drive": 2, "carrier.torque_command": 1670.0,
        "inertia.left_end": 0.5, "inertia.right_end": 0.5, "effects.half_shaft": True}
SCENES = {"braking": BRAKING, "clutch": CLUTCH, "fault": FAULT}
STEP, END = 2e-3, 0.12


def test_the_unit_is_valid_by_fmpy_and_by_the_schema(fmu3):
    assert validate_fmu(str(fmu3)) == []
    with zipfile.ZipFile(fmu3) as archive:
        schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
        schema.assertValid(etree.fromstring(archive.read("modelDescription.xml")))


@pytest.mark.parametrize("name", shipped_scenes())
def test_a_scene_has_the_same_bits_by_both_versions(fmu3, fmu, plain_outputs, name):
    scene = Scene.load(name, fmu=fmu)
    scene.stop = min(scene.stop, 0.1)
    scene.set({"solver.relative_tolerance": 1e-6})
    signals = scene._signals
    # FMI 3.0 has no derivatives of inputs
    signals.straight = []
    expected = scene.run(plain_outputs)
    steps = signals.steps(scene.stop, scene.step)
    tables = [table.variable.name for table in signals.tables]
    made, rows = 0, []
    with Unit3(fmu3) as unit:
        unit.initialise({**scene.values, **{variable.name: value for variable, value in signals.start(steps)}}, steps["end"][-1])
        rows.append(unit.reals(plain_outputs))
        for begin, size, _, due, jumps, recorded, values, _ in steps[1:].tolist():
            for _, pairs in signals.changes[made:int(due)]:
                unit.set({variable.name: value for variable, value in pairs})
            made = int(due)
            unit.set(dict(zip(tables, values, strict=True)))
            if jumps:
                rows.append(unit.reals(plain_outputs))
            assert unit.step(begin, size) == (False, False, False, pytest.approx(begin + size, rel=1e-12))
            assert recorded
            rows.append(unit.reals(plain_outputs))
    found = np.array(rows)
    for column, output in enumerate(plain_outputs):
        assert np.array_equal(found[:, column], expected[output]), output


def march(unit, values, outputs):
    """Steps from point to point, continuing after every early return. Returns the points and all [time, kind, early, needed]."""
    unit.begin(values, END)
    points, events = [unit.reals(outputs)], []
    for k in range(round(END / STEP)):
        time, until = k * STEP, (k + 1) * STEP
        while time < until:
            needed, _, early, time = unit.step(time, until - time)
            if needed or early:
                kind = unit.read(["event.kind"])[0]
                if needed:
                    unit.handle_event()
                events.append((time, kind, unit.read(["event.kind"])[0], early, needed))
            if not early:
                break
        points.append(unit.reals(outputs))
    return np.array(points), events


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("method", ["adaptive", "radau"])
def test_events_end_steps_only_where_the_host_allows_it_and_change_no_bit(fmu3, fmu, plain_outputs, scene, method):
    values = {**SCENES[scene], "solver.method": fmu.variable("solver.method").number(method)}
    found = {}
    for events in (False, True):
        for early in (False, True):
            with Unit3(fmu3, eventModeUsed=events, earlyReturnAllowed=early) as unit:
                found[events, early] = march(unit, values, plain_outputs)
    calm, _ = found[False, False]
    for (events, early), (points, seen) in found.items():
        assert np.array_equal(points, calm), (events, early)
        assert any(each[3] for each in seen) == early
        assert any(each[4] for each in seen) == events
        # discrete outputs change only in event mode if the host handles events
        assert all((before == after) != (needed and after != 0) or before == after for _, before, after, _, needed in seen)
    times = [time for time, *_ in found[True, True][1]]
    assert times == [time for time, *_ in found[False, True][1]] and len(times) >= 1


@pytest.mark.parametrize("scene", SCENES)
def test_times_of_events_are_within_the_tolerance_of_those_located_at_1e_10(fmu3, scene):
    found = {}
    for tolerance in (1e-6, 1e-10):
        with Unit3(fmu3, earlyReturnAllowed=True) as unit:
            _, events = march(unit, {**SCENES[scene], "solver.relative_tolerance": tolerance}, ["time"])
            found[tolerance] = [(time, kind) for time, kind, *_ in events]
    rough, fine = found[1e-6], found[1e-10]
    assert [kind for _, kind in rough] == [kind for _, kind in fine]
    # speeds of some 30 rad/s are accurate to 1e-6, and brakes change them by some 1000 rad/s²
    assert max(abs(a - b) for (a, _), (b, _) in zip(rough, fine)) < 1e-6


def test_event_mode_publishes_the_events(fmu3):
    with Unit3(fmu3, eventModeUsed=True, earlyReturnAllowed=True) as unit:
        unit.begin(BRAKING)
        needed, _, early, time = unit.step(0.0, 0.2)
        assert needed and early and 0.0 < time < 0.2
        names = ["event.kind", "event.place", "held.wheels"]
        assert unit.read(names) == [0, 0, 0.0]
        unit.handle_event()
        kind, place, held = unit.read(names)
        assert (kind, held) == (1, float(place)) and place in (1, 2)
        assert unit.read(["event.time"])[0] == pytest.approx(time, abs=1e-12)
        assert abs(unit.read([f"{('left', 'right')[place - 1]}.wheel_speed"])[0]) < 0.05


def test_at_the_solver_s_steps_the_host_reads_sets_and_returns_without_changing_results(fmu3, plain_outputs):
    seen, wanted = [], {"at": None}

    def look(_environment, time, set_requested, get_allowed, finished, may_return, requested, _return_time):
        assert get_allowed and set_requested == finished
        seen.append((time, unit.reals(["carrier.speed"])[0]))
        if wanted["at"] is not None and time > wanted["at"] and may_return:
            requested[0] = True

    with Unit3(fmu3) as unit:
        calm, _ = march(unit, TURN, [*plain_outputs])
        steps = unit.reals(["solver.steps"])[0]
    with Unit3(fmu3, intermediateUpdate=look, earlyReturnAllowed=True) as unit:
        watched, _ = march(unit, TURN, plain_outputs)
        assert np.array_equal(watched, calm)
        times = [time for time, _ in seen]
        # the solver's steps and the communication points
        assert abs(len(times) - steps - round(END / STEP)) <= 2 and times == sorted(times)
    with Unit3(fmu3, intermediateUpdate=look, earlyReturnAllowed=True) as unit:
        wanted["at"] = 0.003
        unit.initialise(TURN)
        needed, _, early, time = unit.step(0.0, 0.02)
        assert early and not needed and 0.003 < time < 0.02


def test_inputs_set_at_the_solver_s_steps_act_from_there(fmu3):
    def push(_environment, time, set_requested, *_):
        if set_requested and time > 0.005:
            unit.set({"left.load_torque": 900.0})

    with Unit3(fmu3, intermediateUpdate=push) as unit:
        unit.initialise(TURN)
        unit.step(0.0, 0.02)
        pushed = unit.reals(["left.speed"])[0]
    with Unit3(fmu3) as unit:
        unit.initialise(TURN)
        unit.step(0.0, 0.02)
        assert unit.reals(["left.speed"])[0] - pushed > 0.1


@pytest.mark.parametrize("contact", [1, 2, 3])
def test_an_input_that_follows_time_at_each_solver_step_does_not_shorten_the_steps(fmu3, contact):
    def torque(time):
        return 300.0 + 50.0 * sin(20.0 * time)

    def follow(_environment, time, set_requested, *_):
        if set_requested:
            times.append(time)
            unit.set({"carrier.torque_command": torque(time)})

    step, end, times, sizes = 2e-3, 0.04, [], []
    scene = {"scene.gear_contact": contact, "scene.carrier_drive": 2, "carrier.speed_command": 20.0, "effects.half_shaft": True,
             "inertia.left_end": 1.0, "inertia.right_end": 1.3, "left.load_torque": 0.0, "right.load_torque": 0.0,
             "carrier.torque_command": torque(0.0)}
    with Unit3(fmu3, intermediateUpdate=follow) as unit:
        unit.initialise(scene)
        for k in range(round(end / step)):
            unit.step(k * step, step)
            sizes.append(len(times))
        speed, = unit.reals(["left.wheel_speed"])
    # about as many as with constant torques, not ever more
    assert max(np.diff(sizes, prepend=0)) < 60 and len(times) < 400, np.diff(sizes, prepend=0)
    # half of the impulse of the torque
    impulse = 300.0 * end + 2.5 * (1.0 - cos(20.0 * end))
    assert speed == pytest.approx(20.0 + 0.5 * impulse, rel=5e-3)


def test_arrays_have_the_values_of_the_scalars_in_their_number(fmu3):
    for planets in (2, 4):
        with Unit3(fmu3) as unit:
            unit.initialise({"geometry.planet_count": planets, "geometry.planet_teeth": 10, "geometry.side_teeth": 14} if planets == 2
                            else {"geometry.planet_count": planets})
            unit.step(0.0, 0.01)
            arrays = [name for name, variable in unit.variables.items() if name.startswith("planets.")]
            assert len(arrays) >= 8
            for name in arrays:
                scalars = [f"planet[{k + 1}].{name.removeprefix('planets.')}" for k in range(planets)]
                assert unit.read([name])[0] == unit.read(scalars), name
            pairs = [f"mesh.pair[{k}].force" for k in (1, 2, 3)]
            assert unit.read(["mesh.pairs_force"])[0] == unit.read(pairs)


def test_states_go_back_and_are_refused_by_the_other_version(fmu3, fmu, plain_outputs):
    with Unit3(fmu3) as unit, fmu.open() as two:
        unit.initialise(CLUTCH)
        unit.step(0.0, 0.01)
        state, bytes3 = unit.raw.getFMUState(), unit.save()
        unit.step(0.01, 0.01)
        expected = unit.reals(plain_outputs)
        unit.raw.setFMUState(state)
        unit.step(0.01, 0.01)
        assert np.array_equal(unit.reals(plain_outputs), expected)
        unit.restore(bytes3)
        unit.step(0.01, 0.01)
        assert np.array_equal(unit.reals(plain_outputs), expected)
        two.initialise()
        other = two.raw.deSerializeFMUstate(bytes3)
        with pytest.raises(FMICallException):
            two.raw.setFMUstate(other)
        assert "created with FMI 3.0, but this instance was created with FMI 2.0" in two.messages[-1]


@pytest.mark.parametrize("act, words", [
    (lambda unit: unit.set({"geometry.planet_count": 3}), "set it between fmi3EnterConfigurationMode"),
    (lambda unit: unit.set({"left.speed": 3.0}), "left.speed is an output and cannot be set"),
    (lambda unit: unit.set({"solver.method": 4}), "solver.method: 4 is not one of 1 = adaptive, 2 = fixed_step, 3 = radau"),
    (lambda unit: unit.step(0.0, 0.1), "not legal in the state \"instantiated\"; legal in \"step complete\""),
    (lambda unit: unit.raw.enterEventMode(), "not legal in the state"),
    (lambda unit: unit.raw.fmi3GetFloat64(unit.raw.component, (ctypes.c_uint * 1)(99999), 1, (ctypes.c_double * 1)(), 1),
     "there is no variable with value reference 99999"),
    (lambda unit: unit.raw.fmi3GetFloat64(unit.raw.component, (ctypes.c_uint * 1)(0), 1, (ctypes.c_double * 2)(), 2),
     "have 1 values, but the host has room for 2"),
    (lambda unit: unit.raw.fmi3GetInt8(unit.raw.component, (ctypes.c_uint * 1)(0), 1, (ctypes.c_int8 * 1)(), 1), "is not of type Int8"),
])
def test_wrong_calls_are_refused_by_name(fmu3, act, words):
    with Unit3(fmu3) as unit:
        with pytest.raises(FMICallException):
            act(unit)
        assert words in unit.messages[-1][1]


def test_an_instance_of_one_version_is_refused_by_the_other(fmu3, fmu):
    with Unit3(fmu3) as unit:
        library = ctypes.CDLL(unit.raw.dll._name)
        library.fmi2Reset.argtypes, library.fmi2Reset.restype = [ctypes.c_void_p], ctypes.c_int
        assert library.fmi2Reset(unit.raw.component) == 3
        assert "created with FMI 3.0" in unit.messages[-1][1]


def test_a_controller_that_acts_at_a_wheel_s_stop_needs_a_twentieth_of_the_steps(fmu3):
    """It releases the brake of a wheel that stops, either by early return or by polling every 10 us."""
    end, names = 0.1, ["left.wheel_speed", "right.wheel_speed", "carrier.angle"]

    def release(unit, held):
        unit.set({f"{side}.brake_torque": 0.0 for bit, side in ((1, "left"), (2, "right")) if int(held) & bit})

    with Unit3(fmu3, eventModeUsed=True, earlyReturnAllowed=True) as unit:
        unit.begin(BRAKING)
        time, few = 0.0, 0
        while time < end - 1e-12:
            event, _, _, time = unit.step(time, min(5e-3, end - time))
            few += 1
            if event:
                unit.raw.enterEventMode()
                unit.raw.updateDiscreteStates()
                if unit.read(["event.kind"]) == [1]:
                    release(unit, unit.reals(["held.wheels"])[0])
                unit.raw.enterStepMode()
        by_events = unit.reals(names)
    with Unit3(fmu3) as unit:
        unit.initialise(BRAKING)
        many = round(end / 1e-5)
        for k in range(many):
            unit.step(k * 1e-5, (k + 1) * 1e-5 - k * 1e-5)
            release(unit, unit.reals(["held.wheels"])[0])
        by_looking = unit.reals(names)
    assert 20 * few <= many
    # polling is late by at most 10 us, in which a brake changes speeds by some 1000 rad/s² and moves teeth through the backlash
    assert by_events == pytest.approx(by_looking, abs=0.05)


def test_a_discarded_step_gives_the_time_at_which_it_failed(fmu3):
    flags, last = [ctypes.c_bool() for _ in range(3)], ctypes.c_double(-1.0)
    with Unit3(fmu3) as unit:
        unit.initialise({})
        for k in range(2):
            unit.step(k * 1e-3, 1e-3)
        unit.set({"left.load_torque": 1e7})
        step = unit.raw.dll.fmi3DoStep
        step.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_bool, *[ctypes.c_void_p] * 4]
        discarded = 2
        assert step(unit.raw.component, 2e-3, 1e-2, False, *map(ctypes.byref, flags), ctypes.byref(last)) == discarded
    # the teeth bend too far long before the end, but not at the start
    assert 2e-3 < last.value < 12e-3
