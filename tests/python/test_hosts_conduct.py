"""Uses of an FMU beyond a single run: several instances, threads, unusual folders. Names of tests are sentences."""

import shutil
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest
from callbacks import silent
from fmpy.fmi2 import FMU2Slave
from instance import Instance

OUTPUTS = ["left.speed", "right.speed", "left.angle", "left.normal_force", "heat.contact", "solver.steps"]
STEP, STEPS = 1.0 / 512.0, 40


class Loaded(Instance):
    """An instance named `name` of the FMU unpacked in `folder`; instances differ by the `load` on both sides."""

    def __init__(self, folder, description, name, load):
        self.slave, self.time = FMU2Slave(guid=description.guid, unzipDirectory=str(folder), instanceName=name,
                                          modelIdentifier=description.coSimulation.modelIdentifier), 0.0
        self.slave.instantiate(callbacks=silent())
        super().__init__(self.slave, description)
        self.set("scene.start", "rolling")
        for side in ("left", "right"):
            self.set(f"{side}.load_torque", load)
        self.initialise(startTime=0.0)

    def step(self):
        self.slave.doStep(self.time, STEP)
        self.time += STEP
        return self.read(OUTPUTS)

    def record(self, steps=STEPS):
        return [self.step() for _ in range(steps)]


@pytest.fixture
def begin(unpacked, description):
    """begin(name, load, folder): an instance."""

    def start(name, load, folder=unpacked):
        return Loaded(folder, description, name, load)

    return start


def alone(begin, load):
    instance = begin("alone", load)
    record = instance.record()
    instance.slave.terminate()
    instance.slave.freeInstance()
    return record


def test_two_instances_step_alternately_and_are_freed_in_any_order(begin):
    expected = [alone(begin, load) for load in (835.0, 400.0)]
    assert expected[0] != expected[1]
    for first_freed in [0, 1]:
        pair = [begin("one", 835.0), begin("other", 400.0)]
        records = [list(steps) for steps in zip(*[[instance.step() for instance in pair] for _ in range(STEPS // 2)])]
        # the other one continues as if it had been alone
        pair[first_freed].slave.terminate()
        pair[first_freed].slave.freeInstance()
        left = 1 - first_freed
        records[left] += pair[left].record(STEPS - STEPS // 2)
        pair[left].slave.freeInstance()
        assert records[left] == expected[left]
        assert records[first_freed] == expected[first_freed][:STEPS // 2]


def test_instances_in_threads_give_the_same_bits_as_alone(begin):
    loads = [835.0, 400.0, -200.0, 100.0]
    expected = [alone(begin, load) for load in loads]
    together = Barrier(len(loads))

    def run(load):
        instance = begin("thread", load)
        together.wait(timeout=60.0)
        record = instance.record()
        instance.slave.freeInstance()
        return record

    with ThreadPoolExecutor(len(loads)) as pool:
        assert list(pool.map(run, loads)) == expected


@pytest.mark.parametrize("name", ["with two spaces", "Größe µ 差速器", "percent %41 # & 'quote'"])
def test_the_folder_it_is_unpacked_to_may_have_any_name(begin, unpacked, tmp_path, name):
    folder = tmp_path / name
    shutil.copytree(unpacked, folder)
    instance = begin(name, 400.0, folder)
    record = instance.record()
    instance.slave.terminate()
    instance.slave.freeInstance()
    assert np.array_equal(record, alone(begin, 400.0))
