"""Dog clutches in results: their lash at the port, the bench that closes them, the sentences of a report, and the shipped scene."""

import re

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.bench import bench
from bevel_differential.lash import lash_by_source
from bevel_differential.losses.point import benched
from bevel_differential.report import dogs
from bevel_differential.report.axle import natural_frequencies
from bevel_differential.report.head import verdicts
from bevel_differential.report.simulated import Simulated

LASH = 0.04
CAR = {"effects.disconnect": True, "disconnect.lash": LASH, "effects.half_shaft": True, "inertia.left_end": 2.0, "inertia.right_end": 2.0}
# the right wheel has its load, until its half-shaft is open and nothing acts on it
COASTS = CAR | {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "carrier.torque_command": 0.0, "carrier.speed_command": 40.0,
                "left.load_torque": 0.0, "right.load_torque": 0.0}


@pytest.mark.parametrize("sides, count", [("right", 1), ("both", 2)])
def test_the_play_at_the_port_contains_half_of_the_lash_of_each_dog_clutch(fmu_file, tmp_path, sides, count):
    """With held wheels, the carrier turns by half of the angle of one side gear. A command to open does not matter on the bench."""
    values = CAR | {"disconnect.sides": sides, "right.dog_command": 0.0}
    plain, with_dogs = (float(re.findall(r"\d+\.\d+", bench("lash", tmp_path, values=more, fmu=fmu_file))[0]) for more in ({}, values))
    with Scene(set=CAR | {"effects.final_drive": True, "disconnect.sides": sides}, fmu=fmu_file) as scene:
        ratio = scene.value("final_drive.ring_teeth") / scene.value("final_drive.pinion_teeth")
        sources = [one for one in lash_by_source(scene.value, False) if "dog" in one.source]
    expected = np.degrees(0.5 * ratio * LASH)
    assert [np.degrees(one.angle) for one in sources] == pytest.approx([expected] * count)
    # five decimals are printed
    assert with_dogs - plain == pytest.approx(count * expected, abs=2e-5)


def test_an_open_dog_clutch_has_no_lash(fmu_file):
    with Scene(set=CAR | {"disconnect.sides": "both", "left.dog_command": 0.0}, fmu=fmu_file) as scene:
        assert [one.source for one in lash_by_source(scene.value, False)][1:] == ["right dog clutch"]


def test_the_bench_leaves_dog_clutches_out_and_warns_if_they_are_open(fmu_file, recwarn):
    table = ("left.dog_command", [0.0, 0.1], [1.0, 0.0], None)
    with Scene(set=CAR | {"right.dog_command": 0.0}, tables=[table], fmu=fmu_file) as scene:
        on_bench = benched(scene)
    with Scene(set={name: value for name, value in CAR.items() if "disconnect" not in name}, fmu=fmu_file) as plain:
        assert on_bench.values == benched(plain).values
    assert [str(each.message).split()[0] for each in recwarn] == ["left.dog_command", "right.dog_command"]


def test_the_report_says_when_a_dog_clutch_is_open_and_gives_no_bias_then(fmu_file):
    table = ("right.dog_command", [0.0, 0.25, 0.25, 1.0], [1.0, 1.0, 0.0, 0.0], None)
    with Scene(set=COASTS, stop=1.0, outputs=["right.dog_phase"], tables=[table], accept_start_values=True, fmu=fmu_file) as scene:
        run = Simulated.of(scene)
    assert dogs.phases(run) == "The right dog clutch is open 75 % of the time and is closed 25 % of the time."
    # the clutch opens in the step after its command
    assert np.array_equal(dogs.connected(run), run.time <= 0.25)
    assert dogs.phases(run) in verdicts(run)[-1].text
    assert "The right half-shaft has no stiffness here" in natural_frequencies(run)[-1].text
    with Scene(set=COASTS | {"right.dog_command": 0.0, "carrier.torque_command": 100.0, "left.load_torque": 20.0}, stop=0.05,
               outputs=["right.dog_phase"], accept_start_values=True, fmu=fmu_file) as scene:
        assert "no bias ratio, because a dog clutch is never closed" in verdicts(Simulated.of(scene))[-1].text


def test_the_shipped_scene_passes_through_all_phases_and_ends_closed(fmu_file):
    with Scene.load("disconnect", fmu=fmu_file) as scene:
        record = scene.run(["right.dog_phase", "right.speed", "right.wheel_speed", "right.shaft_torque", "heat.disconnect",
                            "solver.energy_residual"])
    rows = np.flatnonzero(np.diff(record["right.dog_phase"], prepend=-1.0))
    _, stuck, opened, unequal, gap, again = rows
    # closed, waits for low torque, open, waits for equal speeds, waits for a gap, closed
    assert record["right.dog_phase"][rows].tolist() == [3, 4, 0, 1, 2, 3]
    # each phase lasts long enough to be seen
    assert np.diff(record["time"][rows], append=record["time"][-1]).min() > 0.02
    torque, difference = record["right.shaft_torque"], record["right.wheel_speed"] - record["right.speed"]
    assert torque[stuck] == pytest.approx(200.0, rel=1e-6) and torque[opened] == 0.0
    assert difference[unequal] > 20.0 and 0.0 < difference[gap] <= 5.0
    # the closed clutch transmits torque again, and produces no more heat
    assert torque[again:].max() > 100.0
    assert record["heat.disconnect"][again] == record["heat.disconnect"][-1] > 1.0
    assert np.abs(record["solver.energy_residual"]).max() < 1e-5
