"""Warnings of the FMU in the package and in sweeps: each once, with its origin. test_every_command.py has those of all commands."""

import re
import subprocess
import sys
import warnings

import pytest
from command_line import command
from command_list import WARNED, WIDE
from evidence_unit import packed

from bevel_differential import Differential, DifferentialWarning, Scene

# a warning, and the two scenes of the evidence that have it
RIM, THIN = "geometry.planet_bore: the planet's rim", ("bodies_in_detail", "stiffness_bodies")


def test_a_sweep_passes_on_warnings_of_its_first_run_and_others_with_their_design(tmp_path):
    (tmp_path / "scene.toml").write_text(WARNED, encoding="utf-8")
    line = "sweep --scene scene.toml --vary left.brake_torque=0,100,200 --plan grid --want efficiency --workers 1"
    done = subprocess.run([sys.executable, "-m", "bevel_differential", *line.split()], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count(WIDE) == 1 and WIDE not in done.stdout
    # the first run has no brake torque, and the others have the same warning
    assert len(re.findall(r"^warning: design [12]: left.brake_torque: ", done.stderr, re.MULTILINE)) == 1
    assert done.stderr.count("left.brake_torque: ") == 1
    assert "DifferentialWarning" not in done.stderr


@pytest.mark.parametrize("kind", [Differential, lambda values: Scene("a turn", outputs=["left.speed"], set=values)], ids=["instance", "scene"])
def test_python_warns_about_the_line_that_called_it_and_keeps_what_was_said(kind):
    with kind({"left.brake_torque": "200 N.m"}) as used:
        with pytest.warns(DifferentialWarning, match="left.brake_torque: 200 N.m.*effects.wheel_brake = true") as caught:
            used.run(stop=0.002)
        assert {one.filename for one in caught} == {__file__}
        assert [str(one.message) for one in caught] == used.warnings and list(used.unfelt) == ["left.brake_torque"]
        with warnings.catch_warnings():
            warnings.filterwarnings("error", ".*changes nothing")
            used.run(stop=0.002, values={"left.brake_torque": 0.0, "geometry.face_width": 0.014, "contact.law": "line"})


def test_verify_names_the_scenes_of_each_warning_and_prints_it_once(fmu_file, tmp_path):
    printed = command(f"verify {packed(fmu_file, tmp_path / 'few.fmu', THIN)}")
    assert len(set(printed.warnings)) == len(printed.warnings) and RIM not in printed.out
    assert sum(RIM in text and ": 2 scenes: " in text for text in printed.warnings) == 1, printed.warnings
