"""The smallest installation: help without optional packages, and hints on how to install them."""

import json
import os
import re
import subprocess
import sys
import tomllib
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from types import SimpleNamespace

import pytest
from command_line import without_warnings
from refusals import refused

from bevel_differential import Differential, extras
from bevel_differential.command import COMMANDS, FAILED

PYTHON = Path(__file__).resolve().parents[2] / "python"
# modules of the packages in the extras; Jinja2 and lxml come with fmpy, numpy and tqdm are always installed
MODULES = {"matplotlib": "matplotlib", "dask": "dask", "distributed": "distributed", "pandas": "pandas", "pyarrow": "pyarrow", "scipy": "scipy",
           "cadquery-ocp-novtk": "OCP", "ezdxf": "ezdxf", "networkx": "networkx", "trimesh": "trimesh", "pymoo": "pymoo", "rainflow": "rainflow",
           "SALib": "SALib"}
SWEEP = "--scene study_turning --vary left.load_torque=1,2 --plan grid --want left.speed --workers 0"
WITHOUT = """
import sys
missing = set(sys.argv[1].split(","))
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in missing:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Missing())
from bevel_differential.command import main
sys.exit(main(sys.argv[2:]))
"""


@pytest.fixture
def without(tmp_path):
    """without(line): a command in a Python without optional packages, whose output has only letters of ASCII."""
    def run(line):
        environment = {**os.environ, "PYTHONPATH": str(PYTHON / "src"), "PYTHONIOENCODING": "ascii"}
        return subprocess.run([sys.executable, "-c", WITHOUT, ",".join([*MODULES.values(), "PIL"]), *line.split()], env=environment, cwd=tmp_path,
                              capture_output=True, text=True, timeout=120)

    return run


def test_the_modules_are_those_of_all_extras():
    project = tomllib.loads((PYTHON / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = {re.split(r"[\\[>=]", each)[0] for extra in project["optional-dependencies"].values() for each in extra}
    assert named == {*MODULES, "bevel-differential", "Jinja2", "lxml", "tqdm"}


@pytest.mark.parametrize("line, shown", [
    *((f"{name} --help", "usage: bevel-differential") for name in COMMANDS), ("--help", "usage: bevel-differential"),
    ("run study_turning --stop 1ms", "left.speed"), ("variables planet_count --acting study_straight", "geometry.planet_count")])
def test_the_smallest_installation_is_enough(line, shown, without):
    done = without(line)
    assert done.returncode == 0 and shown in done.stdout and not without_warnings(done.stderr), done.stderr


@pytest.mark.parametrize("line, extra", [
    (f"sweep {SWEEP}", "sweep"), ("losses torque_bias --workers 0", "sweep"), ("losses torque_bias --report a.html", "report"),
    ("run study_turning --stop 1ms --plot a.png", "plot"), ("run study_turning --csv a.parquet", "sweep"), ("spectrum no.csv", "design"),
    ("report study_turning", "report"), ("geometry --step", "cad"), ("bench", "plot")])
def test_missing_packages_are_found_before_the_work_with_what_installs_them(line, extra, without):
    done = without(line)
    [last] = done.stderr.splitlines()
    assert done.returncode == FAILED and re.search(rf'is missing; .*pip install "{re.escape(str(PYTHON))}\[{extra}\]"$', last), done.stderr
    assert not done.stdout


def test_a_table_of_pandas_needs_its_extra(monkeypatch):
    def missing(name):
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr(extras.importlib, "import_module", missing)
    with Differential() as straight, refused("pandas … extra sweep"):
        straight.run(stop=0.01, frame=True)


@pytest.mark.parametrize("folder, written", [(".", "./python"), ("docs", "../python"), ("docs/figures", "../../python")])
def test_in_a_clone_the_hint_is_a_path_from_the_current_folder(folder, written, monkeypatch):
    monkeypatch.chdir(PYTHON.parent / folder)
    assert extras.install("dask.array", "sweep").endswith(f'pip install "{written}[sweep]"')
    assert (Path(written) / "pyproject.toml").is_file()


def installed(monkeypatch, tmp_path, about):
    """Pretends that the package is installed elsewhere, with the source `about`."""
    text = None if about is None else json.dumps(about)
    monkeypatch.setattr(extras, "__file__", str(tmp_path / "lib" / "site-packages" / "bevel_differential" / "extras.py"))
    monkeypatch.setattr(extras.importlib, "metadata", SimpleNamespace(
        distribution=lambda name: SimpleNamespace(read_text=lambda file: text), PackageNotFoundError=PackageNotFoundError))


@pytest.mark.parametrize("about", [None, {"url": "file:///tmp/a.whl", "archive_info": {}},
                                   {"url": "file:///nowhere/python", "dir_info": {}}])
def test_from_a_wheel_the_hint_is_the_name_of_the_installed_package(about, monkeypatch, tmp_path):
    installed(monkeypatch, tmp_path, about)
    assert extras.install("dask", "sweep").endswith('pip install "bevel-differential[sweep]"')


def test_from_a_clone_by_pip_the_hint_is_the_folder_again(monkeypatch, tmp_path):
    installed(monkeypatch, tmp_path, {"url": PYTHON.as_uri(), "dir_info": {}})
    monkeypatch.chdir(PYTHON.parent)
    assert extras.install("dask", "sweep").endswith('pip install "./python[sweep]"')


def test_the_hint_has_the_pip_of_this_interpreter(monkeypatch, tmp_path):
    own = tmp_path / "bin"
    own.mkdir()
    for name in ("python", "pip"):
        (own / name).touch(mode=0o755)
    monkeypatch.setattr(sys, "executable", str(own / "python"))
    monkeypatch.setenv("PATH", str(own))
    assert ": pip install " in extras.install("dask", "sweep")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert f": {own}/python -m pip install " in extras.install("dask", "sweep")
    monkeypatch.chdir(tmp_path)
    assert ": bin/python -m pip install " in extras.install("dask", "sweep")
