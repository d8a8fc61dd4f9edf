"""Parameter sets and scripts that the command `plan` writes, against a record by the library itself."""

import csv
import runpy
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import command
from fmpy.ssp.ssd import read_ssv

from bevel_differential.answers import about, ask

ROOT = Path(__file__).parents[2]
SCENES = sorted(path.stem for path in (ROOT / "scenes").glob("*.toml"))
# features that no scene of the repository has: tunable parameters, changes between communication points, two changes at one point,
# inputs from a file, a shorter last step, times with units
EVERYTHING = """
description = "a \\"quoted\\" \\\\ text, and µ"
stop_time = "20.3 ms"
step = "1 ms"
outputs = ["left.speed", "carrier.torque", "left.shaft_torque", "efficiency", "solver.rhs_calls"]

[set]
scene.start = "rolling"
effects.half_shaft = true
effects.tooth_friction = true
geometry.planet_teeth = 10
inertia.left_end = 1.0
right.load_torque = "0.1 N.m"
contact.stiffness = "5.77e5 N/mm^1.5"

[[at]]
time = "3.7 ms"
left.load_torque = 400
contact.damping = "40 N.s/mm"
tooth_friction.coefficient = 0.07

[[at]]
time = 0.01
left.load_torque = 300

[[at]]
time = 0.01
left.load_torque = 350

[[table]]
input = "right.load_torque"
time = [0, "3 ms", 0.0051]
value = [0.1, "700 N.m", 100.3]
period = "7 ms"

[[inputs]]
file = "cycle.csv"
"""
# variants: inputs held within steps, and jumps at ends of periods that are not ends of steps
TEXTS = {"everything": EVERYTHING, "held": f"input_slopes = false{EVERYTHING}", "rounds": EVERYTHING.replace('"7 ms"', '"6.3 ms"')}
# the cycle of an hour only until its tables repeat
SHORTER = {"drive_cycle": {"stop_time": 650.0}}
CYCLE = "time [ms],carrier.speed_command [rpm]\n0,100.1\n2.5,103.3\n4.25,97\n4.25,101\n11.1,90\n"


@pytest.fixture(scope="module")
def scene_command():
    """scene_command(NAME, options of `plan`, csv=FILE): writes the files of the command, and a record by the library itself."""
    def run(name, *arguments, csv=None):
        command(shlex.join(map(str, ("plan", name, *arguments))))
        if csv is None:
            return None
        changes = dict(arguments[i + 1].split("=") for i, word in enumerate(arguments) if word == "--set")
        return ask({"ask": "run", "of": about(name, changes), "out": csv})["text"]

    return run


@pytest.fixture(params=[*SCENES, *TEXTS])
def scene(request, tmp_path):
    """Name of a scene, or its file."""
    text = TEXTS.get(request.param)
    if text is None:
        return request.param
    (tmp_path / "cycle.csv").write_text(CYCLE, encoding="utf-8")
    file = tmp_path / f"{request.param}.toml"
    file.write_text(text, encoding="utf-8")
    return file


def recorded(file):
    """Head and numbers of a record, each number in hexadecimal."""
    lines = Path(file).read_text(encoding="utf-8").splitlines()
    head, *rows = csv.reader(lines)
    return head, [[float(cell).hex() for cell in row] for row in rows]


def run_script(script):
    """Output of a script in a separate process, and the record that it says it wrote."""
    done = subprocess.run([sys.executable, script], cwd=script.parent, capture_output=True, text=True,
                          encoding="utf-8")
    assert done.returncode == 0, done.stdout + done.stderr
    return told_by(script, done.stdout)


def run_script_here(script, monkeypatch, capsys):
    """Output and record of a script that runs in this process, which has loaded the package."""
    monkeypatch.chdir(script.parent)
    capsys.readouterr()
    runpy.run_path(str(script), run_name="__main__")
    return told_by(script, capsys.readouterr().out)


def told_by(script, printed):
    *shown, record = printed.splitlines()
    return "\n".join(shown), script.parent / record.removeprefix("record: ")


def test_a_script_gives_the_bits_of_the_scene(scene_command, scene, tmp_path, monkeypatch, capsys):
    own = tmp_path / "own.csv"
    changes = [part for name, value in SHORTER.get(scene, {}).items() for part in ("--set", f"{name}={value}")]
    printed = scene_command(scene, *changes, "--python", tmp_path / "script.py", csv=own)
    shown, theirs = run_script_here(tmp_path / "script.py", monkeypatch, capsys)
    (own_head, own_rows), (head, rows) = recorded(own), recorded(theirs)
    assert (head, len(rows)) == (own_head, len(own_rows))
    assert len(rows) > 10
    for number, (wanted, row) in enumerate(zip(own_rows, rows)):
        assert row == wanted, f"row {number}"
    # the summaries agree to the printed digits
    for name in head[1:]:
        line = next(line for line in shown.splitlines() if line.startswith(f"{name} "))
        wanted = next(line for line in printed.splitlines() if line.strip().startswith(f"{name} "))
        assert numbers(line) == pytest.approx(numbers(wanted), rel=1e-4, abs=1e-9), name


def numbers(line):
    """The last four words of a line: min, mean, max and end."""
    return [float(word) for word in line.replace("|", " ").split()[-4:]]


def test_a_script_and_a_record_follow_changes_of_the_scene(scene_command, tmp_path):
    changes = ["--set", "stop_time=20.5 ms", "--set", "step=0.3ms", "--set", "left.load_torque=600 N.m",
               "--set", "scene.start=equilibrium"]
    own = tmp_path / "own.csv"
    scene_command("one_wheel_on_ice", *changes, "--python", tmp_path / "script.py", csv=own)
    _, theirs = run_script(tmp_path / "script.py")
    assert recorded(theirs) == recorded(own)
    assert len(recorded(own)[1]) == 70 and float.fromhex(recorded(own)[1][-1][0]) == 0.0205


def test_a_parameter_set_is_valid_and_starts_the_scene(scene_command, scene, fmu, tmp_path):
    file, record = tmp_path / "set.ssv", tmp_path / "own.csv"
    scene_command(scene, "--ssv", file, "--set", "stop_time=1e-4", "--set", "step=1e-4", csv=record)
    # validated by fmpy's schema of SSP 1.0
    parameters = read_ssv(str(file), validate=True).parameters
    names = [parameter.name for parameter in parameters]
    assert len(names) == len(set(names))
    with fmu.open() as instance:
        variables = fmu.variables
        assert {name for name, variable in variables.items() if variable.causality == "input"} <= set(names)
        for parameter in parameters:
            variable = variables[parameter.name]
            assert parameter.type == variable.kind, parameter.name
            if parameter.unit is not None:
                assert parameter.unit == variable.unit, parameter.name
        instance.initialise({parameter.name: parameter.value for parameter in parameters})
        (_, *outputs), rows = recorded(record)
        started = [value.hex() for value in instance.read(outputs)]
        assert started == rows[0][1:]


def test_parameter_sets_hold_the_bits_that_were_set_and_define_their_units(scene_command, tmp_path):
    file = tmp_path / "set.ssv"
    values = {"left.load_torque": "0.30000000000000004", "right.load_torque": "-1e-300", "inertia.left_end": "1.7e-9"}
    scene_command("one_wheel_on_ice", *(part for item in values.items() for part in ("--set", "=".join(item))),
                  "--ssv", file)
    parameters = {parameter.name: parameter for parameter in read_ssv(str(file)).parameters}
    for name, value in values.items():
        assert float(parameters[name].value).hex() == float(value).hex()
    assert parameters["left.load_torque"].unit == "N.m" and parameters["scene.start"].value == "rolling"
    text = file.read_text(encoding="utf-8")
    for unit in {parameter.unit for parameter in parameters.values()} - {None}:
        assert f'<ssc:Unit name="{unit}">' in text
