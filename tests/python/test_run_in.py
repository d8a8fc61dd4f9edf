"""Starts out of equilibrium: safety and damage may begin after the run-in, and users whose ratings count the impact are warned."""

import pytest

from bevel_differential import Scene
from bevel_differential.optimise.problem import Problem
from bevel_differential.report import strength
from bevel_differential.report.head import verdicts
from bevel_differential.report.simulated import Simulated
from bevel_differential.report.strength import section

RATED = ["safety.root_min", "safety.flank_min", "damage.planet", "damage.side_flank"]


def turn(fmu, **values):
    """The study's turn: its ratings at the end, and messages of the FMU about them."""
    scene = Scene.load("study_turning", fmu=fmu).set({"effects.strength": True, **values})
    record = scene.run(RATED)
    return {name: record[name][-1] for name in RATED}, [text for text in scene.warnings if text.startswith(strength.MESSAGE)]


def test_a_run_without_its_start_is_rated_as_one_from_equilibrium(fmu):
    blow, told = turn(fmu)
    settled, nothing = turn(fmu, **{"strength.rate_from": 0.1})
    balanced, none = turn(fmu, **{"scene.start": "equilibrium"})
    assert not nothing and not none
    assert len(told) == 1 and "not in equilibrium" in told[0]
    assert f"roots was {blow['safety.root_min']:.3f} at t = 0.00" in told[0]
    for name in RATED[:2]:
        assert settled[name] == pytest.approx(balanced[name], rel=0.05)
    assert blow["safety.root_min"] < 0.6 * settled["safety.root_min"]
    assert blow["damage.planet"] > 100.0 * settled["damage.planet"]


def test_the_report_says_that_the_smallest_factor_is_in_the_start(fmu):
    for start, told in (("rolling", True), ("equilibrium", False)):
        run = Simulated.of(Scene.load("study_turning", fmu=fmu).set({"scene.start": start}))
        text = " ".join(block.text for block in section(run).blocks if hasattr(block, "text"))
        assert ("is in the start" in text) == told
        assert any("in the start" in verdict.text for verdict in verdicts(run)) == told
        assert len(strength.notes(run)) == (2 if told else 0)


def test_optimise_warns_that_it_would_optimise_the_impact_at_the_start(fmu, tmp_path):
    def problem(start, objectives="\"maximise safety.root_min\", \"minimise gears.mass\"", more=""):
        (tmp_path / "scene.toml").write_text(f"description = \"a turn\"\nstop_time = 0.01\nstep = 0.001\noutputs = []\n[set]\n"
                                             f"scene.start = \"{start}\"\neffects.strength = true\n{more}\n")
        file = tmp_path / "problem.toml"
        file.write_text(f"description = \"some gears\"\nscene = \"scene.toml\"\nobjectives = [{objectives}]\n"
                        "[vary]\ngeometry.module = \"4 mm..6 mm\"\n")
        return Problem.load(file, fmu).start_warning()

    assert "safety.root_min" in problem("rolling") and "strength.rate_from" in problem("rest")
    assert not problem("equilibrium")
    assert not problem("rolling", more="strength.rate_from = 0.005")
    assert not problem("rolling", "\"minimise stress.contact_max\", \"minimise gears.mass\"")


def test_the_rated_contact_pressure_is_what_the_safety_factor_follows(run):
    record = run({"effects.strength": True, "scene.planet_spin": "imposed"}, stop=0.01,
                 output=["stress.contact_rated", "safety.flank_min"])
    assert record["safety.flank_min"][-1] == pytest.approx(1500e6 / record["stress.contact_rated"][-1], rel=1e-6)


def test_a_bias_imposed_by_the_scene_is_reported_if_something_has_friction(fmu):
    for values, told in (({"effects.thrust_friction": True}, True), ({}, False),
                         ({"effects.thrust_friction": True, "scene.planet_spin": "free"}, False)):
        scene = Scene.load("study_turning", fmu=fmu).set(values)
        record = scene.run(["torque_bias_ratio"], stop=0.01)
        assert any(text.startswith("torque_bias_ratio: ") for text in scene.warnings) == told
        if told:
            assert record["torque_bias_ratio"][-1] == pytest.approx(1.0, abs=1e-9)
