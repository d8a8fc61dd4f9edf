"""Variation, plans of designs, and the figures by which a run is judged."""

import numpy as np
import pytest
from scipy import stats

from bevel_differential import DifferentialError, Fmu, Scene
from bevel_differential.designs import Space, Task
from bevel_differential.designs.plan import Plan
from bevel_differential.want import Condition, Statistic, Want
from refusals import refused

SEEDS = {"tooth_errors.seed": "seed"}
VARIED = {"left.load_torque": "700 N.m..900 N.m", "contact.law": "line, line_weber", "geometry.planet_teeth": "8..11", **SEEDS}


@pytest.fixture(scope="module")
def fmu(fmu_file):
    return Fmu.of(fmu_file)


@pytest.fixture
def plan(fmu):
    return lambda vary, *given: Plan.parse(Space.parse(fmu, vary), *given)


def values(plan, name):
    return np.array([design[name] for _, design in plan.designs()])


def test_a_grid_has_all_combinations_once(plan):
    grid = plan({"left.load_torque": "700 N.m..900 N.m:3", "contact.law": "line, line_weber", "geometry.planet_teeth": "8..10"},
                "grid")
    expected = [{"left.load_torque": torque, "contact.law": law, "geometry.planet_teeth": teeth}
                for torque in (700.0, 800.0, 900.0) for law in (2, 3) for teeth in (8, 9, 10)]
    assert grid.designs() == list(enumerate(expected)) and grid.runs == 18


def test_levels_of_a_grid_have_no_rounding_errors(plan):
    levels = values(plan({"limited_slip.torque_coefficient": "0.02..0.12:6"}, "grid"), "limited_slip.torque_coefficient")
    assert levels.tolist() == [0.02, 0.04, 0.06, 0.08, 0.1, 0.12]


def test_a_latin_hypercube_has_one_value_in_each_slice(plan):
    torques = values(plan(VARIED, "lhs", 50, 3), "left.load_torque")
    assert sorted(np.floor((torques - 700.0) / 4.0).astype(int)) == list(range(50))


def test_sobol_runs_are_a_power_of_two_and_fill_evenly(plan):
    sobol = plan(VARIED, "sobol", 20, 3)
    slices = np.floor((values(sobol, "left.load_torque") - 700.0) / 200.0 * 32).astype(int)
    assert sobol.runs == 32 and sorted(slices) == list(range(32))
    assert np.bincount(values(sobol, "geometry.planet_teeth"))[8:].tolist() == [8, 8, 8, 8]


def test_random_designs_do_not_depend_on_how_many_there_are(plan):
    few, many = plan(VARIED, "random", 10, 5).designs(), plan(VARIED, "random", 1000, 5).designs()
    assert few == many[:10]
    assert few != plan(VARIED, "random", 10, 6).designs()


@pytest.mark.parametrize("kind", ["grid", "lhs", "sobol", "random"])
def test_seeds_of_a_run_follow_only_from_the_plan_s_seed_and_the_run(plan, kind):
    alone = values(plan(SEEDS, "random", 64, 7), "tooth_errors.seed")
    others = {"geometry.planet_teeth": "8, 9", "geometry.side_teeth": "14, 16"}
    among = values(plan({**others, **SEEDS}, kind, None if kind == "grid" else 4, 7), "tooth_errors.seed")
    assert among.tolist() == alone[:4].tolist() and len(set(alone)) == 64
    assert alone.min() < 0 < alone.max(), "the whole range of the FMU's seed"


@pytest.mark.parametrize("given, distribution", [
    ("normal(4.5 mm, 0.1 mm)", stats.norm(4.5e-3, 1e-4)),
    ("uniform(4 mm, 5 mm)", stats.uniform(4e-3, 1e-3)),
    ("triangular(4 mm, 4.2 mm, 5 mm)", stats.triang(0.2, 4e-3, 1e-3)),
    ("lognormal(4.5 mm, 1.1)", stats.lognorm(np.log(1.1), scale=4.5e-3)),
])
def test_drawn_values_have_their_distribution(plan, given, distribution):
    drawn = values(plan({"geometry.module": given}, "random", 2000, 1), "geometry.module")
    # 1e-4: one test in ten thousand would fail by chance, but this draw is always the same
    assert stats.kstest(drawn, distribution.cdf).pvalue > 1e-4


def test_a_share_of_zero_has_a_finite_value(fmu):
    space = Space.parse(fmu, {"geometry.module": "normal(4.5 mm, 0.1 mm)", "left.load_torque": "lognormal(800 N.m, 1.2)"})
    assert np.isfinite(list(space.at([[0.0, 0.0]])[0].values())).all()


@pytest.mark.parametrize("vary, arguments, parts", [
    ({"left.load_torqe": "1..2"}, ("random", 5), "left.load_torqe … did you mean left.load_torque"),
    ({"left.speed": "1..2"}, ("random", 5), "left.speed … cannot be varied"),
    ({"left.load_torque": "900 N.m..700 N.m"}, ("random", 5), "left.load_torque … range"),
    ({"left.load_torque": "7 ft..9 ft"}, ("random", 5), "left.load_torque … unit ft of"),
    ({"left.load_torque": "normal(1)"}, ("random", 5), "normal needs 2 numbers"),
    ({"left.load_torque": "normal(1, -1)"}, ("random", 5), "do not define a distribution"),
    ({"left.load_torque": "lognormal(1, 1 N.m)"}, ("random", 5), "1 N.m … not a plain number"),
    ({"left.load_torque": "1..2:one"}, ("grid",), "2 values or more"),
    ({"left.load_torque": "1..2"}, ("grid",), "left.load_torque … FROM..TO:11"),
    ({"left.load_torque": "normal(1, 1)"}, ("grid",), "left.load_torque … grid"),
    ({"contact.law": "lin"}, ("random", 5), "contact.law … did you mean line"),
    ({"contact.law": "1..2"}, ("random", 5), "contact.law"),
    ({"left.load_torque": "seed"}, ("random", 5), "left.load_torque … whole numbers"),
    ({"left.load_torque": "1..2:4"}, ("grid", 5), "4 runs, not 5"),
    ({"left.load_torque": "1..2"}, ("lhs",), "number of runs"),
    ({"left.load_torque": "1..2"}, ("lhs", 0), "number of runs"),
    ({"left.load_torque": "1..2"}, ("sobl", 4), "sobl … did you mean sobol"),
    ({"left.load_torque": "1..2"}, ("random", 4, -1), "seed … -1"),
    ({}, ("random", 4), "nothing varies"),
])
def test_an_invalid_plan_gives_the_reason(plan, vary, arguments, parts):
    with refused(parts):
        plan(vary, *arguments).designs()


# a wave with a mean, 3 whole periods of 0.25 s, with unequal steps so fine that the trapezoidal rule is exact to 1e-5
TIMES = np.sort(np.concatenate([np.linspace(0.0, 0.75, 30001), np.linspace(0.5, 0.75, 7777)[1:-1]]))
WAVE = 2.0 + 3.0 * np.sin(2.0 * np.pi * TIMES / 0.25 + 0.4)


@pytest.mark.parametrize("word, expected", [
    ("final", 2.0 + 3.0 * np.sin(0.4)), ("mean", 2.0), ("rms", np.sqrt(4.0 + 4.5)), ("min", -1.0), ("max", 5.0),
    ("peak_to_peak", 6.0), ("p2p", 6.0), ("time_of_peak", 0.5 + 0.25 * (0.25 - 0.4 / (2.0 * np.pi))),
])
def test_statistics_of_a_wave_are_those_of_its_formula(word, expected):
    assert Statistic.parse(word).of(TIMES, WAVE) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("word, expected", [("mesh_order_1", 3.0), ("mesh_order_2", 0.5), ("order_3_of_mesh", 0.0)])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_orders_are_amplitudes_over_the_last_whole_periods(word, expected, sense):
    # 3.3 periods, of which 3 count
    phase = np.linspace(0.0, 6.6 * np.pi, 20001)
    wave = 2.0 + 3.0 * np.sin(phase) + 0.5 * np.cos(2.0 * phase)
    assert Statistic.parse(word).of(phase, wave, sense * phase) == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("phase, message", [
    (np.linspace(0.0, 6.0, 100), "less than one period"), (np.linspace(0.0, 63.0, 30), "times smaller"),
    (20.0 * np.sin(np.linspace(0.0, 1.8, 999)), "to and fro"),
])
def test_an_order_that_cannot_be_counted_gives_the_reason(phase, message):
    with pytest.raises(DifferentialError, match=message):
        Statistic.parse("mesh_order_1").of(phase, phase, phase)


@pytest.mark.parametrize("text, parts", [
    ("left.sped", "left.sped … did you mean left.speed"), ("left.speed:meen", "meen … did you mean mean"),
    ("left.lod_torque:mean", "did you mean left.load_torque"), ("left.speed:mesh_order_0", "mesh_order_0"),
])
def test_an_invalid_want_gives_the_reason(fmu, text, parts):
    with refused(parts):
        Want.parse(fmu, text)


def test_an_order_may_be_written_in_words():
    assert Statistic.parse("order 2 of shaft") == Statistic("shaft_order_2", "carrier.angle")


def test_conditions_have_units_and_report_the_size_of_a_violation(fmu):
    condition = Condition.parse(fmu, "left.speed:max <= 180 deg/s")
    assert condition.holds(3.14) and not condition.holds(3.15)
    assert condition.excess(1.1 * np.pi) == pytest.approx(0.1) and condition.excess(0.9 * np.pi) == pytest.approx(-0.1)
    with refused("safety.root_min >= 1.2"):
        Condition.parse(fmu, "left.speed = 3")


def test_figures_of_a_task_count_from_its_start_on():
    with Scene.load("study_turning") as scene:
        row = Task(scene, ["left.speed:mean", "planet[1].left_transmission_error:mesh_order_1"], start=0.14).evaluate(0, {})
        record = scene.run(["left.speed"])
    later = record[record["time"] > 0.1395]
    expected = np.trapezoid(later["left.speed"], later["time"]) / (later["time"][-1] - later["time"][0])
    assert row.message == "" and row.figures["left.speed:mean"] == pytest.approx(expected, rel=1e-12)
    assert row.figures["planet[1].left_transmission_error:mesh_order_1"] > 0.0


def test_a_design_that_fails_is_a_row_and_the_next_one_runs():
    with Scene.load("study_turning") as scene:
        task = Task(scene, ["left.speed"], ["left.speed >= 0 rad/s"])
        good = task.evaluate(0, {})
        bad = task.evaluate(1, {"geometry.module": -1.0})
        again = task.evaluate(2, {})
    assert "geometry.module" in bad.message and bad.figures == {} and not bad.feasible
    assert again.figures == good.figures and again.feasible
