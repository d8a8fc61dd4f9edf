"""Events of the unit of FMI 3.0 that commands cause, and event mode: after each event, `held.*` and `event.*` agree with a run
without event mode, and the motion keeps its bits."""


import numpy as np
import pytest
from fmi3 import Unit3
from fmpy import simulate_fmu

CONTACTS = pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
HELD = ["held.sides", "held.planets", "held.wheels"]
NOTHING, STOPS, LOOSE, STICKS, SLIPS, BREAKS = range(6)
LEFT, RIGHT = 1, 2
STEP = 0.01
REST = {"effects.wheel_brake": True, "scene.carrier_drive": 2, "scene.start": 3, "carrier.speed_command": 0.0,
        "carrier.torque_command": 0.0, "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 1.0,
        "inertia.right_end": 1.4}
ROLLING = REST | {"scene.start": 2, "carrier.speed_command": 30.0}
DRIVEN = REST | {"carrier.torque_command": 100.0, "left.brake_torque": 300.0, "right.brake_torque": 300.0}


def brakes(torque):
    return {"left.brake_torque": torque, "right.brake_torque": torque}


# scene, step size, commands at the start of steps, and the events that they cause
COMMANDS = {
    "brake": (REST, STEP, {2: brakes(100.0), 5: brakes(0.0)},
              {2: [(STOPS, LEFT), (STOPS, RIGHT)], 5: [(LOOSE, LEFT), (LOOSE, RIGHT)]}),
    "one_brake": (REST, STEP, {1: {"right.brake_torque": 60.0}, 3: {"right.brake_torque": 0.0}},
                  {1: [(STOPS, RIGHT)], 3: [(LOOSE, RIGHT)]}),
    "lock": (REST, STEP, {2: {"lock.command": 1.0}, 5: {"lock.command": 0.0}},
             {2: [(STICKS, LEFT), (STICKS, RIGHT)], 5: [(SLIPS, LEFT), (SLIPS, RIGHT)]}),
    "lock_alone": (REST | {"effects.wheel_brake": False}, STEP, {2: {"lock.command": 1.0}, 5: {"lock.command": 0.0}},
                   {2: [(STICKS, LEFT), (STICKS, RIGHT)], 5: [(SLIPS, LEFT), (SLIPS, RIGHT)]}),
    "both": (REST, STEP, {2: brakes(100.0) | {"lock.command": 1.0}, 5: brakes(0.0)},
             {2: [(STICKS, LEFT), (STICKS, RIGHT), (STOPS, LEFT), (STOPS, RIGHT)], 5: [(LOOSE, LEFT), (LOOSE, RIGHT)]}),
    # the drive loads each wheel with 50 N.m
    "lowered": (DRIVEN, 0.05, {6: {"left.brake_torque": 20.0}}, {6: [(LOOSE, LEFT)]}),
}


@pytest.fixture(scope="module")
def level(fmu):
    """level(contact): number of a level of gear contact."""
    return lambda contact: {"scene.gear_contact": fmu.variable("scene.gear_contact").number(contact)}


def opened(file, events, early, **options):
    return Unit3(file, eventModeUsed=events, earlyReturnAllowed=early, **options)


class Run:
    """Run with `commands`, which are set at the start of steps, in event mode or in step mode. Records the outputs and the last event
    at all communication points, and each event with the step and the time of its report."""

    def __init__(self, file, outputs, values, commands, events=False, early=False, in_event_mode=False, step=STEP):
        self.rows, self.last, self.reported, self.flags = [], [], [], []
        with opened(file, events, early) as unit:
            unit.begin(values)
            for k in range(8):
                time, until, early = k * step, (k + 1) * step, True
                if in_event_mode and k in commands:
                    self.note(k, time, unit.handle_event(commands[k]))
                else:
                    unit.set(commands.get(k, {}))
                while early:
                    needed, _, early, time = unit.step(time, until - time)
                    self.flags.append((k, time, needed, early))
                    if needed:
                        self.note(k, time, unit.handle_event())
                self.rows.append(unit.reals(outputs))
                self.last.append(unit.event())
        self.rows = np.array(self.rows)

    def note(self, k, time, events):
        self.reported += [(k, time, *event) for event in events]

    def kinds(self, k):
        return [(kind, place) for step, _, kind, place, *_ in self.reported if step == k]


@CONTACTS
@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("way", ["at the end of the step", "by early return", "in event mode", "in event mode, with early return"])
def test_a_hold_by_command_is_an_event(fmu3, plain_outputs, level, contact, name, way):
    values, size, commands, expected = COMMANDS[name]
    values = values | level(contact)
    early, in_event_mode = "early" in way, "event mode" in way
    plain = Run(fmu3, plain_outputs, values, commands, step=size)
    run = Run(fmu3, plain_outputs, values, commands, True, early, in_event_mode, size)
    # the motion keeps its bits, and outputs that change only at events agree
    assert np.array_equal(run.rows, plain.rows), [name for name, same in zip(plain_outputs, (run.rows == plain.rows).all(0)) if not same]
    assert run.last == plain.last
    for k, events in expected.items():
        assert run.kinds(k) == events
        if (contact, name) == ("lumped", "lowered"):
            # lumped gears bounce for a long time: the wheel slides when it turns forward again
            continue
        reported = {time for step, time, *_ in run.reported if step == k}
        happened = {event[2] for step, _, *event in run.reported if step == k}
        assert happened == {k * size}
        assert reported == {(k + 1) * size if way == "at the end of the step" else k * size}
        flags = [(time, early) for step, time, needed, early in run.flags if step == k and needed]
        assert flags == {"at the end of the step": [((k + 1) * size, False)], "by early return": [(k * size, True)]}.get(way, [])
    # event numbers count all events
    numbers = [number for *_, number in run.reported]
    assert numbers == list(range(1, len(numbers) + 1))


@CONTACTS
@pytest.mark.parametrize("early", [False, True])
def test_held_bodies_are_shown_after_the_update_in_which_a_command_was_set(fmu3, level, contact, early):
    with opened(fmu3, True, early) as unit:
        unit.begin(REST | level(contact))
        unit.step(0.0, STEP)
        for command, held in ((brakes(100.0), [0, 0, 2]), ({"lock.command": 1.0}, [2, 0, 2]), (brakes(0.0), [2, 0, 0]),
                              ({"lock.command": 0.0}, [0, 0, 0])):
            before = unit.reals(HELD).tolist()
            unit.raw.enterEventMode()
            unit.set(command)
            assert unit.reals(HELD).tolist() == before
            assert len(unit.update()) == 2
            assert unit.reals(HELD).tolist() == held
            # a further update without a command reports nothing new
            last = unit.event()
            assert unit.update() == [last]
            unit.raw.enterStepMode()
        # the next step has no unreported event
        assert unit.step(STEP, STEP)[0] is False


@CONTACTS
def test_an_update_without_a_change_of_friction_leaves_the_command_to_the_step(fmu3, plain_outputs, level, contact):
    """Brakes on rolling wheels hold nothing, and loads are not commands that hold."""
    commands = {2: brakes(40.0), 4: {"left.load_torque": -80.0}, 5: {"left.load_torque": 10.0, "right.brake_torque": 0.0}}
    runs = [Run(fmu3, plain_outputs, ROLLING | level(contact), commands, *how)
            for how in ((), (True, True), (True, True, True), (True, False, True))]
    for run in runs[1:]:
        assert np.array_equal(run.rows, runs[0].rows)
        assert run.last == runs[0].last
        assert run.reported == []


@CONTACTS
@pytest.mark.parametrize("early", [False, True])
def test_a_further_command_in_the_same_event_mode_keeps_the_bits(fmu3, plain_outputs, level, contact, early):
    """A controller applies a brake, reads that it holds, and releases the other brake, all at the same time."""
    values = DRIVEN | level(contact) | {"right.brake_torque": 0.0, "left.brake_torque": 0.0, "carrier.torque_command": 0.0}
    last = {"left.brake_torque": 0.0, "right.brake_torque": 80.0, "carrier.torque_command": 30.0}
    plain = Run(fmu3, plain_outputs, values, {3: last})
    rows = []
    with opened(fmu3, True, early) as unit:
        unit.begin(values)
        for k in range(8):
            if k == 3:
                unit.raw.enterEventMode()
                unit.set({"left.brake_torque": 80.0, "right.brake_torque": 80.0})
                assert [event[:2] for event in unit.update()] == [(STOPS, LEFT), (STOPS, RIGHT)]
                unit.set({"left.brake_torque": 0.0, "carrier.torque_command": 30.0})
                assert [event[:2] for event in unit.update()] == [(LOOSE, LEFT)]
                assert unit.reals(HELD).tolist() == [0, 0, 1]
                unit.raw.enterStepMode()
            unit.step(k * STEP, (k + 1) * STEP - k * STEP)
            rows.append(unit.reals(plain_outputs))
    assert np.array_equal(rows, plain.rows)


@CONTACTS
def test_a_broken_tooth_by_trigger_is_an_event_at_the_start_of_the_step(fmu3, plain_outputs, level, contact):
    if contact != "tooth":
        pytest.skip("a tooth breaks only where there are teeth")
    values = ROLLING | {"effects.tooth_fault": True}
    plain, *runs = [Run(fmu3, plain_outputs, values, {3: {"fault.trigger": 1.0}}, *how)
                    for how in ((), (True, False), (True, True), (True, True, True))]
    assert all(np.array_equal(run.rows, plain.rows) and run.last == plain.last for run in runs)
    assert [run.reported[0][:4] for run in runs] == [(3, time, BREAKS, 0) for time in (4 * STEP, 3 * STEP, 3 * STEP)]


def stops(file, values, early, end):
    """All events of a step of `end` [s], with or without early returns, and the outputs at its end."""
    with opened(file, True, early) as unit:
        unit.begin(values)
        time, reported, going = 0.0, [], True
        while going:
            needed, _, going, time = unit.step(time, end - time)
            reported.append(unit.handle_event() if needed else [])
        return reported, unit.reals(HELD).tolist()


@CONTACTS
def test_two_wheels_that_stop_in_one_step_are_reported_in_order(fmu3, level, contact):
    values = ROLLING | level(contact) | {"left.brake_torque": 900.0, "right.brake_torque": 700.0}
    early, held = stops(fmu3, values, True, 0.3)
    late, held_late = stops(fmu3, values, False, 0.3)
    # one event mode reports the same events as several with early return
    assert len(late) == 1 and len(late[0]) >= 2
    assert late[0] == [event for reported in early for event in reported]
    assert held == held_late == [0, 0, 2]
    assert {place for kind, place, *_ in late[0] if kind == STOPS} == {LEFT, RIGHT}
    times = [time for *_, time, _ in late[0]]
    assert times == sorted(times)
    assert [number for *_, number in late[0]] == list(range(1, len(late[0]) + 1))


def test_a_host_that_iterates_once_gets_the_other_events_after_the_next_steps(fmu3):
    values = ROLLING | {"left.brake_torque": 900.0, "right.brake_torque": 700.0}
    with opened(fmu3, True, False) as unit:
        unit.begin(values)
        numbers, time = [], 0.0
        for size in (0.3, STEP, STEP, STEP, STEP):
            needed, _, _, time = unit.step(time, size)
            if needed:
                unit.raw.enterEventMode()
                more = unit.raw.updateDiscreteStates()[0]
                numbers.append(unit.event()[-1])
                unit.raw.enterStepMode()
                assert unit.reals(HELD)[2] == 2
        assert numbers == list(range(1, len(numbers) + 1)) and len(numbers) >= 2 and not more


# wheels on soft shafts stick and slip in their brakes
JUDDER = {"effects.wheel_brake": True, "wheel_brake.static_ratio": 2.0, "effects.half_shaft": True, "carrier.speed_command": 1.0,
          "half_shaft.left_stiffness": 500.0, "half_shaft.right_stiffness": 500.0, "half_shaft.left_damping": 0.0,
          "half_shaft.right_damping": 0.0, "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 0.5,
          "inertia.right_end": 0.5, "scene.start": 3} | brakes(100.0)


def test_of_many_events_in_one_step_the_last_eight_are_reported(fmu3, level):
    values = JUDDER | level("ideal")
    early, _ = stops(fmu3, values, True, 3.0)
    everything = [event for reported in early for event in reported]
    assert len(everything) > 12
    late, _ = stops(fmu3, values, False, 3.0)
    assert late == [everything[-8:]]
    assert late[0][0][-1] == len(everything) - 7


def mirrored(values):
    return {name: -value if name in ("carrier.torque_command", "carrier.speed_command", "left.load_torque", "right.load_torque")
            else value for name, value in values.items()}


@CONTACTS
@pytest.mark.parametrize("values", [ROLLING | {"left.brake_torque": 900.0, "right.brake_torque": 700.0}, DRIVEN],
                         ids=["rolling", "driven"])
@pytest.mark.parametrize("in_event_mode", [False, True])
def test_a_mirrored_scene_has_the_same_events(fmu3, plain_outputs, level, contact, values, in_event_mode):
    commands = {4: {"left.brake_torque": 20.0}, 6: brakes(400.0)}
    found = []
    for scene in (values, mirrored(values)):
        run = Run(fmu3, plain_outputs, scene | level(contact), commands, True, True, in_event_mode, step=0.05)
        found.append((run.reported, run.rows[:, [plain_outputs.index(name) for name in HELD]].tolist()))
    (reported, held), (reported_back, held_back) = found
    assert held == held_back and len(reported) >= 1
    assert [(event[0], *event[2:4]) for event in reported] == [(event[0], *event[2:4]) for event in reported_back]
    # in reverse, teeth use the other flank, which has the same shape
    assert [event[4] for event in reported] == pytest.approx([event[4] for event in reported_back], abs=1e-5)


@CONTACTS
@pytest.mark.parametrize("early", [False, True])
@pytest.mark.parametrize("in_event_mode", [False, True])
def test_a_restored_state_has_the_events_and_holds_of_its_time(fmu3, plain_outputs, level, contact, early, in_event_mode):
    """Also in another instance, and within event mode between two reports."""
    names = plain_outputs

    def go_on(unit):
        """Continues from 0.02 s, where brakes are applied."""
        seen, time = [], 0.02
        if in_event_mode:
            seen += unit.handle_event(brakes(100.0))
        else:
            unit.set(brakes(100.0))
        for k in range(2, 5):
            going = True
            while going:
                needed, _, going, time = unit.step(time, (k + 1) * STEP - time)
                if needed:
                    seen += unit.handle_event()
            seen.append((unit.event(), unit.reals(names).tolist()))
        return seen

    values = REST | level(contact)
    with opened(fmu3, True, early) as unit, opened(fmu3, True, early) as other:
        unit.begin(values)
        other.begin(values)
        unit.handle_event({"lock.command": 1.0})
        for k in range(2):
            unit.step(k * STEP, STEP)
        before = (unit.event(), unit.reals(HELD).tolist())
        assert before == ((STICKS, RIGHT, 0.0, 2), [2, 0, 0])
        state = unit.raw.getFMUState()
        kept = unit.save()
        first = go_on(unit)
        assert first[-1][0][:2] == (STOPS, RIGHT)
        unit.raw.setFMUState(state)
        assert (unit.event(), unit.reals(HELD).tolist()) == before
        assert go_on(unit) == first
        other.restore(kept)
        assert (other.event(), other.reals(HELD).tolist()) == before
        assert go_on(other) == first


def test_a_state_saved_between_two_reports_reports_the_rest(fmu3):
    with opened(fmu3, True, True) as unit:
        unit.begin(REST)
        unit.raw.enterEventMode()
        unit.set(brakes(100.0))
        assert unit.raw.updateDiscreteStates()[0] and unit.event()[:2] == (STOPS, LEFT)
        state = unit.raw.getFMUState()
        for _ in range(2):
            assert not unit.raw.updateDiscreteStates()[0] and unit.event()[:2] == (STOPS, RIGHT)
            unit.raw.setFMUState(state)
            assert unit.event()[:2] == (STOPS, LEFT)


@pytest.mark.parametrize("events", [False, True])
def test_a_state_of_a_host_with_the_other_kind_of_events_keeps_its_outputs(fmu3, events):
    with opened(fmu3, events, False) as unit, opened(fmu3, not events, False) as other:
        for one in (unit, other):
            one.begin(REST)
        unit.set(brakes(100.0))
        if unit.step(0.0, STEP)[0]:
            unit.handle_event()
        state = (unit.event(), unit.reals(HELD).tolist())
        assert state == ((STOPS, RIGHT, 0.0, 2), [0, 0, 2])
        other.restore(unit.save())
        assert (other.event(), other.reals(HELD).tolist()) == state


def test_held_bodies_are_right_in_initialisation_mode(fmu3):
    """Values are those of a host without event mode."""
    with opened(fmu3, True, True) as unit:
        unit.set(REST | brakes(100.0))
        unit.raw.enterInitializationMode()
        assert unit.reals(HELD).tolist() == [0, 0, 2]
        unit.set(brakes(0.0))
        assert unit.reals(HELD).tolist() == [0, 0, 0]
        unit.set(brakes(50.0))
        unit.raw.exitInitializationMode()
        assert unit.reals(HELD).tolist() == [0, 0, 2] and unit.event() == (NOTHING, 0, 0.0, 0)


@CONTACTS
@pytest.mark.parametrize("early", [False, True])
def test_a_command_within_a_step_is_an_event_there(fmu3, level, contact, early):
    """The host sets brakes at a step of the solver, in its intermediate update."""
    times = []

    def brake(_environment, time, set_requested, *_):
        if set_requested and time > 0.004 and not times:
            times.append(time)
            unit.set(brakes(100.0))

    # a small load on the left wheel makes the solver take steps; the right wheel stays at rest
    values = REST | level(contact) | {"effects.half_shaft": True, "left.load_torque": 0.01}
    with opened(fmu3, True, early, intermediateUpdate=brake) as unit:
        unit.begin(values)
        needed, _, returned, time = unit.step(0.0, 0.05)
        assert needed and returned == early and time == (times[0] if early else 0.05)
        assert unit.reals(HELD)[2] == 0
        reported = unit.handle_event()
        assert (STOPS, RIGHT, times[0]) in [event[:3] for event in reported]


def test_a_parameter_that_is_tuned_after_an_early_return_loses_no_motion(fmu3):
    """The carrier turns at an imposed speed, so its angle is known."""
    values = {"effects.wheel_brake": True, "left.brake_torque": 900.0, "scene.start": 2, "carrier.speed_command": 30.0,
              "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.left_end": 0.6, "inertia.right_end": 0.6}
    with opened(fmu3, True, True) as unit:
        unit.begin(values)
        needed, _, early, time = unit.step(0.0, 0.2)
        assert needed and early and 0.0 < time < 0.2
        unit.raw.enterEventMode()
        unit.set({"oil.temperature": 340.0})
        unit.update()
        unit.raw.enterStepMode()
        while early:
            needed, _, early, time = unit.step(time, 0.2 - time)
            assert unit.reals(["carrier.angle"])[0] == pytest.approx(30.0 * time, rel=1e-9)


def test_events_of_three_planets_that_differ_name_each_of_them(fmu3):
    values = {"geometry.planet_count": 3, "geometry.side_teeth": 18, "effects.thrust_friction": True,
              "solver.merge_planets": False, "scene.start": 3, "scene.carrier_drive": 2, "carrier.torque_command": 300.0, "carrier.speed_command": 0.0, "left.load_torque": 100.0,
              "right.load_torque": 200.0, "inertia.left_end": 0.5, "inertia.right_end": 0.8}
    with opened(fmu3, True, True) as unit:
        unit.begin(values)
        time, places = 0.0, set()
        while time < 0.05:
            needed, _, _, time = unit.step(time, 0.05 - time)
            if needed:
                places |= {place for _, place, *_ in unit.handle_event()}
        assert places == {1, 2, 3}


@CONTACTS
def test_in_model_exchange_commands_are_events_too(exchange, level, contact):
    unit = exchange(REST | level(contact))
    assert unit.event() == (NOTHING, 0, 0.0, 0)
    for command, kind, held in ((brakes(100.0), STOPS, [0, 0, 2]), ({"lock.command": 1.0}, STICKS, [2, 0, 2]),
                                (brakes(0.0), LOOSE, [2, 0, 0]), ({"lock.command": 0.0}, SLIPS, [0, 0, 0])):
        unit.set(command)
        assert [event[:2] for event in unit.update()] == [(kind, LEFT), (kind, RIGHT)]
        assert unit.reals(HELD).tolist() == held
    # a command that is set between events requests an event
    unit.raw.enterContinuousTimeMode()
    unit.set({"left.brake_torque": 50.0})
    assert unit.raw.completedIntegratorStep()[0]
    assert unit.reals(HELD).tolist() == [0, 0, 0]
    unit.raw.enterEventMode()
    assert [event[:2] for event in unit.update()] == [(STOPS, LEFT)]
    assert unit.reals(HELD).tolist() == [0, 0, 1]


def test_a_solver_of_the_host_finds_the_events_of_the_fmu_s_solver(fmu3, level):
    values = ROLLING | level("ideal") | {"left.brake_torque": 900.0, "right.brake_torque": 700.0}
    own, _ = stops(fmu3, values, True, 0.3)
    own = [event for reported in own for event in reported]
    names = ["event.kind", "event.place", "event.time", "event.count", "held.wheels"]
    # changed rows of the record are events
    record = simulate_fmu(str(fmu3), fmi_type="ModelExchange", start_values=values, stop_time=0.3, output_interval=1e-3,
                          output=names, relative_tolerance=1e-9)
    found = []
    for row in record:
        event = tuple(row[name] for name in names[:4])
        if event[3] and (not found or event != found[-1]):
            found.append(event)
    assert [event[:2] for event in found] == [event[:2] for event in own]
    assert [event[2] for event in found] == pytest.approx([event[2] for event in own], abs=1e-4)
    assert record["held.wheels"][-1] == 2.0


# planets stick and slip on their washers within microseconds, after a start from mid-gap
CHATTER = REST | {"scene.start": 2, "effects.thrust_friction": True, "left.load_torque": 30.0}


@pytest.mark.parametrize("early", [False, True])
def test_switches_in_quick_succession_keep_their_bits_with_communication_points_and_early_returns(fmu3, plain_outputs, early):
    def end(points):
        with opened(fmu3, False, early) as unit:
            unit.initialise(CHATTER)
            for begin, until in zip(points, points[1:], strict=False):
                time, going = begin, True
                while going:
                    _, _, going, time = unit.step(time, until - time)
            return unit.reals(plain_outputs)

    with opened(fmu3, False, False) as unit:
        unit.initialise(CHATTER)
        unit.step(0.0, 0.02)
        expected = unit.reals(plain_outputs)
    for points in ([0.0, 0.02], np.linspace(0.0, 0.02, 21).tolist(), np.linspace(0.0, 0.02, 201).tolist()):
        assert np.array_equal(end(points), expected), len(points)


def test_looking_at_the_steps_of_the_solver_changes_no_bit_after_a_tooth_breaks_at_its_onset(fmu3, plain_outputs):
    values = ROLLING | {"effects.tooth_fault": True, "tooth_fault.at_onset": True, "tooth_fault.onset": 0.03}
    commands = {1: {"left.load_torque": -50.0}, 2: {"left.load_torque": -100.0}}
    rows = []
    for options in ({}, {"intermediateUpdate": lambda *_: None}):
        with opened(fmu3, False, False, **options) as unit:
            unit.initialise(values)
            for k in range(4):
                unit.set(commands.get(k, {}))
                unit.step(0.02 * k, 0.02)
            rows.append(unit.reals(plain_outputs))
    assert np.array_equal(*rows)
