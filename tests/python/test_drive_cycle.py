"""The drive cycle: an hour at 10 Hz, and its first minute with lumped teeth against tooth pairs."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import Scene

ROOT = Path(__file__).parents[2]
HEATS = ["heat.clutch", "heat.thrust", "heat.drag"]
# the resultant of lumped teeth and that of the law `line` act at the same radius, that of `impact` acts at another radius
TEETH = {"scene.gear_contact": "tooth", "contact.law": "line"}
# an attempt at a step takes some 8 us; 1 000 times real time leaves 100 us between two points at 10 Hz
MOST_ATTEMPTS = 12


@pytest.fixture(scope="module")
def hour():
    with Scene.load("drive_cycle") as scene:
        outputs = [*scene.outputs, "warm_up.stored", "warm_up.given_off", "heat.contact", "solver.steps", "solver.rejected"]
        return scene.run(outputs)


def test_the_inputs_are_those_that_the_script_writes(tmp_path, monkeypatch):
    specification = importlib.util.spec_from_file_location("course", ROOT / "docs" / "scripts" / "drive_cycle.py")
    course = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(course)
    kept = course.FILE.read_bytes()
    monkeypatch.setattr(course, "FILE", tmp_path / "drive_cycle.csv")
    course.main()
    assert course.FILE.read_bytes() == kept


def test_an_hour_has_stops_and_turns_both_ways_and_warms_up(hour):
    assert len(hour) == 36001 and hour["time"][-1] == 3600.0
    carrier, difference = hour["carrier.speed"], hour["right.speed"] - hour["left.speed"]
    stands = np.abs(carrier) < 1e-6
    # six rounds with a start at rest and five stops, the last one at the end
    assert np.count_nonzero(np.diff(stands.astype(int)) == 1) == 6 * 5
    assert difference.max() > 2.0 and difference.min() < -2.0
    # except where teeth cross the backlash
    assert np.median(np.abs(carrier - (hour["left.speed"] + hour["right.speed"]) / 2.0)) < 1e-3
    for node in ["oil", "gears", "clutch", "washers", "case"]:
        temperature = hour[f"temperature.{node}"]
        assert temperature[0] == 293.15 and temperature.min() > 293.0 and 300.0 < temperature[-1] < 353.0
    entered = sum(hour[name][-1] for name in [*HEATS, "heat.contact"])
    assert hour["warm_up.stored"][-1] + hour["warm_up.given_off"][-1] == pytest.approx(entered, rel=1e-6)


def test_an_hour_takes_few_steps(hour):
    attempts = hour["solver.steps"][-1] + hour["solver.rejected"][-1]
    assert attempts < MOST_ATTEMPTS * (len(hour) - 1)


def test_in_the_first_minute_pairs_of_teeth_give_the_heats_of_lumped_ones():
    with Scene.load("drive_cycle") as scene:
        lumped, teeth = scene.run(HEATS, stop="60 s"), scene.run(HEATS, TEETH, stop="60 s")
    for name in HEATS:
        assert lumped[name][-1] > 40.0
        assert teeth[name][-1] == pytest.approx(lumped[name][-1], rel=0.02), name
