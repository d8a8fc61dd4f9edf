"""Each command prints each warning of the FMU once, to standard error, and the package raises it as a Python warning."""

import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

from evidence_unit import packed

from bevel_differential import DifferentialWarning, Scene
from bevel_differential.command import COMMANDS, main
from bevel_differential.vehicle import Body, Car, Motor, Tyre

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "design"
# a warning about unusual gears, and one about a value that changes nothing
WIDE, UNFELT = "geometry.face_width: ", "left.brake_torque: 200 N.m changes nothing in this scene. "
# a warning, and the two scenes of the evidence that have it
RIM, THIN = "geometry.planet_bore: the planet's rim", ("bodies_in_detail", "stiffness_bodies")
# gears that differ from the study's but have its stiffness
STIFFNESS = "contact.law: impact has the stiffness of the study's gears"
SCENE = """description = "a turn"
stop_time = 0.02
step = 1e-3
outputs = ["left.speed", "efficiency"]

[set]
carrier.speed_command = 50.0
left.load_torque = 400.0
right.load_torque = 400.0
scene.planet_spin = "imposed"
spin.command = 20.0
geometry.module = "4.3 mm"
geometry.face_width = "21 mm"
left.brake_torque = 200.0
"""
PROBLEM = """description = "gears of a turn"
scene = "scene.toml"
objectives = ["minimise gears.mass", "maximise safety.root_min"]

[set]
effects.strength = true

[vary]
geometry.face_width = "11 mm..12 mm"
"""
CYCLE = "name,count,duration [s],speed [km/h],torque [N.m],wheel_radius [m]\na,1,5,20,900,0.33\n"


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "cycle.csv").write_text(CYCLE, encoding="utf-8")
    return tmp_path


# arguments after the command's name, with {} for the folder; the warnings that are printed once
RUNS = {
    "run": (["{}/scene.toml", "--csv", "{}/a.csv", "--plot", "{}/a.png"], [WIDE, UNFELT, STIFFNESS]),
    "plan": (["{}/scene.toml"], [WIDE, UNFELT, STIFFNESS]),
    "accuracy": (["{}/scene.toml", "--within", "20%", "--want", "left.speed:mean", "--set", "scene.gear_contact=lumped"], [WIDE, UNFELT]),
    "report": (["{}/scene.toml", "--quick", "--out", "{}/report.html"], [WIDE, UNFELT, STIFFNESS]),
    "loads": (["{}/scene.toml", "--out", "{}/loads.csv"], [WIDE, UNFELT, STIFFNESS]),
    "geometry": (["--set", "geometry.face_width=22 mm", "--out", "{}/geometry"], [WIDE]),
    "pattern": (["{}/scene.toml", "--out", "{}/pattern"], [WIDE, UNFELT, STIFFNESS]),
    "sweep": (["--scene", "{}/scene.toml", "--vary", "left.load_torque=300, 400", "--plan", "grid", "--want", "efficiency",
               "--workers", "0"], [WIDE, UNFELT, STIFFNESS]),
    "coupling": (["{}/scene.toml", "--host", "left:k=9000,c=12,J=1"], [WIDE, UNFELT, STIFFNESS]),
    "spectrum": (["{}/cycle.csv", "--set", "geometry.module=4.3 mm", "--set", "geometry.face_width=21 mm"],
                 [WIDE, STIFFNESS]),
    "losses": (["{}/scene.toml", "--torque", "100 N.m, 200 N.m", "--speed", "50 rad/s, 60 rad/s", "--difference", "5 rad/s, 10 rad/s",
                "--temperature", "80 degC, 90 degC", "--bound", "100,1000", "--unseen", "0", "--workers", "0", "--set",
                "scene.gear_contact=lumped"], [WIDE]),
}
# commands that need more than a second; their sweeps, scenes and runs are tested in the package
ELSEWHERE = {"variables", "optimise", "tolerance", "bench", "study", "verify", "examples", "page"}


def test_all_commands_are_covered():
    assert RUNS.keys() | ELSEWHERE == COMMANDS.keys()


@pytest.mark.parametrize("command", RUNS)
def test_a_command_prints_each_warning_once_to_standard_error(command, folder, capsys):
    arguments, expected = RUNS[command]
    assert main([command, *(text.format(folder) for text in arguments)]) == 0
    printed = capsys.readouterr()
    # a list of values that nobody set has more lines
    said = re.findall(r"^warning: .*(?:\n  .*)*", printed.err, re.MULTILINE)
    assert len(set(said)) == len(said), said
    for text in expected:
        assert sum(text in line for line in said) == 1, (text, said)
        assert text not in printed.out
    assert "DifferentialWarning" not in printed.err


def test_a_sweep_passes_on_warnings_of_its_first_run_and_others_with_their_design(folder, fmu_file):
    script = ("import sys; from bevel_differential.command import main; sys.exit(main(['sweep', '--scene', 'scene.toml', '--vary', "
              "'left.brake_torque=0, 100, 200', '--plan', 'grid', '--want', 'efficiency', '--workers', '1', "
              f"'--fmu', {fmu_file!r}]))")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=folder)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count(WIDE) == 1 and WIDE not in done.stdout
    # the first run has no brake torque, and the others have the same warning
    assert len(re.findall(r"^warning: design [12]: left.brake_torque: ", done.stderr, re.MULTILINE)) == 1
    assert done.stderr.count("left.brake_torque: ") == 1
    assert "DifferentialWarning" not in done.stderr


def test_the_package_passes_on_the_same_warnings_about_the_line_that_called_it(folder):
    with Scene.load(folder / "scene.toml") as scene, pytest.warns(DifferentialWarning) as caught:
        scene.run()
        assert [str(one.message) for one in caught] == scene.warnings and len(scene.warnings) >= 3
    assert {one.filename for one in caught} == {__file__}


def test_a_car_passes_on_warnings():
    with pytest.warns(DifferentialWarning, match="geometry.face_width") as caught:
        Car({"scene.gear_contact": "lumped", "geometry.face_width": "22 mm"}, motor=Motor(), left=Tyre(), right=Tyre(), body=Body()).run(
            request=10.0, stop=0.002)
    assert {one.filename for one in caught} == {__file__}


def test_verify_names_the_scenes_of_each_warning_and_prints_it_once(fmu_file, tmp_path, capsys):
    assert main(["verify", packed(fmu_file, tmp_path / "few.fmu", THIN)]) == 0
    printed = capsys.readouterr()
    said = [line for line in printed.err.splitlines() if line.startswith("warning: ")]
    assert len(set(said)) == len(said) and sum(RIM in line and ": 2 scenes: " in line for line in said) == 1, said
    assert RIM not in printed.out


def test_optimise_passes_on_the_warning_of_its_start_and_of_its_first_run(folder, capsys):
    (folder / "problem.toml").write_text(PROBLEM, encoding="utf-8")
    status = main(["optimise", str(folder / "problem.toml"), "--out", str(folder / "out"), "--population", "4", "--generations", "1",
                   "--starts", "1", "--quick", "--workers", "0"])
    printed = capsys.readouterr()
    assert status == 0, printed.err
    said = [line for line in printed.err.splitlines() if line.startswith("warning: ")]
    assert len(set(said)) == len(said) and sum(STIFFNESS in line for line in said) == 1 and STIFFNESS not in printed.out
