"""Questions to the library of answers: objects, problems as values, interrupted work, threads."""

import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from command_line import command
from documents import saved
from interrupts import with_interrupts

from bevel_differential import Accuracy, DifferentialError, Scene, accuracy
from bevel_differential.answers import about, ask

# long enough for an interrupt: the richest model needs seconds
FILES = "--ssv chosen.ssv --python chosen.py"
LONG = {"stop_time": "5 s", "step": "1 ms"}


def test_the_cheapest_setting_is_found_and_reproduces_its_figures(tmp_path):
    found = accuracy("clunk", "left.shaft_torque:max", "1%", file=tmp_path / "chosen.toml")
    assert isinstance(found, Accuracy) and found.wants == ["left.shaft_torque:max"] and found.within == 0.01
    assert found.use.run.place == "chosen" and found.use.run.error <= 0.01 < found.cheaper.run.error
    assert found.cheaper.run.price < found.use.run.price < found.reference.price
    assert "half_shaft" in found.needed and found.needed["half_shaft"] > 0.01
    # the setting, run through the FMU, has the promised figure
    (tmp_path / "chosen.toml").write_text(found.answer["file"], encoding="utf-8")
    with Scene.load(tmp_path / "chosen.toml") as chosen:
        peak = chosen.run(["left.shaft_torque"])["left.shaft_torque"][1:].max()
        assert chosen.values["solver.relative_tolerance"] == found.use.set["solver.relative_tolerance"]
    assert peak == pytest.approx(found.values["left.shaft_torque:max"], rel=0.01)
    assert "Needed" in str(found) and len(found.table.splitlines()) == len(found.runs) + 1
    found.plot(tmp_path / "front.png")
    assert (tmp_path / "front.png").stat().st_size > 10_000


@pytest.mark.parametrize("within", ["1%", "10%"])
def test_a_written_scene_sets_only_values_that_have_an_effect(within, folder):
    # the torque does not need the effect warm_up, so the table has no effect
    idle = 'effects.warm_up = true\n[[table]]\ninput = "warm_up.ambient_change"\ntime = [0.0, 0.2]\nvalue = [0.0, 5.0]\n'
    (folder / "turn.toml").write_text(saved("docs/your-car.md")["turn.toml"] + idle, encoding="utf-8")
    command(f"accuracy turn.toml --want left.shaft_torque:mean --within {within} --write chosen.toml {FILES}")
    assert "changes nothing" not in command("plan chosen.toml").err
    written = {kind: (folder / f"chosen.{kind}").read_text(encoding="utf-8") for kind in ("toml", "ssv", "py")}
    # an accuracy of 10 % needs no washer friction
    assert all(("thrust_friction.radii_from_geometry" in text) == (within == "1%") for text in written.values())
    assert "warm_up.ambient_change" not in written["toml"] and "warm_up.ambient_change" not in written["py"]


def test_a_scene_as_an_object_is_the_scene_of_the_file():
    with Scene.load("limited_slip") as scene:
        told = [ask({"ask": "plan", "of": about(what)})["text"] for what in (scene, "limited_slip")]
    # paths and measured times differ
    lines = [[line for line in text.splitlines() if not line.startswith(("  file", "  cost  "))] for text in told]
    assert lines[0] == lines[1] and len(lines[0]) > 10


def test_problems_are_returned_as_values():
    with pytest.raises(DifferentialError) as caught:
        accuracy("limited_slip", within="1%", set={"geometry.module": "4.5 kg", "geometry.face_widht": 0.02})
    assert caught.value.kind == "use"
    module, width = caught.value.problems
    assert (module["variable"], module["unit"], module["value"]) == ("geometry.module", "m", '"4.5 kg"')
    assert width["hint"] == "geometry.face_width" and len(module["range"]) == 2


def test_an_error_in_the_progress_stops_the_work_and_is_raised():
    class Enough(Exception):
        pass

    def progress(done, what):
        raise Enough(what)

    with pytest.raises(Enough):
        accuracy("torque_bias", within="1%", set=LONG, progress=progress)


def test_ctrl_c_stops_the_command():
    words = "accuracy torque_bias --within 1% --progress lines --set stop_time=20s".split()
    running = subprocess.Popen([sys.executable, "-m", "bevel_differential", *words], stderr=subprocess.PIPE, text=True, preexec_fn=with_interrupts)
    assert "reference" in running.stderr.readline()
    begin = time.monotonic()
    running.send_signal(signal.SIGINT)
    said = running.communicate(timeout=30)[1]
    assert running.returncode == 130 and "stopped" in said and "Traceback" not in said and time.monotonic() - begin < 10.0


def test_threads_get_separate_answers():
    def module(size):
        text = ask({"ask": "geometry", "set": [f"geometry.module={size} mm"], "facets": 4})["files"]["dimensions.txt"]
        return f"geometry.module = {size} mm" in text

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(module, (3, 3.5, 4, 5, 5.5, 6, 6.5, 7)))


def test_fixed_steps_of_a_scene_are_kept_and_written(folder):
    (folder / "turn.toml").write_text(saved("docs/your-car.md")["turn.toml"], encoding="utf-8")
    question = {"want": "left.shaft_torque:mean", "within": "1%", "set": {"solver.method": "fixed_step"}}
    found = accuracy("turn.toml", **question)
    step = found.use.set["solver.fixed_step"]
    assert found.use.set["solver.method"] == "fixed_step" and f"fixed steps of {step:.0e}".replace("e-0", "e-") in found.use.run.setting
    # neither the next longer steps nor the model reach this accuracy by chance
    tried = {run.setting: run.error for run in found.runs if "fixed steps" in run.setting}
    assert found.use.run.error <= 0.01 and len(tried) > 2
    printed = command(f"accuracy turn.toml --want {question['want']} --within 1% --set solver.method=fixed_step --write chosen.toml {FILES}").out
    assert "fixed steps" in printed
    written = {kind: (folder / f"chosen.{kind}").read_text(encoding="utf-8") for kind in ("toml", "ssv", "py")}
    assert "solver.fixed_step" in written["ssv"] and "solver.fixed_step" in written["py"]
    # with these steps, the FMU gives the figure of the richest model, and uses the steps
    with Scene.load("chosen.toml") as chosen, Scene.load("turn.toml") as tight:
        assert (chosen.value("solver.fixed_step"), chosen.value("solver.relative_tolerance")) == (step, 1e-6)
        record = chosen.run(["left.shaft_torque", "solver.steps", "solver.rejected"])
        tight.set({**found.answer["reference"]["set"], "solver.relative_tolerance": 1e-9})
        wanted = tight.run(["left.shaft_torque"])["left.shaft_torque"][1:].mean()
        least = chosen.stop / max(step, chosen.step)
    assert record["left.shaft_torque"][1:].mean() == pytest.approx(wanted, rel=0.01)
    assert record["solver.steps"][-1] >= least * (1.0 - 1e-9) and record["solver.rejected"][-1] == 0.0


def test_the_plan_says_that_its_speed_is_that_of_a_run_without_outputs():
    text = ask({"ask": "plan", "of": about("study_turning")})["text"]
    assert " x real time on this machine without reading outputs, " in text
