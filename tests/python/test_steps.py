"""The trajectory does not depend on the communication steps; a saved state continues with the same bits in another process."""

import json
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
import theory
from driving import TURN

SCENES = {
    "turn": TURN,
    "by torque": {"scene.carrier_drive": "torque", "inertia.left_end": 0.5, "inertia.right_end": 0.8,
                  "left.load_torque": 820.0},
    "with effects": {**TURN, "effects.tooth_friction": True, "effects.half_shaft": True, "inertia.left_end": 0.5,
                     "inertia.right_end": 0.5, **theory.DRAG},
}
OUTPUTS = ["left.speed", "right.speed", "carrier.angle", "planet[1].spin_angle", "left.tangential_force",
           "right.normal_force", "carrier.torque"]
STOP = 0.2


def irregular(seed):
    """Steps from 1e-5 to 1e-1 s in random order, up to the end."""
    random, steps, time = np.random.default_rng(seed), [], 0.0
    while time < STOP - 1e-12:
        steps.append(min(10.0 ** random.uniform(-5, -1), STOP - time))
        time += steps[-1]
    return steps


WAYS = {"1e-1": [0.1] * 2, "1e-2": [0.01] * 20, "1e-3": [0.001] * 200, "1e-4": [1e-4] * 2000, "1e-5": [1e-5] * 20000,
        "a third": [STOP / 7] * 7, "irregular": irregular(1), "irregular again": irregular(2)}


def end(fmu, scene, steps):
    with fmu.open() as opened:
        opened.initialise(SCENES[scene])
        for step in steps:
            # times are summed with rounding errors, as hosts do
            opened.step(step)
        assert opened.time == pytest.approx(STOP, rel=1e-9)
        return np.array(opened.read(OUTPUTS))


@pytest.mark.parametrize("scene", SCENES)
def test_the_trajectory_does_not_depend_on_the_communication_steps(fmu, scene):
    ends = {way: end(fmu, scene, steps) for way, steps in WAYS.items()}
    finest = ends["1e-5"]
    for way, values in ends.items():
        # ten times the solver's tolerance of 1e-6
        np.testing.assert_allclose(values, finest, rtol=1e-5, err_msg=way)


GO_ON = """
import json, pickle, sys
from bevel_differential import Fmu
file, blob, names = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
with Fmu.of(file).open() as opened:
    opened.restore(pickle.load(open(blob, "rb")))
    for step in range(20):
        opened.step(1e-3)
    print(json.dumps([value.hex() for value in opened.read(names)]))
"""


@pytest.mark.parametrize("scene", SCENES)
def test_a_state_continues_with_the_same_bits_in_another_process(fmu, started, outputs, tmp_path, scene):
    def go_on():
        for step in range(20):
            opened.step(1e-3)
        return [value.hex() for value in opened.read(outputs)]

    opened = started(SCENES[scene])
    for step in range(61):
        opened.step(5e-4)
    # in the middle of a contact: teeth carry the load
    assert opened.get("planet[1].left_pairs") >= 1.0 and opened.get("left.normal_force") > 1e4
    state, kept = opened.raw.getFMUstate(), opened.save()
    (tmp_path / "state").write_bytes(pickle.dumps(kept))
    here = go_on()
    # repeated in this instance
    opened.raw.setFMUstate(state)
    opened.time = kept[0]
    assert go_on() == here
    opened.raw.freeFMUstate(state)
    command = [sys.executable, "-c", GO_ON, str(fmu.file), str(tmp_path / "state"), json.dumps(outputs)]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    assert done.returncode == 0, done.stderr
    there = json.loads(done.stdout.strip().splitlines()[-1])
    assert there == here


def test_a_spring_for_each_mesh_rolls_without_kinks_of_tooth_pairs(started):
    opened = started({**TURN, "scene.gear_contact": "lumped", "scene.start": "equilibrium"})
    opened.step(1.0)
    before = opened.get("solver.steps")
    # five teeth per second roll past each mesh, whose force does not change
    opened.step(10.0)
    assert opened.get("solver.steps") - before < 20
