"""Paths of libraries for the machine of the package."""

import platform
import sys

import pytest

from bevel_differential import machine


@pytest.fixture
def on(monkeypatch):
    """Makes the package believe that it runs on a certain machine."""
    def pretend(system, processor):
        monkeypatch.setattr(sys, "platform", system)
        monkeypatch.setattr(platform, "machine", lambda: processor)
    return pretend


def test_linux_on_arm_has_its_own_library_where_fmpy_would_take_that_of_another_processor(on, tmp_path):
    folder = tmp_path / "binaries" / "aarch64-linux"
    folder.mkdir(parents=True)
    (folder / "Name.so").touch()
    on("linux", "aarch64")
    assert machine.fmu_library(str(tmp_path), "Name") == str(folder / "Name.so")
    assert machine.fmu_library(str(tmp_path), "Other") is None
    for system, processor in [("linux", "x86_64"), ("darwin", "arm64"), ("win32", "AMD64")]:
        on(system, processor)
        assert machine.fmu_library(str(tmp_path), "Name") is None


@pytest.mark.parametrize("system, processor, file", [
    ("linux", "x86_64", "linux64/libanswers.so"), ("linux", "aarch64", "aarch64-linux/libanswers.so"),
    ("win32", "AMD64", "win64/answers.dll"), ("darwin", "x86_64", "darwin64/libanswers.dylib"),
    ("darwin", "arm64", "darwin64/libanswers.dylib")])
def test_each_machine_has_a_library_of_answers(on, tmp_path, system, processor, file):
    (tmp_path / "aarch64-linux").mkdir()
    on(system, processor)
    assert machine.answers(tmp_path) == (file.split("/")[0], tmp_path / file)


def test_a_library_built_on_an_arm_machine_is_found(on, tmp_path):
    on("linux", "aarch64")
    assert machine.answers(tmp_path) == ("linux64", tmp_path / "linux64" / "libanswers.so")
