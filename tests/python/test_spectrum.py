"""Damage over a duty cycle: counts and damage by hand, the FMU's own damage, symmetries and lives."""

from concurrent.futures import ThreadPoolExecutor
from math import ceil, log, pi

import numpy as np
import pytest
from duty_cycles import FLANKS, HEAD, ROOTS

from bevel_differential import Differential, DifferentialError, DifferentialWarning
from bevel_differential.spectrum import Event, spectrum
from bevel_differential.spectrum.damage import MODES
from bevel_differential.spectrum.history import strokes
from bevel_differential.spectrum.picture import _caption, curve, rolling_spectrum, standing_spectrum
from bevel_differential.spectrum.result import STANDS
from bevel_differential.spectrum.slow import closed_cycles, count_slow_cycles
from bevel_differential.spectrum.tooth import passes_between

# the FMU's start values, by the standards cited in docs/inside/theory.md
BENDING, BENDING_CYCLES, BENDING_SLOPE = 1000e6, 3e6, log(3e6 / 1e3) / log(2.5)
CONTACT, CONTACT_CYCLES, CONTACT_SLOPE = 1500e6, 5e7, log(5e7 / 1e5) / log(1.6)
IDLER, SENSITIVITY = 0.7, 0.4
LUMPED = {"scene.gear_contact": "lumped"}


@pytest.fixture
def stress(fmu_file):
    """stress(torque): root stress of the planets and of the side gears under a torque of the ring gear [Pa]."""

    def of(torque):
        with Differential({**LUMPED, "effects.strength": True}, fmu=fmu_file) as differential:
            loads = {"left.load_torque": torque / 2.0, "right.load_torque": torque / 2.0}
            return list(differential.final(["stress.root_planet_max", "stress.root_side_max"], loads, 0.01).values())

    return of


def event(name="event", count=1.0, duration=10.0, speed=15.0, spin=0.0, left=400.0, right=400.0, **more):
    values = {"carrier.speed_command": speed, "scene.planet_spin": "imposed", "spin.command": spin,
              "left.load_torque": left, "right.load_torque": right}
    return Event(name, count, duration, values=values, **more)


def bending(stress):
    return (stress / BENDING) ** BENDING_SLOPE / BENDING_CYCLES


def pitting(pressure):
    return np.array((pressure / CONTACT) ** CONTACT_SLOPE / CONTACT_CYCLES)


def all_damages(result):
    return np.array(list(result.damage.values()))


def test_a_history_that_repeats_is_counted_as_the_example_of_the_standard():
    # ASTM E1049-85, 5.4.5, figure 7: −2, 1, −3, 5, −1, 3, −4, 4, −2
    cycles = {high - low: count for low, high, count, *_ in _merged(closed_cycles(np.array([-2.0, 1, -3, 5, -1, 3, -4, 4, -2])))}
    assert cycles == {3.0: 1.0, 4.0: 1.0, 7.0: 1.0, 9.0: 1.0}


def test_passes_and_strokes_by_hand():
    # there and back over a tooth counts twice; a turn at a tooth counts once
    teeth = np.arange(10)
    assert passes_between(0.0, 2.5, teeth, 10).tolist() == [0, 1, 1, 0, 0, 0, 0, 0, 0, 0]
    assert passes_between(2.5, -1.5, teeth, 10).tolist() == [1, 1, 1, 0, 0, 0, 0, 0, 0, 1]
    assert passes_between(0.0, -23.0, teeth, 10).tolist() == [2, 2, 2, 2, 2, 2, 2, 3, 3, 3]
    assert np.sum(passes_between(0.0, 2.0, teeth, 10)) == np.sum(passes_between(2.0, 0.0, teeth, 10)) == 2
    # returns of up to 0.05 pitches belong to the stroke
    assert strokes(np.array([0.0, 0.6, 0.56, 0.8, 0.8, 0.1, 0.13, -1.0, -0.97])) == [(0, 3), (3, 7)]
    assert strokes(np.array([0.0, 0.04, -0.01])) == []


def _merged(cycles):
    counts = {}
    for low, high, count, *_ in cycles:
        counts[low, high] = counts.get((low, high), 0.0) + count
    return [(low, high, count) for (low, high), count in counts.items()]


def test_the_worst_order_lets_the_largest_peaks_meet_the_deepest_valleys():
    histories = [np.array([6.0]), np.array([-3.0]), np.array([2.0, 1.0, 2.0]), np.empty(0)]
    found = count_slow_cycles(histories, [3.0, 2.0, 0.5, 9.0], "unknown")
    assert sorted(_merged(zip(found.low, found.high, found.count))) == [
        (-3.0, 6.0, 2.0), (0.0, 2.0, 0.5), (0.0, 6.0, 1.0), (1.0, 2.0, 0.5)]


def test_in_the_written_order_events_follow_each_other_without_unloading():
    histories = [np.array([6.0]), np.array([4.0]), np.array([-3.0])]
    found = count_slow_cycles(histories, [1.0, 1.0, 1.0], "written")
    assert _merged(zip(found.low, found.high, found.count)) == [(-3.0, 6.0, 1.0)]
    # an event that occurs twice keeps its load between the two
    found = count_slow_cycles(histories, [1.0, 2.0, 1.0], "written")
    assert _merged(zip(found.low, found.high, found.count)) == [(-3.0, 6.0, 1.0)]
    # teeth that roll out of mesh are unloaded
    found = count_slow_cycles([*histories, np.empty(0)], [1.0, 2.0, 1.0, 2.0], "written")
    assert sorted(_merged(zip(found.low, found.high, found.count))) == [(-3.0, 6.0, 1.0)]
    found = count_slow_cycles([histories[1], np.empty(0)], [3.0, 2.0], "written")
    assert _merged(zip(found.low, found.high, found.count)) == [(0.0, 4.0, 1.0)]
    with pytest.raises(DifferentialError, match="whole number"):
        count_slow_cycles(histories, [1.0, 0.5, 1.0], "written")


def test_in_the_written_order_a_count_is_that_many_equal_lines():
    draw = np.random.default_rng(5)
    for _ in range(200):
        histories = [draw.integers(-5, 6, draw.integers(0, 5)).astype(float) for _ in range(draw.integers(1, 5))]
        counts = draw.integers(0, 4, len(histories))
        together = count_slow_cycles(histories, counts.astype(float), "written")
        lines = [history for history, count in zip(histories, counts) for _ in range(count)]
        apart = count_slow_cycles(lines, [1.0] * len(lines), "written")
        assert sorted(_merged(zip(together.low, together.high, together.count))) == \
            sorted(_merged(zip(apart.low, apart.high, apart.count))), (histories, counts)


def test_drive_and_overrun_straight_ahead_by_hand(cycle, stress):
    head = "name,count,duration [s],speed [km/h],torque [N·m]"
    result = cycle(head, "drive,3,10,50,1200", "overrun,2,5,50,-600", parameters=LUMPED)
    found = []
    for drive in stress(1200.0):
        overrun = 0.5 * drive
        # two cycles from −1/2 to 1: mean over amplitude 1/3; the root at the drive flank is in tension
        permissible = 1.0 / (1.0 + SENSITIVITY / 3.0)
        alternating = (drive + overrun) / ((1.0 + SENSITIVITY) * permissible)
        found.append(2.0 * bending(alternating) + 1.0 * bending(drive))
    assert [result.damage[name] for name in ROOTS] == pytest.approx(found, rel=1e-6)
    assert [result.damage[name] for name in FLANKS] == [0.0, 0.0]
    assert result.hours == pytest.approx((3 * 10 + 2 * 5) / 3600.0)
    assert result.km == pytest.approx(50.0 * result.hours)
    assert result.cycles_to_failure == pytest.approx(1.0 / found[0], rel=1e-6)
    assert np.isnan(result.life_hours) and np.isnan(result.life_km)


def test_a_turn_does_the_damage_of_its_passes_by_hand(cycle, stress):
    result = cycle(HEAD, "turn,4,20,18,10,1200", parameters=LUMPED)
    planet, side = stress(1200.0)
    # relative to the carrier, the left side gear turns by v/r w/(2R), and a planet of 10 teeth by 16/10 of it
    pitches = 20 * (18 / 3.6 / 0.334) * 1.55 / (2 * 10) / (2 * pi) * 16
    # a tooth of a planet meets each side gear once in 10 pitches, and one of a side gear meets a planet once in 8 pitches; a tooth that
    # only enters or leaves the mesh, which is shorter than two pitches, loads its root
    bent = [4 * ceil((pitches + 2) / between) for between in (10, 8)]
    assert [result.damage[name] for name in ROOTS] == pytest.approx([bent[0] * bending(planet / IDLER), bent[1] * bending(side)], rel=1e-6)
    passed = [4 * ceil(pitches / between) for between in (10, 8)]
    assert [result.damage[name] for name in FLANKS] == pytest.approx(passed * pitting(CONTACT / result.events[0].safety_flank), rel=1e-6)
    assert result.critical_name == "side flank" and "upper bounds" in result.summary()


@pytest.mark.parametrize("weak", ["planet root", "side root", "side flank"])
def test_the_load_spectrum_and_its_curve_give_the_damage(cycle, weak):
    # very strong flanks, or planets as strong as side gears of which four pass, make the roots or the side gears the critical part
    strong = {} if weak == "side flank" else {"strength.contact_strength": "1e10 Pa"}
    strong |= {"strength.idler_factor": 1.0, "geometry.planet_count": 4} if weak == "side root" else {}
    lines = ["turn,4,20,18,10,1200", "wide,9,20,50,-80,800", "start,3,4,20,,1000", "overrun,5,4,20,,-300"]
    result = cycle(HEAD, *lines, parameters=LUMPED | strong)
    assert result.critical_name == weak
    (rolling, passes), (standing, count) = rolling_spectrum(result), standing_spectrum(result)
    damage = np.sum(passes * curve(result).damage(rolling)) + np.sum(count * curve(result).damage(standing))
    assert damage == pytest.approx(max(result.damage.values()), rel=1e-6)


def test_the_left_wheel_is_the_slow_one_of_a_turn_to_the_left(cycle, fmu_file):
    (left,) = cycle(HEAD, "left,1,5,18,10,500").events
    with Differential(left.event.values, fmu=fmu_file) as differential:
        angles = differential.final(["left.angle", "right.angle"], stop=10.0)
    # mean speeds at R ∓ w/2, because the teeth make speeds ripple
    assert angles["left.angle"] / 10.0 == pytest.approx(18 / 3.6 / 0.334 * (1.0 - 1.55 / 20.0), rel=1e-3)
    assert angles["right.angle"] / 10.0 == pytest.approx(18 / 3.6 / 0.334 * (1.0 + 1.55 / 20.0), rel=1e-3)


@pytest.mark.parametrize("low, high", [(0.0, 800.0), (-500.0, 700.0), (300.0, 800.0)])
@pytest.mark.parametrize("contact", ["lumped", "tooth"])
def test_a_history_of_one_amplitude_does_the_damage_that_the_fmu_counts(run, fmu_file, contact, low, high):
    times = np.linspace(0.0, 2.0, 201)
    load = low + (high - low) * np.sin(pi * 2.0 * times) ** 2
    swing = event(duration=2.0, signals={side: (times, load) for side in ("left.load_torque", "right.load_torque")}, step=2e-3)
    gears = {"scene.gear_contact": contact}
    ours = spectrum([swing], gears, order="written", fmu=fmu_file).damage
    theirs = run({**swing.values, **gears, "effects.strength": True}, 2.0, 2e-3, ROOTS, swing.signals)[-1]
    assert ours["damage.planet"] == pytest.approx(theirs["damage.planet"], rel=1e-3)
    # with single pairs, drive and overrun load different teeth of the side gears
    if contact == "lumped" or low >= 0.0:
        assert ours["damage.side"] == pytest.approx(theirs["damage.side"], rel=1e-3)
    else:
        assert ours["damage.side"] > theirs["damage.side"]


def test_a_history_of_a_steady_turn_does_the_damage_of_the_steady_turn(fmu_file):
    turn = event(duration=80.0, spin=3.5)
    history = event(duration=80.0, spin=3.5, signals={"left.load_torque": (np.array([0.0, 80.0]), np.array([400.0, 400.0]))})
    steady, over_time = (all_damages(spectrum([one], LUMPED, fmu=fmu_file)) for one in (turn, history))
    # both count the largest number of passes in 446 pitches
    assert over_time == pytest.approx(steady, rel=1e-3)


def test_a_history_with_a_turn_and_a_straight_part_counts_each_once(fmu_file, stress):
    # 10 s in a turn, then 10 s straight ahead under swings, without load at the transition
    times = np.array([0.0, 0.1, 9.9, 10.0, 10.5, 11.0, 11.5, 12.0, 20.0])
    load = np.array([0.0, 400.0, 400.0, 0.0, 700.0, 0.0, 700.0, 0.0, 0.0])
    spin = (np.array([0.0, 10.0, 10.0, 20.0]), np.array([3.5, 3.5, 0.0, 0.0]))
    loads = {side: (times, load) for side in ("left.load_torque", "right.load_torque")}
    mixed = spectrum([event(duration=20.0, signals={**loads, "spin.command": spin})], fmu=fmu_file, parameters=LUMPED)
    turn = spectrum([event(duration=9.9, spin=3.5)], fmu=fmu_file, parameters=LUMPED)
    assert mixed.damage["damage.planet_flank"] == pytest.approx(turn.damage["damage.planet_flank"], rel=0.02)
    planet, side = stress(1400.0)
    # the planets turn between occurrences, so a tooth may have one swing on either flank; the other swing is within an occurrence
    assert mixed.damage["damage.planet"] == pytest.approx(turn.damage["damage.planet"] + bending(planet) + bending(planet / IDLER), rel=0.02)
    assert mixed.damage["damage.side"] == pytest.approx(turn.damage["damage.side"] + 2.0 * bending(side), rel=0.02)


EVENTS = [event("cruise", 2, 100.0, 40.0), event("overrun", 5, 4.0, 30.0, left=-200.0, right=-200.0),
          event("turn", 10, 6.0, 15.0, 3.0), event("back", 4, 6.0, -8.0, -5.0, -500.0, -500.0),
          event("start", 7, 3.0, 5.0, left=800.0, right=800.0)]


def changed(one, **values):
    return Event(one.name, values.pop("count", one.count), values.pop("duration", one.duration), values={**one.values, **values})


def test_twice_the_counts_do_twice_the_damage_and_halves_of_events_the_same(fmu_file):
    once = spectrum(EVENTS, fmu=fmu_file)
    twice = spectrum([changed(one, count=2 * one.count) for one in EVENTS], fmu=fmu_file)
    assert all_damages(twice) == pytest.approx(2.0 * all_damages(once), rel=1e-12)
    assert twice.life_hours == pytest.approx(once.life_hours, rel=1e-12)
    half_the_count = spectrum([changed(one, count=one.count / 2) for one in EVENTS for _ in range(2)], fmu=fmu_file)
    assert all_damages(half_the_count) == pytest.approx(all_damages(once), rel=1e-12)
    # in the written order, split events are the same events
    single = [changed(one, count=1.0) for one in EVENTS]
    whole = spectrum(single, order="written", fmu=fmu_file)
    halves = [changed(one, duration=one.duration / 2) for one in single for _ in range(2)]
    in_time = spectrum(halves, order="written", fmu=fmu_file)
    assert all_damages(in_time) == pytest.approx(all_damages(whole), rel=1e-12)


@pytest.mark.parametrize("mirror", [
    lambda v: {"left.load_torque": v["right.load_torque"], "right.load_torque": v["left.load_torque"],
               "spin.command": -v["spin.command"]},
    lambda v: {name: -v[name] for name in v if name != "scene.planet_spin"},
], ids=["left and right", "all signs"])
@pytest.mark.parametrize("order", ["unknown", "written"])
def test_a_mirrored_cycle_does_the_same_damage(fmu_file, mirror, order):
    events = [changed(one, **mirror(one.values)) for one in EVENTS]
    once, mirrored = (spectrum(each, order=order, fmu=fmu_file) for each in (EVENTS, events))
    # the teeth start on the other side of the mesh; revolutions agree to about 1e-4
    assert all_damages(mirrored) == pytest.approx(all_damages(once), rel=1e-3)


def rolled(pitches, torque=1000.0, duration=2.0, **more):
    """Event that rolls planets of 10 teeth by `pitches`."""
    return event(duration=duration, spin=pitches * 2.0 * pi / 10.0 / duration, left=torque / 2.0, right=torque / 2.0, **more)


def test_short_turns_to_both_sides_pass_the_same_tooth_each_time(fmu_file, stress):
    turns = [rolled(2.0), rolled(-2.0)]

    def each_once(evaluate, events):
        found = {id(one): evaluate(one) for one in turns}
        return [found[id(one)] for one in events]

    planet, side = stress(1000.0)
    for order, root in (("written", bending(planet)), ("unknown", bending(planet / IDLER))):
        found = spectrum(1000 * turns, LUMPED, order=order, fmu=fmu_file, mapper=each_once)
        passed = 2000.0 * pitting(CONTACT / found.events[0].safety_flank)
        assert [found.damage[name] for name in FLANKS] == pytest.approx([passed, passed], rel=1e-6)
        # a tooth between two pitches meets one side gear; at an unknown position it may meet both
        assert [found.damage[name] for name in ROOTS] == pytest.approx([2000.0 * root, 2000.0 * bending(side)], rel=1e-6)
        assert ("tooth by tooth" in found.summary()) == (order == "written")


@pytest.mark.parametrize("contact, rolls, torques", [
    ("lumped", [2.3, -3.1, 5.2, -1.4, 12.6], [1200.0] * 5),
    ("lumped", [2.3, -3.1, 5.2, -1.4, 12.6], [1200.0, 1000.0, -1100.0, 1300.0, -800.0]),
    ("lumped", [0.0, 5.0, 0.0, -5.0, 0.0, 5.0], [1200.0, 200.0] * 3),
    ("lumped", [0.8, -0.8] * 4, [1200.0] * 8),
    ("lumped", [36.3, -22.7], [1200.0, -1200.0]),
    ("tooth", [0.0, 5.3, 0.0, 0.0, 2.2, 0.0], [1200.0, -1200.0, 1000.0, -200.0, 600.0, 1400.0]),
])
def test_sums_are_those_of_the_worst_tooth_that_the_fmu_follows(run, fmu_file, contact, rolls, torques):
    events, gears = [rolled(*each) for each in zip(rolls, torques)], {"scene.gear_contact": contact, "contact.law": "line"}
    written, unknown = (all_damages(spectrum(events, gears, order=order, fmu=fmu_file)) for order in ("written", "unknown"))
    # the FMU changes torques at rest and speeds slowly, so that no jump adds dynamic loads
    rows = [(0.0, 0.0, 0.0)]
    for one, torque in zip(events, torques):
        start, load = rows[-1][0] + 0.3, torque / 2.0
        rows += [(start + delay, spin, load) for delay, spin in
                 ((0.0, 0.0), (0.1, 0.0), (0.3, one.values["spin.command"]), (2.1, one.values["spin.command"]), (2.3, 0.0), (2.4, 0.0))]
    times, spins, loads = np.array(rows).T
    signals = {"spin.command": (times, spins), "left.load_torque": (times, loads), "right.load_torque": (times, loads)}
    record = run({**event(left=0.0, right=0.0).values, **gears, "effects.strength": True}, times[-1], 0.01, MODES, signals)[-1]
    theirs = np.array([record[name] for name in MODES])
    assert written[2:] == pytest.approx(theirs[2:], rel=0.02)
    # half cycles that are open at the ends close in a duty cycle that repeats; impacts are not in steady events
    assert np.all(written[:2] > 0.85 * theirs[:2]) and np.all(unknown > 0.99 * theirs)
    assert np.all(unknown >= (1.0 - 1e-9) * written)


def test_a_swing_of_less_than_a_pitch_passes_twice(fmu_file):
    # ten swings of 0.8 pitches in 20 s; a tooth in the middle passes there and back
    times = np.arange(0.0, 21.0, 1.0)
    spin = np.where(np.arange(21) % 2 == 0, 1.0, -1.0) * 0.8 * 2.0 * pi / 10.0
    signals = {"spin.command": (np.repeat(times, 2)[1:-1], np.repeat(spin[:-1], 2))}
    found = spectrum([event(duration=20.0, left=600.0, right=600.0, signals=signals)], LUMPED, fmu=fmu_file)
    once = spectrum([rolled(2.0, 1200.0)], LUMPED, fmu=fmu_file)
    # 20 passes; the bound takes each at the largest load of its stroke, which contains the blow of the reversal
    passes = all_damages(found)[2:] / all_damages(once)[2:]
    assert np.all(passes > 20.0 - 1e-2) and np.all(passes < 23.0), passes


def test_the_sum_of_a_history_is_an_upper_bound_for_all_start_positions(fmu_file):
    # strokes with a peak of the load, of less and of more than a revolution; a tooth meets it only at some start positions
    rows = [(0.0, 0.0, 0.0)]
    for pitches, load in ((2.3, 600.0), (-6.1, 500.0), (13.2, -300.0), (-0.8, 400.0)):
        spin, start = pitches * pi / 10.0, rows[-1][0] + 0.3
        rows += [(start + delay, spin * rolls, load * part) for delay, rolls, part in
                 ((0.0, 0, 0.7), (0.3, 1, 0.7), (1.1, 1, 0.7), (1.2, 1, 1.0), (1.3, 1, 0.7), (2.0, 1, 0.7), (2.3, 0, 0.7))]
    times, spins, loads = np.array([*rows, (rows[-1][0] + 0.3, 0.0, 0.0)]).T
    still = {**event(left=0.0, right=0.0).values, **LUMPED}

    def signals(before):
        # unloaded teeth roll to the start position
        names = dict.fromkeys(["left.load_torque", "right.load_torque"], np.concatenate([np.zeros(4), loads]))
        at = np.concatenate([[0.0, 0.2, 1.8, 2.0], times + 2.0])
        spin = np.concatenate([[0.0, before, before, 0.0], spins])
        return {name: (at, values) for name, values in {**names, "spin.command": spin}.items()}

    history = event(left=0.0, right=0.0, duration=times[-1] + 2.0, signals=signals(0.0))
    ours = {order: all_damages(spectrum([history], LUMPED, order=order, fmu=fmu_file)) for order in ("unknown", "written")}
    with Differential({**still, "effects.strength": True}, fmu=fmu_file) as differential:
        runs = [differential.run(signals(before), MODES, history.duration, 0.01)[-1] for before in np.arange(0.0, 3.5, 0.5)]
    theirs = np.array([[run[name] for name in MODES] for run in runs])
    assert np.all(ours["unknown"] >= 0.999 * theirs.max(axis=0)) and np.all(ours["written"][2:] >= 0.999 * theirs[:, 2:].max(axis=0))
    # start positions matter
    assert np.any(theirs.max(axis=0) > 1.2 * theirs.min(axis=0))


def test_straight_ahead_nothing_passes_and_only_changes_of_load_damage_the_roots(fmu_file):
    straight = spectrum([event(count=3.0)], fmu=fmu_file)
    assert np.array_equal(straight.events[0].meshing, np.zeros(4))
    assert straight.damage["damage.planet"] > 0.0
    assert np.allclose(straight.by_event[:, :2], straight.slow_damage, rtol=0.0, atol=0.0)
    # one load that never changes
    unchanged = spectrum([event()], order="written", fmu=fmu_file)
    assert np.array_equal(all_damages(unchanged), np.zeros(4))
    assert np.isinf(unchanged.life_hours) and "no event" in unchanged.summary()


def test_without_rolling_planets_there_is_no_life_by_hours(cycle, tmp_path):
    head = "name,count,duration [h],speed [km/h],torque [N.m]"
    for sign in (1, -1):
        for hours in (400, 400_000):
            with pytest.warns(DifferentialWarning, match="no event rolls the planets.*add turn_radius or speed_difference"):
                still = cycle(head, f"road,1,{hours},{sign * 100},300")
            assert still.damage["damage.planet"] > 0.0 and np.isnan(still.life_hours) and np.isnan(still.life_km)
            assert "life: none" in still.summary() and "life by" not in still.summary()
            assert "no life" in _caption(still)
    # a curve that does not occur rolls nothing; one that occurs gives a life
    for count, lives in ((0, False), (1, True)):
        curve = cycle(f"{head},turn_radius [m]", "road,1,400,100,300,", f"curve,{count},0.01,20,300,20")
        assert np.isfinite(curve.life_hours) == lives and (STANDS in curve.warnings) != lives


def test_an_unknown_column_is_answered_with_the_columns(cycle):
    with pytest.raises(DifferentialError, match="did you mean speed.*columns are name, .*duration, .*turn_radius, .*input or parameter"):
        cycle("name,count,duration [h],sped [km/h],torque [N.m]", "road,1,4,100,300")


def test_each_side_gear_has_its_own_loads(fmu_file, stress):
    # straight ahead, the left side gear always drives, and the right one drives, then overruns; a planet's tooth meets one of them
    events = [event(left=600.0, right=600.0), event(left=600.0, right=-300.0)]
    planet, side = stress(1200.0)
    alternating = 1.5 / (1.0 + SENSITIVITY) * (1.0 + SENSITIVITY / 3.0)
    found = spectrum(events, LUMPED, order="written", fmu=fmu_file)
    assert [found.damage[name] for name in ROOTS] == pytest.approx([bending(alternating * planet), bending(alternating * side)], rel=0.02)


def test_a_pool_gives_the_same(fmu_file):
    with ThreadPoolExecutor(2) as pool:
        parallel = spectrum(EVENTS, fmu=fmu_file, mapper=pool.map)
    assert np.array_equal(parallel.by_event, spectrum(EVENTS, fmu=fmu_file).by_event)


def test_a_scene_gives_the_parameters_of_the_vehicle(cycle, tmp_path):
    scene = tmp_path / "vehicle.toml"
    scene.write_text('description = "d"\nstop_time = 0.1\nstep = 0.01\noutputs = ["left.speed"]\n'
                     '[set]\nstrength.bending_strength = "1200 MPa"\n')
    lines = "name,count,duration [s],speed [km/h],torque [N.m]", "start,1,4,20,1500"
    plain, stronger = cycle(*lines), cycle(*lines, scene=scene)
    assert plain.damage["damage.side"] / stronger.damage["damage.side"] == pytest.approx(1.2 ** BENDING_SLOPE, rel=1e-9)
