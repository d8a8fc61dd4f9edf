"""Building the package from its source: messages name what is missing, and a package with its FMU is not changed."""

import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("hatchling")
FILE = Path(__file__).resolve().parents[2] / "python" / "hatch_build.py"


@pytest.fixture
def hook():
    """hook(folder): hook for a package in a folder."""
    spec = importlib.util.spec_from_file_location("hatch_build", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return lambda folder: module.FmuHook(str(folder), {}, None, None, "", "wheel")


def test_without_rust_the_remedy_is_named(hook, tmp_path, monkeypatch):
    (tmp_path / "Cargo.toml").touch()
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SystemExit, match=r"cargo is not on the search path.*https://rustup\.rs"):
        hook(tmp_path / "python").initialize("standard", {})


def test_a_folder_without_the_sources_is_refused(hook, tmp_path):
    with pytest.raises(SystemExit, match="install from a whole checkout"):
        hook(tmp_path / "python").initialize("standard", {})


@pytest.fixture
def complete(tmp_path):
    """Package that contains its FMU."""
    package = tmp_path / "src" / "bevel_differential"
    package.mkdir(parents=True)
    (package / "BevelDifferential.fmu").touch()
    return tmp_path


def test_a_package_with_its_fmu_is_left_unchanged(hook, complete, monkeypatch):
    monkeypatch.delenv("BEVEL_DIFFERENTIAL_WHEEL_PLATFORMS", raising=False)
    found = {}
    hook(complete).initialize("standard", found)
    assert found == {}


@pytest.mark.parametrize("platforms, tag", [
    ("manylinux_2_17_x86_64.win_amd64", "py3-none-manylinux_2_17_x86_64.win_amd64"),
    ("this-machine.win_amd64", "py3-none-some_system_1_2.win_amd64")])
def test_the_wheel_is_named_by_the_platforms_of_its_fmu(hook, complete, monkeypatch, platforms, tag):
    monkeypatch.setattr("sysconfig.get_platform", lambda: "some-system-1.2")
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_WHEEL_PLATFORMS", platforms)
    found = {}
    hook(complete).initialize("standard", found)
    assert found == {"pure_python": False, "tag": tag}
