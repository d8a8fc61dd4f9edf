"""Ordinary drives: launches, stops, holds, turns and parking of vehicles from a pedal car to a truck.

`python3 crates/lab/lab.py drives` runs a thousand drives, and repeats one by its seed and index."""

import dataclasses
import json
import os
from collections import Counter

import numpy as np
import ordinary_drives
import pytest
from drive_player import Two, mesh_forces, play
from drive_requirements import judge
from effects_list import effects
from ordinary_courses import MANOEUVRES, Course
from ordinary_vehicles import EFFECTS, vehicle

SEED, COUNT = 1, 48
# number of drives that are drawn, and of drives that are started without being driven
DRAWN, STARTED = 600, 150
LEVELS = {effect.name: effect.contact for effect in effects(os.environ["FMU"])}


def drawn(count, seed=SEED):
    return list(ordinary_drives.drives(seed, count, LEVELS))


@pytest.fixture(scope="module")
def stop(fmu):
    """Drive with a stop and its holds, and its record."""
    drive = next(one for one in drawn(DRAWN, seed=2) if one["manoeuvre"] == "stop" and one["holds"] and "solver.method" not in one["start"]
                 and one["start"]["scene.gear_contact"] == "ideal" and one["start"]["scene.carrier_drive"] == "torque")
    return drive, play(fmu, drive)


@pytest.mark.parametrize("index", range(COUNT))
def test_an_ordinary_drive_meets_all_requirements(fmu, index):
    drive = ordinary_drives.drive(SEED, index, LEVELS)
    verdict = judge(fmu, drive)
    assert not verdict.problems, f"{verdict}\nagain: python3 crates/lab/lab.py drives --seed {SEED} --index {index}"


def test_a_drive_is_the_same_again_and_has_a_json_form():
    for drive in drawn(len(MANOEUVRES)):
        assert json.loads(json.dumps(drive)) == drive == ordinary_drives.drive(SEED, drive["index"], LEVELS)


def test_drives_cover_the_required_cases():
    found = Counter()
    for drive in drawn(DRAWN):
        start = drive["start"]
        carrier, gears = start["scene.carrier_drive"], f"{start['scene.gear_contact']} {start.get('contact.law', 'impact')}"
        found.update([drive["manoeuvre"], f"FMI {drive['fmi']}", f"{drive['step']:g} s", carrier, gears, start["scene.start"],
                      start.get("solver.method", "adaptive"), f"{start.get('geometry.planet_count', 2)} planets"])
        found.update(name for name in ("mirrored", "slopes", "event_mode") if drive[name])
        found.update(name for name in EFFECTS if f"effects.{name}" in start)
        found.update(f"slope {sign:g}" for sign in {np.sign(drive["inputs"]["left.load_torque"][0][1])})
        found.update(name for name in ("final_drive.elastic_mesh", "effects.propeller_shaft", "propeller_shaft.joint_angle") if name in start)
        wheel = start["inertia.left_end"]
        found.update(name for name, fits in (("light", wheel < 0.1), ("heavy", wheel > 90.0)) if fits)
        # a drive with short communication steps is short, and parking for an hour has steps of a second
        assert len(ordinary_drives.times(drive)) < 20_000
    expected = [*(manoeuvre.__name__ for manoeuvre in MANOEUVRES), "park_for_an_hour", "FMI 2.0", "FMI 3.0", *EFFECTS,
                "0.0001 s", "0.001 s", "0.01 s", "1 s", "speed", "torque", "rest", "rolling", "equilibrium",
                "ideal impact", "lumped impact", "solid impact", "tooth impact", "tooth line", "tooth line_weber",
                "adaptive", "fixed_step", "radau", "2 planets", "3 planets", "4 planets", "mirrored", "slopes", "event_mode",
                "final_drive.elastic_mesh", "effects.propeller_shaft", "propeller_shaft.joint_angle", "slope -1", "slope 0", "slope 1", "light", "heavy"]
    assert not [name for name in expected if found[name] < 5], found
    assert found["adaptive"] > 0.8 * DRAWN and found["torque"] > 0.75 * DRAWN


def test_no_drive_is_refused_and_each_of_its_values_takes_effect(fmu):
    for drive in drawn(STARTED, seed=3):
        host = Two(fmu, drive)
        host.start(drive["start"] | {name: float(values[0]) for name, values in ordinary_drives.sampled(drive).items()})
        assert not host.instance.unfelt, (drive["index"], host.instance.unfelt)
        host.close()


def test_inputs_are_lines_and_a_jump_has_its_later_value():
    drive = {"step": 0.1, "stop": 0.6, "inputs": {"a": [[0.1, 1.0], [0.3, 3.0], [0.3 + 1e-12, 7.0], [0.5, 7.0]]}}
    assert ordinary_drives.sampled(drive)["a"] == pytest.approx([1.0, 1.0, 2.0, 7.0, 7.0, 7.0, 7.0])


def test_a_mirrored_drive_has_the_other_sign_and_the_same_brakes():
    for drive in drawn(24):
        image = ordinary_drives.image(drive)
        for name, points in drive["inputs"].items():
            sign = 1.0 if any(of in name for of in ("brake", "lock", "clutch", "dog")) else -1.0
            assert image["inputs"][name] == [[time, sign * value] for time, value in points], name
        assert ordinary_drives.image(image) == drive


def test_a_course_lasts_until_both_wheels_are_at_rest():
    random = np.random.default_rng(1)
    course = Course(random, vehicle(random, False))
    course.rolls(20.0)
    course.go(0.1, left_brake=0.5 * course.grip, right_brake=course.grip)
    course.until_still()
    # ω/(T/J) of the weaker brake; a light carrier couples the wheels slightly
    slowing = 0.5 * course.grip / course.vehicle.wheel
    assert course.speeds == [0.0, 0.0] and course.time == pytest.approx(1.3 * 20.0 / slowing, rel=0.2)
    assert course.firm() > 0.0


def test_a_host_of_fmi_3_sees_the_same_motion_with_and_without_its_events(fmu, stop):
    plain, played = stop[0] | {"fmi": "2.0", "slopes": False}, []
    for change in ({}, {"fmi": "3.0", "event_mode": False}, {"fmi": "3.0", "event_mode": True}):
        played.append(play(fmu, plain | change).values)
    assert played[0]["held.wheels"][-1] == 2.0
    for other in played[1:]:
        assert all(np.array_equal(values, other[name]) for name, values in played[0].items())


def test_impacts_are_counted_where_teeth_cross_the_backlash(fmu):
    torque = [[0.0, 50.0], [0.1, 50.0], [0.1, -50.0], [0.2, -50.0], [0.2, 50.0]]
    none = {f"{side}.{what}_torque": [[0.0, 0.0]] for side in ("left", "right") for what in ("load", "brake")}
    drive = {"fmi": "2.0", "step": 1e-3, "stop": 0.3, "slopes": False, "event_mode": False,
             "inputs": {"carrier.torque_command": torque, **none},
             "start": {"scene.start": "rolling", "scene.carrier_drive": "torque", "carrier.speed_command": 20.0, "inertia.left_end": 1.0,
                       "inertia.right_end": 1.0, "effects.wheel_brake": True}}
    forces = mesh_forces(fmu, drive)
    closes = np.count_nonzero((forces[:-1] == 0.0) & (forces[1:] != 0.0), axis=0)
    # both meshes of a planet close at first and after each reversal; light planets bounce
    assert len(closes) == 2 and np.all(closes >= 3)
    calm = mesh_forces(fmu, drive | {"inputs": drive["inputs"] | {"carrier.torque_command": [[0.0, 0.0]]}})
    assert not np.any(calm)


SPOILED = {
    "does not finish": lambda drive, played: {"failure": "fmi2DoStep"},
    "not finite": lambda drive, played: {"not_finite": ["left.speed"]},
    "energy residual": lambda drive, played: changed(played, "solver.energy_residual", lambda v: v + 1.0),
    "held.wheels": lambda drive, played: changed(played, "held.wheels", lambda v: 0.0 * v),
    "moves at": lambda drive, played: changed(played, "left.wheel_speed", lambda v: v + 0.01),
    "creeps by": lambda drive, played: changed(played, "right.wheel_angle", lambda v: v + 1e-3 * played.time),
    "steps at rest": lambda drive, played: changed(played, "solver.rejected", lambda v: v + 2e3 * since_held(drive, played)),
    "impacts": lambda drive, played: changed(played, "solver.steps", lambda v: v + 1e5 * (played.time >= 0.1))}


def changed(played, name, change):
    return {"values": played.values | {name: change(played.values[name])}}


def since_held(drive, played):
    return np.maximum(played.time - drive["holds"][-1]["from"], 0.0)


@pytest.mark.parametrize("requirement", SPOILED)
def test_a_violated_requirement_is_detected(fmu, stop, requirement):
    drive, played = stop
    assert not judge(fmu, drive, played=played).problems
    spoiled = dataclasses.replace(played, **SPOILED[requirement](drive, played))
    problems = judge(fmu, drive, played=spoiled).problems
    assert len(problems) >= 1 and any(requirement in problem for problem in problems), problems


def test_processor_time_counts_where_it_is_measured(fmu, stop):
    drive, played = stop
    assert any("processor time" in problem for problem in judge(fmu, drive | {"step": 0.01}, 100.0, played).problems)
