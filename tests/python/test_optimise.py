"""Optimisation of gears: quantities against closed forms, the front against brute force, repetition, interruption, wrong use."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from interrupts import with_interrupts
from pymoo.indicators.hv import HV
from command_line import command
from command_list import SCENE

from bevel_differential import DifferentialError, Fmu, Scene, cad
from bevel_differential.command import INTERRUPTED
from bevel_differential.designs.farm import Farm
from bevel_differential.designs.task import Row
from bevel_differential.optimise import command as optimise_command
from bevel_differential.optimise import front
from bevel_differential.optimise.design_task import Confirmed, DesignRow, DesignTask, confirm
from bevel_differential.pair import Pair, tool_room, violations
from bevel_differential.optimise.problem import Objective, Problem
from bevel_differential.quantities import QUANTITIES
from bevel_differential.optimise.report import compared_with_front, below_one, scene_text, write_gears
from bevel_differential.optimise.search import Store, search
from bevel_differential.want import Statistic, Want
from refusals import refused

# a small search
FOUR = "--workers 0 --population 12 --generations 4"
REPOSITORY = Path(__file__).resolve().parents[2]
# two variables: the module and the face width
TWO = """description = "light or strong"
scene = "scene.toml"
objectives = ["minimise gears.mass", "maximise safety.root_min"]
conditions = ["envelope.diameter <= 95 mm", "face.width_in_modules <= 3"]
population = 40
generations = 25
seed = 3
[vary]
geometry.module = "3.5 mm..6 mm"
geometry.face_width = "6 mm..20 mm"
[[compare]]
name = "the study's gears"
geometry.module = "4.5 mm"
geometry.face_width = "20 mm"
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "two.toml").write_text(TWO, encoding="utf-8")
    return tmp_path


@pytest.fixture
def two(folder):
    return Problem.load(folder / "two.toml")


def changed(folder, old, new):
    """Problem with a replaced piece of its file."""
    assert old in TWO
    (folder / "changed.toml").write_text(TWO.replace(old, new), encoding="utf-8")
    return Problem.load(folder / "changed.toml")


def found(problem, out, workers=0):
    """Front and all rows of a search."""
    with Farm(workers) as farm:
        store = Store(out, problem)
        return search(problem, farm, store), list(store.rows.values())


def study():
    """Values of the study's pair with a pin and a shaft, by name."""
    return {"geometry.module": 4.5e-3, "geometry.planet_teeth": 10, "geometry.side_teeth": 16, "geometry.planet_count": 2,
            "geometry.pressure_angle": math.radians(20.0), "geometry.face_width": 20e-3, "geometry.backlash": 1e-4,
            "geometry.addendum_system": 2, "geometry.planet_bore": 16e-3, "geometry.side_bore": 24e-3, "geometry.thickness_shift": 0.0}


def test_quantities_are_their_closed_forms():
    pair = Pair.of(study())
    # Gleason at a ratio of virtual teeth of (16/10)²: h_as = (0.54 + 0.46/2.56) 4.5 mm = 3.2386 mm, h_ap = 9 mm - h_as
    outer, planet_addendum = math.sqrt(22.5**2 + 36.0**2), 9.0 - (0.54 + 0.46 / 2.56) * 4.5
    root_angle = math.atan(10 / 16) - math.atan((2.188 * 4.5 + 0.05 - planet_addendum) / outer)
    # side gear: h_fs = 2.188 m + 0.05 mm - h_as
    side_root = math.atan(16 / 10) - math.atan((2.188 * 4.5 + 0.05 - 9.0 + planet_addendum) / outer)
    values = {**study(), "planet[1].pin_force": 30e3, "planet[1].thrust_force": 5e3, "geometry.planet_mass": 0.15,
              "geometry.side_mass": 0.30, "strength.tool_radius": 0.25}
    back = outer * math.sin(root_angle)
    expected = {
        "gears.mass": 2 * 0.15 + 2 * 0.30,
        "envelope.diameter": 2e-3 * math.hypot(outer, planet_addendum),
        # along the carrier's axis: 22.5 mm, plus h_fs = 6.6574 mm down the back cone
        "envelope.length": 2e-3 * (22.5 + (2.188 * 4.5 + 0.05 - 9.0 + planet_addendum) * 16 / math.hypot(10, 16)),
        "face.width_over_cone": 20.0 / outer,
        "teeth.common_divisor": 2.0,
        "pin.shear": 4.0 / 3.0 * 30e3 / (math.pi * 8e-3**2),
        "pin.pressure": 30e3 / (16e-3 * 20e-3 * math.cos(root_angle)),
        "pin.rim": ((outer - 20.0) * math.sin(root_angle) - 8.0) / math.cos(root_angle) / (4.5 * (outer - 20.0) / outer),
        "shaft.rim": ((outer - 20.0) * math.sin(side_root) - 12.0) / math.cos(side_root) / (4.5 * (outer - 20.0) / outer),
        "washer.planet_width": 1e-3 * (back - 8.0),
        "washer.planet_pressure": 5e3 / (math.pi * 1e-6 * (back**2 - 8.0**2)),
    }
    # the largest load of all planets counts
    values |= {"planet[3].pin_force": 20e3, "planet[4].pin_force": 0.0, "planet[2].thrust_force": 4e3}
    for name, value in expected.items():
        assert QUANTITIES[name].of(values, pair) == pytest.approx(value, rel=1e-12), name


def test_a_standard_rack_has_room_for_the_tool_radius_of_its_standard():
    # ISO 53, profile A: c = 0.25 m, rho = 0.38 m at 20 degrees
    standard = Pair.of({**study(), "geometry.addendum_system": 1})
    assert tool_room(standard, 0.38) == pytest.approx(0.0, abs=5e-3)
    # at 25 degrees the flanks leave less width: a circle that touches both flanks and the tip
    steep = Pair.of({**study(), "geometry.addendum_system": 1, "geometry.pressure_angle": math.radians(25.0)})
    half_width, alpha = math.pi / 4 - 1.25 * math.tan(math.radians(25.0)), math.radians(25.0)
    radius = half_width / math.tan(math.pi / 4 - alpha / 2)
    assert radius < 0.25 / (1.0 - math.sin(alpha))
    assert tool_room(steep, 0.0) == pytest.approx(radius, rel=1e-12)


def test_checks_refuse_what_the_fmu_refuses_or_warns_of(fmu_file):
    fmu, draw = Fmu.of(fmu_file), np.random.default_rng(4)
    starts = {name: value for name, value in fmu.starts().items() if name.startswith("geometry.")}
    sound = 0
    with Scene("gears", stop=1e-4, step=1e-4, outputs=["geometry.contact_ratio"]) as scene:
        for _ in range(400):
            values = {**starts, "geometry.module": draw.uniform(2e-3, 6e-3), "geometry.planet_teeth": int(draw.integers(6, 16)),
                      "geometry.side_teeth": int(draw.integers(9, 26)), "geometry.planet_count": int(draw.integers(2, 5)),
                      "geometry.pressure_angle": math.radians(draw.uniform(16.0, 30.0)),
                      "geometry.face_width": draw.uniform(5e-3, 25e-3),
                      "geometry.addendum_system": int(draw.integers(1, 5)), "geometry.planet_addendum": draw.uniform(0.7, 1.6),
                      "geometry.side_addendum": draw.uniform(0.4, 1.3), "geometry.planet_dedendum": draw.uniform(0.7, 1.6),
                      "geometry.side_dedendum": draw.uniform(0.9, 1.7), "geometry.planet_bore": draw.choice([0.0, 10e-3, 16e-3]),
                      "geometry.side_bore": draw.choice([0.0, 24e-3]), "geometry.thickness_shift": draw.uniform(-0.1, 0.1)}
            pair = Pair.of(values)
            refusals = violations(pair)
            try:
                ratio = scene.final(values=values)["geometry.contact_ratio"]
                # only the FMU checks fillets
                told = [text for text in scene.warnings if text.startswith("geometry.") and "root_fillet" not in text
                        and text.partition(":")[0] not in scene.unfelt]
                assert pair.contact_ratio == pytest.approx(ratio, rel=1e-9)
            except DifferentialError as error:
                told = [str(error)]
            assert bool(told) == bool(refusals), (told, refusals, values)
            sound += not refusals
    assert 20 < sound < 380


def test_the_front_is_that_of_a_fine_grid(two, folder):
    best, rows = found(two, folder / "out")
    task = DesignTask(two)
    modules, widths = np.meshgrid(np.linspace(3.5e-3, 6e-3, 41), np.linspace(6e-3, 20e-3, 51))
    grid = [task.evaluate(k, {"geometry.module": m, "geometry.face_width": b})
            for k, (m, b) in enumerate(zip(modules.flat, widths.flat))]
    task.close()
    truth = front.front(grid, two.objectives)
    assert 20 < len(truth) < sum(row.feasible for row in grid) < len(grid)
    cost, true_cost = front.costs(best, two.objectives), front.costs(truth, two.objectives)
    # one measure of closeness, spread and extent: the area that a front dominates, from its worst point on the grid
    worst = true_cost.max(axis=0)
    area, true_area = HV(ref_point=worst)(cost), HV(ref_point=worst)(true_cost)
    assert area == pytest.approx(true_area, rel=0.01)
    # the grid and the search refuse more modules than the conditions allow
    assert all(row.violation == 0.0 and not row.refused for row in best)
    assert len(rows) < len(grid) / 2


def test_the_same_seed_gives_the_same_front_however_many_workers(two, folder):
    small = two.sized(population=12, generations=3, starts=2)
    alone, rows = found(small, folder / "alone")
    many, other_rows = found(small, folder / "workers", workers=2)
    assert [(row.run, row.values, row.figures) for row in alone] == [(row.run, row.values, row.figures) for row in many]
    assert [(row.values, row.violation) for row in rows] == [(row.values, row.violation) for row in other_rows]
    other, _ = found(small.sized(seed=4), folder / "seed")
    assert [row.values for row in alone] != [row.values for row in other]
    # two starts, and one that continues from the best designs of both
    assert len(rows) > 12 * 3 * 2


class Interrupted:
    """Farm that returns rows in another order, like several workers, and that is interrupted within a generation."""

    def __init__(self, after):
        self.left = after

    def rows(self, task, designs):
        for run, values in [*designs[::2], *designs[1::2]]:
            if not self.left:
                raise KeyboardInterrupt
            self.left -= 1
            yield task.evaluate(run, values)


class Dying:
    """Farm with one design that kills its worker each time."""

    def rows(self, task, designs):
        for run, values in designs:
            yield Row(run, dict(values), message="its worker process died each time") if run == 3 else task.evaluate(run, values)


def test_a_design_that_kills_its_worker_is_out_of_reach_and_the_search_goes_on(two, folder):
    store = Store(folder / "dying", two.sized(population=8, generations=2))
    best = search(store.problem, Dying(), store)
    dead = next(row for row in store.rows.values() if row.run == 3)
    assert not dead.feasible and dead.refused == ("its worker process died each time",) and dead not in best
    assert dead.violation > 0.0
    assert len(Store(folder / "dying", store.problem, resume=True).rows) == len(store.rows)


def test_a_generation_that_was_interrupted_keeps_the_numbers_of_its_designs(two, folder):
    problem = two.sized(population=12, generations=3)
    whole, rows = found(problem, folder / "whole")
    with pytest.raises(KeyboardInterrupt):
        search(problem, Interrupted(after=20), Store(folder / "parts", problem))
    store = Store(folder / "parts", problem, resume=True)
    kept = [row.run for row in store.rows.values()]
    assert kept == sorted(kept) and len(kept) == 20 and kept != list(range(20))
    with Farm(0) as farm:
        on = search(problem, farm, store)
    assert [(row.run, row.values) for row in store.rows.values()] == [(row.run, row.values) for row in rows]
    assert [(row.run, row.values, row.figures) for row in on] == [(row.run, row.values, row.figures) for row in whole]
    # rows that are read equal the rows that were written
    again = Store(folder / "parts", problem, resume=True)
    assert [row.flat() for row in again.rows.values()] == [row.flat() for row in store.rows.values()]


def test_a_range_of_a_search_has_no_count(folder):
    file = folder / "two.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("3.5 mm..6 mm", "3.5 mm..6 mm:4"), encoding="utf-8")
    with refused("leave the count out"):
        Problem.load(file)


def test_a_value_that_changes_nothing_does_not_make_a_design_wrong(two):
    design = {"geometry.module": 4.5e-3, "geometry.face_width": 12e-3}
    plain = DesignTask(two).evaluate(0, design)
    two.scene.set({"geometry.planet_addendum": 1.3})
    row = DesignTask(two).evaluate(0, design)
    assert "geometry.planet_addendum" in two.scene.unfelt
    assert (row.refused, row.figures, row.message) == (plain.refused, plain.figures, "")


def test_designs_that_break_something_are_not_on_the_front(two, folder):
    best, rows = found(two.sized(population=20, generations=6), folder / "out")
    broken = [row for row in rows if row.refused]
    assert broken and not {row.run for row in broken} & {row.run for row in best}
    with two.scene as scene:
        for row in best:
            scene.final(["geometry.contact_ratio"], row.values)
            assert not [text for text in scene.warnings if text.startswith("geometry.")]
            assert row.figures["envelope.diameter:final"] <= 0.095
            assert row.values["geometry.face_width"] <= 3.0 * row.values["geometry.module"]


def test_the_study_s_gears_are_compared_with_the_front(two, folder):
    best, _ = found(two.sized(population=20, generations=8), folder / "out")
    task = DesignTask(two, thorough=True)
    row = task.evaluate(-1, two.compare["the study's gears"])
    task.close()
    assert row.refused == ("face.width_in_modules:final <= 3",) and not row.feasible
    mass, safety = (row.figures[name] for name in ("gears.mass:final", "safety.root_min:final"))
    better = sum(each.figures["gears.mass:final"] <= mass and each.figures["safety.root_min:final"] >= safety for each in best)
    assert f"{better} of {len(best)} designs of the front are better" in compared_with_front("study", row, best, two) if better else \
        "no design of the front is better" in compared_with_front("study", row, best, two)
    chosen = front.choice(best, two.objectives, row)
    assert len(chosen) == len({each.run for _, each in chosen}) == front.CHOICES


@pytest.mark.parametrize("own, other, expected", [(2.0, 3.0, 0.5), (-2.0, -1.0, -0.5), (0.0, 3.0, math.nan), (1e-12, 3.0, math.nan),
                                                  (0.0, 0.0, math.nan), (2.0, 0.0, -1.0)])
def test_a_figure_that_vanishes_has_no_relative_difference(own, other, expected):
    row, richer = (DesignRow(0, {}, {"power.loss:mean": figure}) for figure in (own, other))
    assert Confirmed(row, {"richer": richer}).difference("richer", "power.loss:mean") == pytest.approx(expected, nan_ok=True)


def test_dominance_and_knee_of_a_known_front():
    final = Statistic("final")

    def row(run, x, y):
        return DesignRow(run, {}, {"x:final": x, "y:final": y}, feasible=True)

    # y is maximised; the front is the quarter circle x² + y² = 1, with dominated points behind it
    angles = np.linspace(0.0, 0.5 * np.pi, 9)
    rows = [row(k, 1.0 - math.cos(a), math.sin(a)) for k, a in enumerate(angles)]
    rows += [row(20 + k, 1.3 - math.cos(a), 0.9 * math.sin(a)) for k, a in enumerate(angles)]
    objectives = [Objective(Want("x", final), 1.0), Objective(Want("y", final), -1.0)]
    best = front.front(rows, objectives)
    assert [each.run for each in best] == list(range(9))
    knee = front.choice(best, objectives, None)[0]
    assert knee[1].run == 4 and knee[0].startswith("knee")
    thin = front.thinned(best, objectives, 5)
    assert len(thin) == 5 and {thin[0].run, thin[-1].run} == {0, 8}


def test_front_points_are_confirmed_by_the_richest_model():
    problem = Problem.load(REPOSITORY / "examples/design/study_gears.toml")
    task = DesignTask(problem)
    good = {"geometry.planet_teeth": 13, "geometry.side_teeth": 20, "geometry.planet_count": 4, "geometry.module": 3.7e-3,
            "geometry.pressure_angle": 0.37, "geometry.face_width": 13e-3, "geometry.planet_addendum": 1.34,
            "geometry.side_addendum": 0.72, "geometry.planet_bore": 16.8e-3, "strength.tool_radius": 0.25}
    row = task.evaluate(0, good)
    task.close()
    assert row.feasible, row
    with Farm(0) as farm:
        told = confirm([row], [], problem, farm)[0]
    model = "elastic bodies"
    settings = {**problem.scene.values, **problem.complete(good), **problem.confirm[model].settings}
    scene = problem.scene.__getstate__()
    with Scene(**{**scene, "set": settings}) as richest:
        figures = richest.final([want.name for want in (each.want for each in problem.objectives) if want.name not in QUANTITIES])
    for name, figure in figures.items():
        assert told.models[model].figures[f"{name}:final"] == figure
    # docs/accuracy.md: forces are accurate to 0.1 %, the swing of the transmission error to 9 %; root stress follows the forces and the
    # load over the face
    assert abs(told.difference(model, "planet[1].left_transmission_error_peak_to_peak:final")) < 0.09
    assert abs(told.difference(model, "gears.mass:final")) == 0.0
    assert not told.models[model].refused and list(told.models) == [model]


def test_loads_of_pins_and_washers_are_the_largest_over_all_planets_and_the_whole_run():
    problem = Problem.load(REPOSITORY / "examples/design/study_gears.toml")
    # four planets between 10 and 18 teeth mesh half a pitch apart, and their loads swing in each mesh cycle of 160 ms
    design = {"geometry.planet_teeth": 10, "geometry.side_teeth": 18, "geometry.planet_count": 4, "geometry.module": 4e-3,
              "geometry.pressure_angle": 0.40, "geometry.face_width": 13e-3, "geometry.planet_addendum": 1.2,
              "geometry.side_addendum": 0.8, "geometry.planet_bore": 14e-3, "strength.tool_radius": 0.2}
    names = {"pin.shear": [f"planet[{k}].pin_force" for k in range(1, 5)],
             "pin.pressure": [f"planet[{k}].pin_force" for k in range(1, 5)],
             "washer.planet_pressure": [f"planet[{k}].thrust_force" for k in range(1, 5)],
             "washer.side_pressure": ["left.thrust_force", "right.thrust_force"]}
    problem.scene.stop = 0.25
    values = problem.complete(design)
    record = problem.scene._record(sorted({name for each in names.values() for name in each}), values, step=2e-4)
    known = problem.known(values)
    swing = record["planet[1].pin_force"]
    assert swing.max() > 1.2 * swing[record["time"] > 0.15].min()
    for stop in (0.25, 0.2375, 0.225, 0.21):
        problem.scene.stop = stop
        task = DesignTask(problem, thorough=True)
        row = task.evaluate(0, design)
        task.close()
        for quantity, loads in names.items():
            largest = {name: max(record[other].max() for other in loads) for name in loads}
            expected = QUANTITIES[quantity].of({**known, **largest}, Pair.of(known))
            assert row.figures[f"{quantity}:final"] == pytest.approx(expected, rel=2e-3), (quantity, stop)


def test_a_fast_mesh_cycle_is_read_at_more_points():
    problem = Problem.load(REPOSITORY / "examples/design/study_gears.toml")
    # the sides turn fifty times faster against each other, so that a step of the scene is a third of a mesh cycle
    problem.scene.stop, problem.scene.step = 0.04, 0.02
    problem.scene.set({"left.speed_command": "7000 deg/s", "right.speed_command": "-5000 deg/s"})
    task = DesignTask(problem, thorough=True)
    row = task.evaluate(0, problem.compare["the study's gears"])
    task.close()
    values = problem.complete(problem.compare["the study's gears"])
    record = problem.scene._record(["planet[1].pin_force", "planet[2].pin_force"], values, step=5e-5)
    largest = {name: record[name].max() for name in record.dtype.names[1:]}
    known = problem.known(values)
    expected = QUANTITIES["pin.shear"].of({**known, **largest}, Pair.of(known))
    assert row.figures["pin.shear:final"] == pytest.approx(expected, rel=0.02)


def test_a_run_without_a_whole_mesh_cycle_is_not_a_quiet_design():
    problem = Problem.load(REPOSITORY / "examples/design/study_gears.toml")
    problem.scene.stop = 0.05
    row = DesignTask(problem, thorough=True).evaluate(0, problem.compare["the study's gears"])
    assert "no whole mesh cycle passes" in row.message and not row.feasible


def test_a_chosen_design_is_a_scene_and_gears_for_cad(two, folder):
    best, _ = found(two.sized(population=12, generations=6), folder / "out")
    file = folder / "chosen.toml"
    file.write_text(scene_text(two, best[0], "the lightest \"one\""), encoding="utf-8")
    with Scene.load(file, fmu=two.scene.fmu.file) as scene:
        assert scene.final(["safety.root_min"])["safety.root_min"] == best[0].figures["safety.root_min:final"]
    assert write_gears(two, best[0], folder / "gears") in (True, False)
    dimensions = (folder / "gears/dimensions.json").read_text(encoding="utf-8")
    assert f"{two.objectives[0].want.name}" not in dimensions
    files = ("planet_left_flank_heel.txt", "planet.step", "assembly.step", "side_gear.dxf")
    assert all((folder / "gears" / name).stat().st_size > 1_000 for name in files)


@pytest.mark.parametrize("old, new, parts", [
    ("safety.root_min\"]", "safety.root_mim\"]", "safety.root_mim … did you mean safety.root_min"),
    ("\"minimise gears.mass\"", "\"smallest gears.mass\"", "smallest … maximise OUTPUT"),
    ("\"minimise gears.mass\", ", "", "two or more"),
    ("\"minimise gears.mass\"", "\"minimise gears.mass:mean\"", "gears.mass … without a statistic"),
    ("3.5 mm..6 mm", "6 mm..3.5 mm", "geometry.module … ends at or before"),
    ("\"3.5 mm..6 mm\"", "\"normal(0.004, 0.001)\"", "geometry.module … not over a distribution"),
    ("geometry.module = \"3.5 mm..6 mm\"\ngeometry.face_width = \"6 mm..20 mm\"\n", "", "vary is missing"),
    ("<= 95 mm", "<= 95 kg", "envelope.diameter … kg"),
    ("population = 40", "population = 2", "population = 2 … 4 or more"),
    ("seed = 3", "sead = 3", "sead … did you mean seed"),
    ("[vary]", "[follow]\ngeometry.module = { from = \"geometry.face_width\" }\n[vary]", "geometry.module … varies as well"),
    ("[vary]", "[[confirm]]\nname = \"a\"\nconditions = [\"left.speed < 1\"]\n[vary]", "left.speed … replaces no condition"),
    ("[vary]", "[[confirm]]\nname = \"a\"\n[[confirm]]\nname = \"a\"\n[vary]", "[[confirm]] … needs a unique name"),
    ("[vary]", "[follow]\ngeometry.module = { of = \"geometry.face_width\" }\n[vary]", "geometry.module … from"),
])
def test_errors_in_a_file_name_the_fault(folder, old, new, parts):
    with refused(parts):
        changed(folder, old, new)


def test_all_errors_of_a_file_are_reported_at_once(folder):
    wrong = TWO.replace("gears.mass", "gears.mas").replace("95 mm", "95 kg").replace("6 mm..20", "60 mm..20")
    with pytest.raises(DifferentialError) as error:
        changed(folder, TWO, wrong)
    assert len(str(error.value).splitlines()) == 3


def test_without_feasible_designs_the_checks_give_the_reasons(folder):
    problem = changed(folder, "<= 95 mm", "<= 20 mm").sized(population=8, generations=2)
    with pytest.raises(DifferentialError) as error:
        found(problem, folder / "out")
    lines = str(error.value).splitlines()
    assert lines[0] == "no feasible design among 16. Designs refused by each check:"
    nearest = next(place for place, line in enumerate(lines) if line.startswith("The nearest one fails in: "))
    refused = {line.split(None, 1)[1]: int(line.split(None, 1)[0]) for line in lines[1:nearest]}
    assert sum(refused.values()) >= 16 and any("envelope.diameter" in check for check in refused)
    # the nearest design with all of its values
    shown = dict(line.strip().split(" = ") for line in lines[nearest + 1:-1])
    assert shown.keys() == {"geometry.module", "geometry.face_width", "gears.mass", "safety.root_min", "envelope.diameter", "face.width_in_modules"}
    assert shown["geometry.module"].endswith(" mm") and float(shown["envelope.diameter"].removesuffix(" mm")) > 20.0
    assert lines[-1].startswith("Widen the ranges")


def test_results_are_neither_overwritten_nor_mixed(two, folder):
    small = two.sized(population=8, generations=2)
    found(small, folder / "out")
    with refused("continue with --resume"):
        Store(folder / "out", small)
    with refused("another problem"):
        Store(folder / "out", changed(folder, "95 mm", "94 mm").sized(population=8), resume=True)
    with refused("no results to continue from"):
        Store(folder / "elsewhere", small, resume=True)
    (folder / "out/evaluations.parquet").write_bytes(b"not a table")
    with refused("no results to continue from"):
        Store(folder / "out", small, resume=True)


def test_a_generation_has_its_front_in_the_file_when_its_line_is_printed(folder, monkeypatch):
    def stop(line="", **_):
        if line.startswith("generation 2 "):
            raise KeyboardInterrupt

    monkeypatch.setattr(optimise_command, "print", stop, raising=False)
    command(f"optimise {folder / 'two.toml'} --out {folder / 'out'} {FOUR}", INTERRUPTED)
    front_of_two, _ = found(Problem.load(folder / "two.toml").sized(population=12, generations=2), folder / "two")
    assert set(pd.read_csv(folder / "out/front.csv")["run"]) == {row.run for row in front_of_two}
    assert not list((folder / "out").glob("*.part"))


# Ctrl-C while this design is evaluated, in the third generation of 12 designs
INTERRUPTED_AT = 28
WITH_CTRL_C = f"""
import os, signal, sys
from bevel_differential.command import main
from bevel_differential.optimise.design_task import DesignTask
evaluate = DesignTask.evaluate
def interrupted(task, run, values):
    if run == {INTERRUPTED_AT}:
        os.kill(os.getpid(), signal.SIGINT)
    return evaluate(task, run, values)
DesignTask.evaluate = interrupted
sys.exit(main(sys.argv[1:]))
"""


def test_an_interrupted_search_keeps_its_front_and_goes_on(folder, monkeypatch):
    given = f"optimise two.toml --out out {FOUR}"
    process = subprocess.run([sys.executable, "-c", WITH_CTRL_C, *given.split()], cwd=folder, capture_output=True, text=True,
                             timeout=60, preexec_fn=with_interrupts)
    errors = process.stderr
    assert "generation 2 of 4" in process.stdout and "generation 3" not in process.stdout
    assert process.returncode == 130 and "continue with --resume" in errors and "Traceback" not in errors
    before = pd.read_csv(folder / "out/front.csv")
    assert len(before) and len(pd.read_parquet(folder / "out/evaluations.parquet")) >= 2 * 8
    # another test covers files for CAD
    monkeypatch.setattr(cad, "available", lambda: False)
    monkeypatch.chdir(folder)
    assert "gears in out" in command(f"{given} --resume").out
    whole, _ = found(Problem.load(folder / "two.toml").sized(population=12, generations=4), folder / "whole")
    after = pd.read_csv(folder / "out/front.csv")
    assert set(after["run"]) <= {row.run for row in whole} and len(after) == min(64, len(whole))
    assert "the study's gears" in (folder / "out/choice.md").read_text(encoding="utf-8")
    assert (folder / "out/front.png").stat().st_size > 10_000


def test_chosen_designs_with_a_safety_factor_below_1_are_named():
    chosen = [DesignRow(k, {}, {"safety.root_min:final": safety, "gears.mass": 0.5}) for k, safety in enumerate((0.76, 1.02))]
    assert list(below_one(chosen)) == ["A: safety.root_min = 0.76 is below 1."]
