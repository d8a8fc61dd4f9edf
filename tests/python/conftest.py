"""Fixtures for the packaged FMU: `run` a scene, `drive` it from step to step, `fmu.open` it for single calls."""

import json
import os
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu

FOLDERS = [str(Path(__file__).resolve().parents[2] / folder) for folder in ("python/src", "fmu-build/python")]
sys.path[:0] = FOLDERS
# for processes started by tests; all scenes and commands use the FMU of the environment variable FMU
os.environ["PYTHONPATH"] = os.pathsep.join(FOLDERS)
os.environ["BEVEL_DIFFERENTIAL_FMU"] = os.path.abspath(os.environ.get("FMU", ""))

from bevel_differential import Differential, Fmu, style  # noqa: E402
from driving import Drive  # noqa: E402
from duty_cycles import spectrum_of  # noqa: E402
from evidence_unit import packed  # noqa: E402
from fmi3 import Unit3  # noqa: E402


def pytest_addoption(parser):
    parser.addoption("--scenes", type=int, default=int(os.environ.get("SCENES", "200")),
                     help="number of random scenes (or by the environment variable SCENES)")


def pytest_configure(config):
    # tests of warnings catch them; other tests would list thousands
    config.addinivalue_line("filterwarnings", "ignore::bevel_differential.values.DifferentialWarning")


@pytest.fixture(scope="session", autouse=True)
def fmu_file():
    """Path of the .fmu file, from the environment variable FMU."""
    path = os.environ["BEVEL_DIFFERENTIAL_FMU"]
    if not os.path.isfile(path):
        pytest.exit("FMU does not name the packaged .fmu; use: python3 crates/lab/lab.py test-python", returncode=2)
    return path


@pytest.fixture(scope="session")
def fmu(fmu_file):
    """Extracted FMU with its variables; `fmu.open()` is an instance."""
    return Fmu.of(fmu_file)


@pytest.fixture
def opened(fmu):
    """Instance for single calls, not yet initialised."""
    with fmu.open() as instance:
        yield instance


@pytest.fixture(scope="session")
def outputs(fmu):
    """Names of all outputs that are real numbers."""
    return [variable.name for variable in fmu.variables.values() if variable.causality == "output" and variable.kind == "Real"]


@pytest.fixture(scope="session")
def fmu3(fmu_file):
    """Path of the unit for FMI 3.0, which is in the same folder as that for FMI 2.0."""
    return Path(fmu_file).with_name("BevelDifferential3.fmu")


@pytest.fixture
def exchange(fmu3):
    """exchange(values): instance for model exchange in event mode, after its first update."""
    units = []

    def make(values):
        unit = Unit3(fmu3, "ModelExchange")
        units.append(unit)
        unit.initialise(values)
        unit.update()
        return unit

    yield make
    for unit in units:
        unit.raw.freeInstance()


@pytest.fixture(scope="session")
def plain_outputs(fmu3):
    """Names of the continuous outputs of FMI 3.0 with one real number each."""
    with Unit3(fmu3) as unit:
        return [name for name, variable in unit.variables.items() if variable.causality == "output"
                and variable.type == "Float64" and not variable.dimensions and not name.startswith("event.")]


@pytest.fixture(scope="session")
def description(fmu_file):
    """Model description, validated by fmpy."""
    return read_model_description(fmu_file, validate=True)


@pytest.fixture(scope="session")
def run(fmu_file, outputs):
    """run(start_values, stop, step, output, inputs): record of a simulation, by default of all outputs."""

    def simulate(start_values=None, stop=0.5, step=0.001, output=None, inputs=None):
        with Differential(start_values, fmu=fmu_file) as differential:
            return differential.run(inputs, output or outputs, stop, step)

    return simulate


@pytest.fixture(scope="session")
def through_fmpy(fmu):
    """through_fmpy(values, stop, **options): record of fmpy's own loop; `options` are those of simulate_fmu."""

    def simulate(values=None, stop=0.1, logger=lambda *_: None, **options):
        numbers = {variable.name: number for variable, number in fmu.numbers(values)}
        return simulate_fmu(fmu.folder, model_description=fmu.description, start_values=numbers, stop_time=stop,
                            logger=logger, **{"output_interval": 0.001, **options})

    return simulate


@pytest.fixture
def drive(fmu):
    """drive(values): started scene (see driving.py). All scenes are freed at the end of the test."""
    with ExitStack() as begun:
        yield lambda values=None: begun.enter_context(Drive(fmu, values))


@pytest.fixture
def cycle(fmu_file, tmp_path):
    """cycle(lines, ...): the spectrum of a duty cycle with these lines."""
    return lambda *lines, **options: spectrum_of(lines, tmp_path, fmu_file, **options)


@pytest.fixture
def started(fmu):
    """started(values): instance that is initialised, freed at the end of the test."""
    with ExitStack() as begun:
        yield lambda *scene: begun.enter_context(fmu.open()).initialise(*scene)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Temporary folder, which is the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def scene_file(tmp_path):
    """scene_file(values, name, stop, outputs, more): scene file with these values; `more`: further lines above them."""
    def write(values=None, name="scene", stop=0.01, outputs=("left.speed",), more=""):
        text = {"description": name, "stop_time": stop, "step": "1 ms", "outputs": [*outputs]}
        tables = ["\n".join(f"{key} = {json.dumps(value)}" for key, value in each.items()) for each in (text, values or {})]
        file = tmp_path / f"{name}.toml"
        file.write_text(f"{tables[0]}\n{more}\n[set]\n{tables[1]}\n", encoding="utf-8")
        return file

    return write


@pytest.fixture
def figures(monkeypatch):
    """Figures that are saved, in their order."""
    saved = []
    monkeypatch.setattr(style, "save", lambda figure, file, shaded=False: saved.append(figure))
    return saved


@pytest.fixture(scope="session")
def units(fmu_file, tmp_path_factory):
    """Folder of FMUs with the evidence of one scene: good.fmu agrees with it, bad.fmu does not."""
    folder = tmp_path_factory.mktemp("units")
    for name, changes in (("good", {}), ("bad", {"results/one_wheel_on_ice.csv": lambda text: text.replace("\n0,", "\n0,1", 1)})):
        packed(fmu_file, folder / f"{name}.fmu", ["one_wheel_on_ice"], changes)
    return folder
