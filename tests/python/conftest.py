"""The packaged FMU for the tests, and two ways to use it: `run` as a user does, `open_fmu` call by call."""

import os
from contextlib import contextmanager

import pytest
from driving import Drive
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu


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
    """run(start_values, stop, step, output): a simulation; enumerations by literal, (value, unit) as fmpy takes it."""

    def simulate(start_values=None, stop=0.5, step=0.001, output=None):
        values = {name: literals[name][value] if name in literals else value
                  for name, value in (start_values or {}).items()}
        return simulate_fmu(unpacked, model_description=description, start_values=values, stop_time=stop,
                            output_interval=step, output=output, logger=lambda *_: None)

    return simulate


class Opened:
    """An instance to be called function by function, with its warnings and errors."""

    def __init__(self, unpacked, description, reference, literals, kind="CoSimulation"):
        self.log = []
        self.description, self.reference, self.literals = description, reference, literals
        self.fmu = instantiate_fmu(unpacked, description, fmi_type=kind, debug_logging=True, logger=self.record)

    def record(self, _environment, _instance, _status, category, message):
        if category != b"logEvents":
            self.log.append(message.decode())

    def set(self, name, value):
        kind = next(v.type for v in self.description.modelVariables if v.name == name)
        if kind == "Enumeration":
            kind, value = "Integer", self.literals[name].get(value, value)
        getattr(self.fmu, "set" + kind)([self.reference[name]], [value])

    def get(self, name):
        return self.fmu.getReal([self.reference[name]])[0]

    def initialise(self, **options):
        self.fmu.setupExperiment(**options)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()


@pytest.fixture
def open_fmu(unpacked, description, reference, literals):
    """A context with an opened instance, freed at its end."""

    @contextmanager
    def opened(kind="CoSimulation"):
        instance = Opened(unpacked, description, reference, literals, kind)
        try:
            yield instance
        finally:
            instance.fmu.freeInstance()

    return opened


@pytest.fixture
def drive(unpacked, description, reference, literals):
    """drive(values): a started scene (see driving.py); all are freed at the end of the test."""
    begun = []

    def start(values=None):
        begun.append(Opened(unpacked, description, reference, literals))
        return Drive(begun[-1], values)

    yield start
    for opened in begun:
        opened.fmu.freeInstance()
