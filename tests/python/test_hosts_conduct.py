"""Uses of an FMU beyond a single run: several instances, unusual folders. Names of tests are sentences."""

import shutil

import numpy as np
import pytest
from bevel_differential import Fmu
from bevel_differential.instance import Instance

OUTPUTS = ["left.speed", "right.speed", "left.angle", "left.normal_force", "heat.contact", "solver.steps"]
STEP, STEPS = 1.0 / 512.0, 40


class Loaded(Instance):
    """Instance of `fmu` named `name`; instances differ by the `load` on both sides."""

    def __init__(self, fmu, name, load):
        super().__init__(fmu, name=name)
        self.initialise({"scene.start": "rolling", "left.load_torque": load, "right.load_torque": load})

    def record(self, steps=STEPS):
        """Outputs after each step."""
        rows = []
        for _ in range(steps):
            self.step(STEP)
            rows.append(self.read(OUTPUTS))
        return rows


def alone(fmu, load):
    with Loaded(fmu, "alone", load) as instance:
        record = instance.record()
        instance.raw.terminate()
        return record


def test_two_instances_step_alternately_and_are_freed_in_any_order(fmu):
    expected = [alone(fmu, load) for load in (835.0, 400.0)]
    assert expected[0] != expected[1]
    for first_freed in [0, 1]:
        pair = [Loaded(fmu, "one", 835.0), Loaded(fmu, "other", 400.0)]
        records = [sum(steps, []) for steps in zip(*[[instance.record(1) for instance in pair] for _ in range(STEPS // 2)])]
        # the other instance continues as in a run without the first one
        pair[first_freed].raw.terminate()
        pair[first_freed].close()
        left = 1 - first_freed
        records[left] += pair[left].record(STEPS - STEPS // 2)
        pair[left].close()
        assert records[left] == expected[left]
        assert records[first_freed] == expected[first_freed][:STEPS // 2]


@pytest.mark.parametrize("name", ["with two spaces", "Größe µ 差速器", "percent %41 # & 'quote'"])
def test_the_folder_of_the_unpacked_fmu_may_have_any_name(fmu, tmp_path, name):
    folder = tmp_path / name
    shutil.copytree(fmu.folder, folder)
    with Loaded(Fmu(folder), name, 400.0) as instance:
        record = instance.record()
        instance.raw.terminate()
    assert np.array_equal(record, alone(fmu, 400.0))
