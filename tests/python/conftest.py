"""The packaged FMU for the tests, and two ways to use it: `run` as a user does, `open_fmu` call by call."""

import os
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu

for folder in ("fmu-build/python", "python/src"):
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / folder))
from driving import Drive  # noqa: E402
from instance import Instance  # noqa: E402


def pytest_addoption(parser):
    parser.addoption("--scenes", type=int, default=int(os.environ.get("SCENES", "200")),
                     help="how many random scenes (or by the environment variable SCENES)")


@pytest.fixture(scope="session")
def fmu_file():
    """Path of the .fmu, from the environment variable FMU."""
    path = os.environ.get("FMU", "")
    if not os.path.isfile(path):
        pytest.exit("FMU does not name the packaged .fmu; use: cargo run --release -- test-python", returncode=2)
    return path


@pytest.fixture(scope="session")
def description(fmu_file):
    return read_model_description(fmu_file, validate=True)


@pytest.fixture(scope="session")
def unpacked(fmu_file, tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmu")
    extract(fmu_file, str(folder))
    return str(folder)


@pytest.fixture(scope="session")
def reference(description):
    """Value reference by name."""
    return {variable.name: variable.valueReference for variable in description.modelVariables}


@pytest.fixture(scope="session")
def literals(description):
    """Value of a literal by the name of the variable and the literal."""
    return {variable.name: {item.name: int(item.value) for item in variable.declaredType.items}
            for variable in description.modelVariables if variable.type == "Enumeration"}


@pytest.fixture(scope="session")
def run(unpacked, description, literals):
    """run(start_values, stop, step, output): a simulation; enumerations by literal or number, (value, unit) as fmpy takes it."""

    def simulate(start_values=None, stop=0.5, step=0.001, output=None):
        values = {name: literals[name].get(value, value) if name in literals else value
                  for name, value in (start_values or {}).items()}
        return simulate_fmu(unpacked, model_description=description, start_values=values, stop_time=stop,
                            output_interval=step, output=output, logger=lambda *_: None)

    return simulate


class Opened(Instance):
    """An instance to be called function by function, with its warnings and errors."""

    def __init__(self, unpacked, description, kind="CoSimulation"):
        self.log = []
        opened = instantiate_fmu(unpacked, description, fmi_type=kind, debug_logging=True, logger=self.record)
        super().__init__(opened, description)

    def record(self, _environment, _instance, _status, category, message):
        if category != b"logEvents":
            self.log.append(message.decode())


@pytest.fixture
def open_fmu(unpacked, description):
    """A context with an opened instance, freed at its end."""

    @contextmanager
    def opened(kind="CoSimulation"):
        instance = Opened(unpacked, description, kind)
        try:
            yield instance
        finally:
            instance.fmu.freeInstance()

    return opened


@pytest.fixture
def drive(unpacked, description):
    """drive(values): a started scene (see driving.py); all are freed at the end of the test."""
    begun = []

    def start(values=None):
        begun.append(Opened(unpacked, description))
        return Drive(begun[-1], values)

    yield start
    for opened in begun:
        opened.fmu.freeInstance()
