"""Inputs are recorded like outputs: in records, files and figures of all commands, with the values that act."""

import csv

import numpy as np
import pytest
from command_line import command
from bevel_differential import Differential, Scene, compare
from bevel_differential.answers import about, ask
from bevel_differential.designs.task import Task

LOAD, BRAKE, SPEED = "left.load_torque", "left.brake_torque", "left.speed"
TABLE = ([0.0, 0.0025, 0.0025, 0.004], [800.0, 840.0, 820.0, 835.0])


def text(sign=1.0, slopes=True):
    return f"""description = "a load that rises, and a brake"
stop_time = "4 ms"
step = "1 ms"
input_slopes = {str(slopes).lower()}
outputs = ["{LOAD}", "{BRAKE}", "{SPEED}"]
[set]
scene.gear_contact = "lumped"
{BRAKE} = 0.0
[[at]]
time = "1.5 ms"
{BRAKE} = 5.0
[[table]]
input = "{LOAD}"
time = {TABLE[0]}
value = {[sign * value for value in TABLE[1]]}
"""


@pytest.mark.parametrize("slopes", [True, False])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_record_has_the_inputs_that_act(sign, slopes, folder):
    (folder / "scene.toml").write_text(text(sign, slopes), encoding="utf-8")
    with Scene.load("scene.toml") as scene:
        record = scene.run()
    assert (record["time"] * 1e3).tolist() == pytest.approx([0.0, 1.0, 1.5, 1.5, 2.0, 2.5, 2.5, 3.0, 4.0])
    assert record[BRAKE].tolist() == [0.0] * 3 + [5.0] * 6
    held = [800.0, 800.0, 816.0, 824.0, 824.0, 832.0, 820.0, 820.0, 825.0]
    straight = [800.0, 816.0, 824.0, 824.0, 832.0, 840.0, 820.0, 825.0, 835.0]
    # a table is read 1e-6 of a step after a point
    assert record[LOAD] == pytest.approx(sign * np.array(straight if slopes else held), rel=1e-7)
    ask({"ask": "run", "of": about("scene.toml"), "out": "own.csv"})
    own = np.array(list(csv.reader(open("own.csv", encoding="utf-8")))[1:], float)
    assert np.array_equal(own, np.array(record.tolist()))


def test_figures_of_inputs_are_those_of_their_tables(folder):
    (folder / "scene.toml").write_text(text(), encoding="utf-8")
    exact = (2.5 * 820.0 + 1.5 * 827.5) / 4.0
    with Scene.load("scene.toml") as scene:
        figures = Task(scene, [f"{LOAD}:mean", f"{LOAD}:max", f"{BRAKE}:max"]).evaluate(0, {}).figures
    assert list(figures.values()) == pytest.approx([exact, 840.0, 5.0], rel=1e-7)
    found = Differential({"scene.gear_contact": "ideal"}).run({LOAD: TABLE}, [LOAD], 0.004, 0.001)
    assert found[LOAD][-1] == pytest.approx(835.0, rel=1e-7)


def test_commands_take_inputs_as_outputs(folder):
    (folder / "scene.toml").write_text(text(), encoding="utf-8")
    (folder / "other.toml").write_text(text(-1.0), encoding="utf-8")
    printed = command(f"run scene.toml --output {LOAD} --csv a.csv --plot a.png").out
    line = next(line.split() for line in printed.splitlines() if line.startswith(LOAD))
    assert [float(cell) for cell in line[2:]] == pytest.approx([800.0, 822.813, 840.0, 835.0], rel=1e-5)
    command(f"run scene.toml other.toml --output {LOAD}")
    command(f"sweep --scene scene.toml --vary right.load_torque=800,810 --plan grid --want {LOAD}:max --condition '{LOAD}:max <= 850 N.m' "
            "--workers 0")
    command("plan scene.toml --python script.py")
    assert LOAD in (folder / "script.py").read_text(encoding="utf-8")
    assert compare("scene.toml", "other.toml", outputs=[LOAD]).table()["figure"].tolist() == ["mean", "peak", "end"]
