"""Host for libraries of other processors, run here without an emulator on this machine's library."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from bevel_differential import DifferentialError

LAB = Path(__file__).parents[2] / "crates" / "lab" / "python"
sys.path.append(str(LAB))
import emulated  # noqa: E402

TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s"}


@pytest.fixture
def far(fmu, tmp_path):
    """Instance behind the host."""
    compiler = shutil.which("cc")
    if compiler is None or not sys.platform.startswith("linux"):
        pytest.skip("the host is for Linux, and a C compiler builds it")
    program = emulated.compiled([compiler], tmp_path)
    library = next(Path(fmu.folder, "binaries", "linux64").glob("*.so"))
    instance = emulated.Emulated(fmu, [program], library)
    yield instance
    instance.close()


def recorded(instance, outputs):
    """Outputs of a short turn with a change of an input of each kind."""
    instance.initialise(TURN | {"effects.wheel_brake": True})
    rows = []
    for step in range(20):
        rows.append(instance.read(outputs))
        if step == 10:
            instance.set({"left.brake_torque": 300.0, "lock.command": 1.0})
        instance.step(1e-3)
    return np.array(rows, dtype=float)


def test_the_host_gives_the_bits_of_this_process_and_takes_every_kind_of_value(far, fmu):
    outputs = [variable.name for variable in fmu.variables.values() if variable.causality == "output"]
    outputs += ["effects.wheel_brake", "geometry.planet_count", "scene.planet_spin"]
    assert {fmu.variable(name).kind for name in outputs} == {"Real", "Boolean", "Integer", "Enumeration"}
    with fmu.open() as near:
        wanted = recorded(near, outputs)
    for _ in range(2):  # the second time after a reset
        assert np.array_equal(recorded(far, outputs).view(np.uint64), wanted.view(np.uint64))
    assert len(np.unique(wanted, axis=0)) == len(wanted)


def test_a_call_refused_by_the_library_is_an_error_with_its_status(far):
    with pytest.raises(DifferentialError) as refused:
        far.raw.setReal([10**6], [1.0])
    assert refused.value.status == 3
    with pytest.raises(DifferentialError):
        far.step(1e-3)
    far.reset()
    far.initialise(TURN).step(1e-3)


def test_a_host_that_cannot_load_the_library_ends_the_script(fmu, tmp_path, far):
    (tmp_path / "none.so").write_bytes(b"no library")
    lost = emulated.Emulated(fmu, far._far.args[:1], tmp_path / "none.so")
    with pytest.raises(SystemExit, match="ended with status 1"):
        lost.initialise(TURN)
    lost.close()
