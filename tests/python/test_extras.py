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

from bevel_differential import extras
from bevel_differential.command import COMMANDS

PYTHON = Path(__file__).resolve().parents[2] / "python"
# modules of the packages in the extras; Jinja2 and lxml come with fmpy, numpy and tqdm are always installed
MODULES = {"matplotlib": "matplotlib", "dask": "dask", "distributed": "distributed", "pandas": "pandas", "pyarrow": "pyarrow", "scipy": "scipy",
           "cadquery-ocp-novtk": "OCP", "ezdxf": "ezdxf", "networkx": "networkx", "trimesh": "trimesh", "pymoo": "pymoo", "rainflow": "rainflow",
           "SALib": "SALib"}
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


def without(*words, folder=None):
    """Runs the command in a Python without optional packages."""
    environment = {**os.environ, "PYTHONPATH": str(PYTHON / "src")}
    return subprocess.run([sys.executable, "-c", WITHOUT, ",".join([*MODULES.values(), "PIL"]), *words], env=environment, cwd=folder,
                          capture_output=True, text=True, timeout=120)


def test_the_modules_are_those_of_all_extras():
    project = tomllib.loads((PYTHON / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = {re.split(r"[\\[>=]", each)[0] for extra in project["optional-dependencies"].values() for each in extra}
    assert named == {*MODULES, "bevel-differential", "Jinja2", "lxml", "tqdm"}


@pytest.mark.parametrize("name", [*COMMANDS, "--help"])
def test_help_of_every_command_works_in_the_smallest_installation(name):
    done = without(*dict.fromkeys([name, "--help"]))
    assert done.returncode == 0 and "usage: bevel-differential" in done.stdout and not done.stderr, done.stderr


def test_a_plan_and_a_run_work_in_the_smallest_installation(fmu_file):
    done = without("run", "study_turning", "--stop", "1 ms", "--fmu", fmu_file)
    assert done.returncode == 0 and "left.speed" in done.stdout, done.stderr


@pytest.mark.parametrize("words, extra", [
    (["sweep", "--scene", "study_turning", "--vary", "left.load_torque=1, 2", "--plan", "grid", "--want", "left.speed", "--workers", "0"], "sweep"),
    (["losses", "torque_bias", "--workers", "0"], "sweep"), (["run", "study_turning", "--stop", "1 ms", "--plot", "a.png"], "plot"),
    (["report", "study_turning"], "report"), (["geometry", "--step"], "cad"), (["bench"], "plot")])
def test_a_command_without_its_packages_names_what_installs_them(words, extra, fmu_file, tmp_path):
    done = without(*words, *([] if words[0] == "geometry" else ["--fmu", fmu_file]), folder=tmp_path)
    last = done.stderr.splitlines()[-1]
    assert done.returncode == 1 and re.search(rf'is missing; .*pip install "{re.escape(str(PYTHON))}\[{extra}\]"$', last), done.stderr


@pytest.mark.parametrize("words", [["run", "study_turning", "--plot", "a.png"], ["run", "study_turning", "--csv", "a.parquet"],
                                   ["spectrum", "no.csv"]])
def test_missing_packages_are_found_before_the_work(words, fmu_file, tmp_path):
    done = without(*words, "--fmu", fmu_file, folder=tmp_path)
    assert done.returncode == 1 and "is missing; install" in done.stderr and not done.stdout and "warning" not in done.stderr


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
