"""Outputs of effects that are off: runs warn and name the switch; conditions and searches refuse."""

import re
from functools import partial
from pathlib import Path

import pytest
from refusals import refused, warnings_about
from command_list import SCENE

from bevel_differential import Differential, Scene
from bevel_differential.answers import about, ask
from bevel_differential.comparison import compare
from bevel_differential.designs.farm import Farm
from bevel_differential.designs.sweep import sweep
from bevel_differential.optimise.problem import Problem
from bevel_differential.optimise.search import Store, search
from bevel_differential.tolerance.plan import Plan
from bevel_differential.vehicle import Car

said = partial(warnings_about, " so nothing changes it")
DOCS = Path(__file__).resolve().parents[2] / "docs"
IDEAL = {"scene.gear_contact": "ideal"}
STRENGTH = "safety.root_min: effects.strength is off"
# an output, what keeps it from being computed, and values with which it is computed
CASES = [("safety.root_min", "effects.strength is off", {"effects.strength": True, "scene.gear_contact": "lumped"}),
         ("coupling.step_advice", "effects.coupling_advice is off", {"effects.coupling_advice": True}),
         ("heat.clutch", "effects.limited_slip is off and lock.command is 0", {"effects.limited_slip": True}),
         ("heat.clutch", "effects.limited_slip is off and lock.command is 0", {"lock.command": 1.0}),
         ("heat.drag", "effects.bearing_drag is off", {"effects.bearing_drag": True}),
         ("temperature.clutch", "effects.warm_up is off", {"effects.warm_up": True}),
         ("pv.brake", "effects.wheel_brake is off", {"effects.wheel_brake": True}),
         ("left.twist", "effects.half_shaft is off", {"effects.half_shaft": True}),
         # a side that is driven by speed has its half-shaft without the switch
         ("left.twist", "effects.half_shaft is off", {"scene.left_drive": "speed"})]


@pytest.mark.parametrize("output, why, on", CASES)
def test_every_way_to_run_warns_of_an_output_of_an_effect_that_is_off(output, why, on):
    for values, count in ((IDEAL, 1), ({**IDEAL, **on}, 0)):
        scene = Scene("a", stop=1e-3, outputs=[output], set=values)
        ways = [scene.run, scene.final, lambda: compare(scene, Scene("b", stop=1e-3, outputs=[output], set=on)),
                lambda: Differential(values).run(outputs=[output], stop=1e-3),
                lambda: Differential(values).final([output], stop=1e-3),
                lambda: ask({"ask": "plan", "of": about(scene)})]
        for way in ways:
            found = said(way)
            assert len(found) == count and all(output in text and why in text for text in found), found


def test_all_outputs_of_effects_are_found(started, outputs):
    """With all effects off, an output of an effect keeps its value of the start; other outputs are not named."""
    with Scene("all", stop=1e-3, outputs=outputs) as scene:
        found = scene.off_outputs().names
        assert {"damage.side_flank", "stress.root_side_max", "left.speed_peak_to_peak", "coupling.energy_ratio", "temperature.oil"} <= set(found)
        assert not {"left.speed", "efficiency", "geometry.contact_ratio", "left.normal_force", "heat.contact"} & set(found)
        instance = started({"carrier.speed_command": 30.0})
        before = instance.read(found)
        instance.step(0.05)
        assert instance.read(found) == before


def test_a_command_that_comes_later_closes_the_lock():
    for course in ({"changes": [(5e-4, {"lock.command": 1.0})]}, {"tables": [("lock.command", [0.0, 1e-3], [0.0, 1.0], None)]}):
        assert not said(Scene("later", stop=1e-3, outputs=["heat.clutch"], set=IDEAL, **course).run)
    differential = Differential(IDEAL)
    assert not said(lambda: differential.run({"lock.command": ([0.0, 1e-3], [0.0, 1.0])}, ["heat.clutch"], 1e-3))
    assert said(lambda: differential.run({"lock.command": 0.0}, ["heat.clutch"], 1e-3))


def test_a_car_warns_and_knows_the_commands_of_its_controller():
    car = Car(IDEAL)
    assert len(said(lambda: car.run(["heat.clutch"], 0.01))) == 1
    assert not said(lambda: car.run(["heat.clutch"], 0.01, controller=lambda time, values: {"lock.command": 0.5}))


@pytest.fixture
def off(tmp_path):
    """Folder with a scene without strength, and files of studies that want its outputs."""
    (tmp_path / "scene.toml").write_text(SCENE.replace("effects.strength = true\n", ""), encoding="utf-8")
    (tmp_path / "search.toml").write_text(
        'description = "d"\nscene = "scene.toml"\nobjectives = ["minimise gears.mass", "maximise safety.root_min"]\n[vary]\n'
        'geometry.module = "3.5 mm..6 mm"\n', encoding="utf-8")
    (tmp_path / "tolerance.toml").write_text(
        'description = "d"\nscene = "scene.toml"\nruns = 8\nwants = ["safety.root_min"]\n[factors]\n'
        'geometry.face_width = "20 mm +- 0.1 mm"\n', encoding="utf-8")
    return tmp_path


def test_searches_and_tolerances_refuse(off, fmu_file):
    for load in (lambda: Problem.load(off / "search.toml"), lambda: Plan.load(off / "tolerance.toml", fmu_file)):
        with refused(STRENGTH):
            load()
    for name in ("search.toml", "tolerance.toml"):
        (off / name).write_text((off / name).read_text(encoding="utf-8") + "[set]\neffects.strength = true\n", encoding="utf-8")
    assert Problem.load(off / "search.toml").wants and Plan.load(off / "tolerance.toml", fmu_file).notes == []


def test_a_richer_model_that_switches_strength_off_is_refused(off):
    text = (off / "search.toml").read_text(encoding="utf-8")
    (off / "search.toml").write_text(f'{text}[set]\neffects.strength = true\n[[confirm]]\nname = "without"\neffects.strength = false\n',
                                     encoding="utf-8")
    with refused(STRENGTH):
        Problem.load(off / "search.toml")


def test_conditions_of_sweeps_refuse_and_wants_warn(off):
    vary = {"left.load_torque": "700, 800"}
    with Scene.load(off / "scene.toml") as scene:
        with refused(STRENGTH):
            sweep(scene, vary, "grid", wants=["left.speed"], conditions=["safety.root_min >= 1"], workers=0)
        assert len(said(lambda: sweep(scene, vary, "grid", wants=["safety.root_min"], workers=0))) == 1
        # a design without the effect fails, because its condition means nothing
        result = sweep(scene, {**vary, "effects.strength": "false, true"}, "grid", wants=["left.speed"], conditions=["safety.root_min >= 0.1"],
                       workers=0)
        rows = result.table.to_pylist()
        assert [row["feasible"] for row in rows] == [row["effects.strength"] for row in rows] == [False, True, False, True]
        assert all((STRENGTH in row["message"]) != row["effects.strength"] for row in rows)


def toml_of(page, start):
    """The TOML file on a page of the documentation that begins with `start`."""
    blocks = re.findall(r"```toml\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)
    return next(block for block in blocks if block.startswith(start))


def test_the_problem_file_of_the_page_works_with_the_turn_of_the_other_page(fmu_file, tmp_path):
    (tmp_path / "turn.toml").write_text(toml_of("your-car.md", 'description = "a turn'), encoding="utf-8")
    (tmp_path / "gears.toml").write_text(toml_of("design.md", 'description = "gears'), encoding="utf-8")
    problem = Problem.load(tmp_path / "gears.toml", fmu_file, "20 ms").sized(population=12, generations=1)
    with Farm(0) as farm:
        best = search(problem, farm, Store(tmp_path / "out", problem))
    assert best and all(row.figures["safety.root_min:final"] > 0.1 for row in best)
