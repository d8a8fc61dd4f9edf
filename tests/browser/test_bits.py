"""Chromium, node and the native FMU give identical bits: results are compared without rounding or tolerance."""

import numpy as np
import pytest
from bevel_differential import Scene

from live import address_of
from node_runs import run_in_node

SCENES = ["study_straight", "study_turning", "torque_bias", "clunk"]
# the page records the first outputs for its picture, and the last three because traces show them
OUTPUTS = ["left.angle", "left.speed", "right.speed", "carrier.speed", "planet[1].spin_angle", "planet[1].left_normal_force",
           "solver.energy_residual", "left.shaft_torque", "right.shaft_torque", "left.normal_force"]


def bits(numbers):
    return np.ascontiguousarray(numbers, np.float64).view(np.uint64)


@pytest.fixture(scope="module")
def in_chromium(shared):
    """{scene: ({output: bits}, scene as the page sends it to its worker)}."""
    records = {}
    for name in SCENES:
        answer = shared.go(address_of({"scene": name, "show": " ".join(OUTPUTS[-3:])}))
        assert "over" in answer, f"{name}: {answer}"
        record = shared.record(OUTPUTS)
        records[name] = {output: bits(record[output]) for output in ["time", *OUTPUTS]}, shared.ask("ear.asked.scene")
    return records


@pytest.fixture(scope="module")
def in_node(in_chromium, fmu, page_file, tmp_path_factory):
    """{scene: {output: bits}}."""
    references = [fmu.variable(output).reference for output in OUTPUTS]
    scenes = {name: {"scene": scene, "references": references} for name, (_, scene) in in_chromium.items()}
    columns = run_in_node(page_file, tmp_path_factory.mktemp("node"), scenes)
    return {name: dict(zip(["time", *OUTPUTS], columns[name])) for name in SCENES}


@pytest.mark.parametrize("scene", SCENES)
def test_chromium_node_and_the_native_fmu_give_the_same_bits(scene, in_chromium, in_node, fmu, found):
    record = Scene.load(scene).run(OUTPUTS)
    native = {name: bits(record[name]) for name in ["time", *OUTPUTS]}
    chromium, node = in_chromium[scene][0], in_node[scene]
    for name, numbers in native.items():
        for where, other in (("Chromium", chromium[name]), ("node", node[name])):
            assert other.shape == numbers.shape, f"{name} in {where}"
            different = np.flatnonzero(other != numbers)
            assert different.size == 0, f"{name} in {where}: {different.size} of {numbers.size} differ, from {different[:1]}"
    # constant values would prove little
    moving = sum(np.unique(numbers).size > 1 for numbers in native.values())
    assert moving > len(OUTPUTS) / 2
    found(f"{scene} {len(record)} × {len(OUTPUTS)}")
