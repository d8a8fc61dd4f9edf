"""Manufacturing tolerances: grades of ISO 17485, closed forms of yield and Sobol indices, the FMU's gears, clear errors."""

import math

import numpy as np
import pytest
from command_line import command
from scipy import stats

from bevel_differential import DifferentialError, Scene
from bevel_differential.designs import Dimension, Farm, Row, Task
from bevel_differential.want import Statistic
from bevel_differential.tolerance.factor import Factor, Reader
from bevel_differential.tolerance.figures import Spread, gain, proportion, verdicts
from bevel_differential.tolerance.laws import Gear, Given, RunoutGrade, band, gears
from bevel_differential.tolerance.plan import Plan
from bevel_differential.tolerance.study import Alternative, Study
from bevel_differential.want import Condition, Want
from refusals import refused

TURN = {"scene.carrier_drive": "torque", "carrier.torque_command": "1670 N.m", "scene.left_drive": "speed",
        "scene.right_drive": "speed", "left.speed_command": 60.0, "right.speed_command": 40.0, "effects.thrust_friction": True,
        "effects.tooth_friction": True, "effects.tooth_errors": True, "contact.law": "line"}
MIRRORED = {**TURN, "left.speed_command": 40.0, "right.speed_command": 60.0}
FILE = """
description = "a turn"
scene = "turn.toml"
from = "20 ms"
runs = 8
wants = ["planet[1].left_transmission_error:peak_to_peak", "torque_bias_ratio:mean"]
limits = ["planet[1].left_transmission_error:peak_to_peak <= 60 um"]

[factors]
tooth_errors.accuracy_grade = "grade 7"
tooth_errors.seed = "seed"
tooth_errors.side_runout = "grade 7"
geometry.backlash = "0.1 mm +- 0.04 mm"
tooth_friction.coefficient = "triangular(0.04, 0.05, 0.07)"

[[alternative]]
tooth_errors.accuracy_grade = "coarser"
cost = -0.01

[[alternative]]
name = "smoother flanks"
tooth_friction.coefficient = "normal(0.03, 0.002)"
"""
SCENE = """
description = "a turn"
stop_time = "80 ms"
step = "1 ms"
outputs = ["torque_bias_ratio"]
[set]
""" + "\n".join(f"{name} = {str(value).lower() if isinstance(value, bool) else repr(value)}" for name, value in TURN.items())


class Formula:
    """A task that is a formula of the factors; it fails where `fails` is true."""

    def __init__(self, formula, fails=lambda values: False):
        self.formula, self.fails = formula, fails

    def evaluate(self, run, values):
        if self.fails(values):
            return Row(run, values, message="it does not run")
        return Row(run, values, {"y:final": self.formula(values)})


def want(name="y"):
    return Want(name, Statistic("final"))


def factor(name, kind, *numbers):
    return Factor(name, kind, Given(Dimension(name, kind, numbers)))


def result_of(study, task):
    with Farm(workers=0) as farm:
        return study.run(lambda designs: farm.evaluate(task, designs))


def ishigami(x):
    return math.sin(x["a"]) + 7.0 * math.sin(x["b"]) ** 2 + 0.1 * x["c"] ** 4 * math.sin(x["a"])


def total(x):
    return sum(x.values())


@pytest.fixture
def turn():
    with Scene(stop=0.12, set=TURN, outputs=["torque_bias_ratio"]) as scene:
        yield scene


@pytest.fixture
def files(tmp_path):
    (tmp_path / "turn.toml").write_text(SCENE, encoding="utf-8")
    file = tmp_path / "turns.toml"
    file.write_text(FILE, encoding="utf-8")
    return file


def test_tolerances_are_those_of_the_standard_s_equations():
    gear = Gear(diameter=0.1, module=5e-3, teeth=20)
    assert [1e6 * each(4) for each in (gear.cumulative_pitch, gear.runout)] == pytest.approx([23.0, 18.4])
    for of in (gear.cumulative_pitch, gear.runout):
        assert of(7) / of(6) == pytest.approx(math.sqrt(2.0)) and of(11) / of(2) == pytest.approx(2.0**4.5)


@pytest.mark.parametrize("shape", [
    {}, {"geometry.addendum_system": "standard"}, {"geometry.addendum_system": "iso23509"},
    {"geometry.addendum_system": "explicit", "geometry.planet_addendum": 1.2, "geometry.side_addendum": 0.7},
    {"geometry.planet_teeth": 14, "geometry.side_teeth": 12},
])
def test_runout_of_a_grade_is_that_of_the_fmu(shape, turn):
    turn.set({**shape, "tooth_errors.accuracy_grade": 8})
    pair = gears(turn)
    outputs = ["planet[1].left_transmission_error", "right.angle"]
    by_grade = turn.run(outputs, {"tooth_errors.runout_by_grade": True})
    given = turn.run(outputs, {f"tooth_errors.{kind}_runout": gear.runout(8) for kind, gear in pair.items()})
    other = turn.run(outputs, {f"tooth_errors.{kind}_runout": 1.001 * gear.runout(8) for kind, gear in pair.items()})
    for name in outputs:
        # the solver amplifies the last bit a little, while a thousandth of the tolerance has a hundred times the effect
        assert 100.0 * np.abs(given[name] - by_grade[name]).max() < np.abs(other[name] - by_grade[name]).max()


@pytest.mark.parametrize("capability, beyond", [(1.0, 2.6998e-3), (4.0 / 3.0, 6.334e-5)])
def test_draws_have_the_spread_of_tolerance_and_capability(capability, beyond):
    gear = Gear(diameter=0.05, module=3e-3, teeth=16)
    shares = (np.arange(20000) + 0.5) / 20000
    runout = RunoutGrade(7, gear, capability)
    # parts per million beyond ± 3 C_p standard deviations: tables of the normal distribution
    assert runout.at([1.0 - beyond])[0] == pytest.approx(gear.runout(7), rel=1e-4)
    # the eccentricity has two normal components, each with half of the runout
    scale = gear.runout(7) / math.sqrt(-2.0 * math.log(beyond))
    x, y = np.random.default_rng(5).normal(0.0, scale, (2, 4000))
    assert stats.ks_2samp(runout.at(shares), np.hypot(x, y)).pvalue > 0.05
    assert stats.ks_2samp(runout.at(shares), 1.1 * np.hypot(x, y)).pvalue < 1e-3
    finer = runout.graded(-1)
    assert np.divide(runout.at(shares), finer.at(shares)) == pytest.approx(math.sqrt(2.0))
    drawn = np.array(band("x", 2.0, 0.3, capability).at(shares))
    assert drawn.mean() == pytest.approx(2.0) and drawn.std() == pytest.approx(0.1 / capability, rel=1e-3)


def test_sobol_indices_of_ishigami_s_function_are_within_their_intervals():
    study = Study([factor(name, "uniform", -math.pi, math.pi) for name in "abc"], [want()], runs=2048)
    indices = result_of(study, Formula(ishigami)).indices["y:final"]
    # Ishigami and Homma 1990, with the coefficients 7 and 0.1
    eighth, tenth = math.pi**8, math.pi**4
    variance = 49.0 / 8.0 + 0.1 * tenth / 5.0 + 0.01 * eighth / 18.0 + 0.5
    first = np.array([0.5 * (1.0 + 0.1 * tenth / 5.0) ** 2, 49.0 / 8.0, 0.0]) / variance
    together = 8.0 * 0.01 * eighth / 225.0 / variance
    assert np.all(np.abs(indices.first - first) <= indices.first_half)
    assert np.all(np.abs(indices.total - first - [together, 0.0, together]) <= indices.total_half)
    assert np.all(indices.first_half < 0.15)


def test_sobol_indices_of_a_sum_are_the_parts_of_its_variance():
    factors = [factor(name, "normal", 5.0, deviation) for name, deviation in (("a", 1.0), ("b", 2.0), ("c", 4.0))]
    study = Study(factors, [want()], runs=1024)
    result = result_of(study, Formula(total))
    indices, parts = result.indices["y:final"], np.array([1.0, 4.0, 16.0]) / 21.0
    assert np.all(np.abs(indices.first - parts) <= indices.first_half)
    assert np.all(np.abs(indices.total - parts) <= indices.total_half)
    spread = Spread.of(result.base.figures["y:final"])
    assert spread.deviation.low < math.sqrt(21.0) < spread.deviation.high
    for share, quantile in spread.quantiles.items():
        assert quantile.low < stats.norm.ppf(share, 15.0, math.sqrt(21.0)) < quantile.high


def test_intervals_of_the_yield_contain_it_as_often_as_they_say():
    limit = Condition(want(), "<=", stats.norm.ppf(0.9, 0.0, 5.0))
    factors = [factor("a", "normal", 0.0, 3.0), factor("b", "normal", 0.0, 4.0)]
    studies = [Study(factors, [want()], [limit], runs=128, seed=seed, indices=False) for seed in range(60)]
    found = [proportion(result_of(study, Formula(total)).base.good) for study in studies]
    # 95 % of 60: at least 53 except in one case of a thousand
    assert sum(each.low <= 0.9 <= each.high for each in found) >= stats.binom.ppf(1e-3, 60, 0.95)
    assert np.mean([each.value for each in found]) == pytest.approx(0.9, abs=3.0 * 0.3 / math.sqrt(60 * 128))


@pytest.mark.parametrize("better, worse, cost", [(0.08, 0.03, 0.02), (0.02, 0.0, 0.0), (0.005, 0.005, -0.1), (0.3, 0.1, 0.5)])
def test_intervals_of_the_gain_contain_it_as_often_as_they_say(better, worse, cost):
    always, inside = 0.6, 0
    exact = better - worse - cost * (always + worse)
    for share in np.random.default_rng(3).random((1000, 128)):
        before, after = share < always + worse, (share < always) | (share >= 1.0 - better)
        found = gain(before, after, cost)
        inside += found.low <= exact <= found.high
    # at least 950 of 1000 except in one case of a thousand
    assert inside >= stats.binom.ppf(1e-3, 1000, 0.95)


def test_a_gain_remains_possible_if_no_run_changes():
    good = np.arange(64) < 50
    found = gain(good, good, 0.0)
    # rule of three: one-sided 95 % limit 3/64
    assert found.value == 0.0 and -found.low == found.high > 3.0 / 64.0


def alternatives_of_a_sum(cost):
    limits = [Condition(want(), "<=", 6.0), Condition(want(), ">=", -6.0)]
    a, b = factor("a", "normal", 0.0, 4.0), factor("b", "normal", 0.0, 1.0)
    others = [Alternative("a finer", {"a": factor("a", "normal", 0.0, 2.0)}, cost),
              Alternative("b finer", {"b": factor("b", "normal", 0.0, 0.99)}, cost)]
    return Study([a, b], [want()], limits, others, runs=1024)


def test_alternatives_are_drawn_at_the_same_shares_and_judged_by_their_cost():
    study = alternatives_of_a_sum(0.05)
    result = result_of(study, Formula(total))
    first = len(result.rows) - 2 * 1024
    base = [row for row, drawn in zip(result.rows[:first], study._shares()[1]) if drawn]
    for row, other in zip(base, result.rows[first:first + 1024]):
        assert other.values == {"a": pytest.approx(0.5 * row.values["a"]), "b": row.values["b"]}
    exact = [1.0 - 2.0 * stats.norm.sf(6.0, 0.0, math.hypot(a, b)) for a, b in ((4.0, 1.0), (2.0, 1.0))]
    best, other = verdicts(study, result)
    assert proportion(result.base.good).low < exact[0] < proportion(result.base.good).high
    assert best.yield_.low < exact[1] < best.yield_.high
    assert best.gain.low < exact[1] - 1.05 * exact[0] < best.gain.high
    assert (best.alternative.name, best.word) == ("a finer", "worth its money")
    indices = result.indices["y:final"]
    assert abs(indices.total[0] - 16.0 / 17.0) <= indices.total_half[0]
    assert f"in {100.0 * indices.total[0]:.0f} % of the variance of y:final" in best.line(0.85)
    assert (other.alternative.name, other.word) == ("b finer", "not worth its money")


@pytest.mark.parametrize("cost, words", [(0.5, ["not worth its money"] * 2), (None, ["raises the yield", "no change seen"])])
def test_a_tolerance_that_costs_too_much_is_not_worth_it(cost, words):
    study = alternatives_of_a_sum(cost)
    assert [verdict.word for verdict in verdicts(study, result_of(study, Formula(total)))] == words


def test_failed_runs_are_out_of_limits_and_leave_no_indices():
    factors = [factor("a", "uniform", 0.0, 1.0), factor("b", "uniform", 0.0, 1.0)]
    study = Study(factors, [want()], [Condition(want(), "<", 9.0)], runs=64)
    result = result_of(study, Formula(total, fails=lambda values: values["a"] < 0.25))
    failed = len(result.base.failures)
    assert failed == pytest.approx(16, abs=2)
    assert result.base.good.sum() == 64 - failed == np.isfinite(result.base.figures["y:final"]).sum()
    assert "runs failed" in result.indices["y:final"]
    assert Spread.of(result.base.figures["y:final"]).runs == 64 - failed


def test_a_result_that_is_not_a_number_is_out_of_limits():
    study = Study([factor("a", "uniform", -1.0, 1.0)], [want()], [Condition(want(), "<", 9.0)], runs=64)
    result = result_of(study, Formula(lambda x: math.sqrt(x["a"]) if x["a"] > 0.0 else math.nan))
    assert result.base.good.sum() == 32 and "runs failed" in result.indices["y:final"]


def test_without_tolerances_all_runs_are_nominal(turn):
    reader = Reader(turn)
    factors = [reader.read("geometry.backlash", "0.12 mm +- 0 mm"), reader.read("tooth_errors.side_runout", "20 um")]
    name = "planet[1].left_transmission_error"
    study = Study(factors, [want(name)], runs=8)
    result = result_of(study, Task(turn, study.wants))
    nominal = turn.final([name], {"geometry.backlash": "0.12 mm", "tooth_errors.side_runout": "20 um"})[name]
    assert np.all(result.base.figures[f"{name}:final"] == nominal)
    spread = Spread.of(result.base.figures[f"{name}:final"])
    assert (spread.mean.value, spread.deviation.value, spread.deviation.high) == (nominal, 0.0, 0.0)
    assert "does not vary" in result.indices[f"{name}:final"]


def transmission_errors(values, side, grade):
    with Scene(stop=0.08, set=values, outputs=["left.speed"]) as scene:
        reader = Reader(scene)
        graded = ("accuracy_grade", "planet_runout", "side_runout")
        factors = [*(reader.read(f"tooth_errors.{name}", f"grade {grade}") for name in graded),
                   reader.read("tooth_errors.seed", "seed")]
        wanted = Want.parse(scene.fmu, f"planet[1].{side}_transmission_error:peak_to_peak")
        study = Study(factors, [wanted], runs=32, indices=False)
        return result_of(study, Task(scene, study.wants, start=0.02)).base.figures[str(wanted)]


def test_mirror_images_have_the_same_spread():
    left, right = transmission_errors(TURN, "left", 7), transmission_errors(MIRRORED, "right", 7)
    assert not np.array_equal(left, right)
    assert stats.ks_2samp(left, right).pvalue > 0.05
    assert stats.ks_2samp(left, transmission_errors(MIRRORED, "right", 10)).pvalue < 1e-4


def test_a_file_gives_the_same_results_with_any_workers_and_plausible_ones(files):
    plan = Plan.load(files)
    results = []
    for workers in (0, 2):
        with Farm(workers=workers) as farm:
            results.append(plan.run(farm))
    alone, together = ([(row.run, row.values, row.figures) for row in result.rows] for result in results)
    assert alone == together
    base, (coarser, smoother) = results[0].base, results[0].others
    error, bias = map(str, plan.study.wants)
    assert not base.failures
    # in each pair of runs, coarser teeth have a larger error and less friction gives less bias
    assert np.all(coarser.figures[error] > base.figures[error])
    assert np.all(smoother.figures[bias] < base.figures[bias])
    assert coarser.good.sum() <= base.good.sum()
    indices = results[0].indices[bias]
    assert np.argmax(indices.total) == results[0].names.index("tooth_friction.coefficient")


def test_the_command_prints_and_writes_all(files, tmp_path):
    picture, runs = tmp_path / "a.png", tmp_path / "a.csv"
    printed = command(f"tolerance {files} --workers 0 --plot {picture} --csv {runs}").out
    for part in ("8 differentials drawn, 0 of them failed", "tooth_errors.seed", "all: yield", "smoother flanks", "as it is"):
        assert part in printed
    assert picture.read_bytes().startswith(b"\x89PNG")
    # four factors vary: 4 (4 + 2) runs of the Sobol scheme, and 8 of each alternative
    assert len(runs.read_text(encoding="utf-8").splitlines()) == 1 + 24 + 16


@pytest.mark.parametrize("old, new, parts", [
    ("geometry.backlash =", "geometry.backslash =", "[factors] … geometry.backslash … did you mean geometry.backlash"),
    ("+- 0.04 mm", "+- -0.04 mm", "geometry.backlash … negative"),
    ("+- 0.04 mm", "+- 0.2 mm", "geometry.backlash … draws are outside 0 mm to 50 mm … narrower"),
    ("+- 0.04 mm", "+- 0.04 kg", "geometry.backlash … unit kg of"),
    ("accuracy_grade = \"grade 7\"", "accuracy_grade = \"grade 12\"", "accuracy_grade … grade 12 … 2 (finest) to 11"),
    ("side_runout = \"grade 7\"", "side_runout = \"grade 1\"", "tooth_errors.side_runout … grade 1 … 2 (finest) to 11"),
    ("side_runout = \"grade 7\"", "side_runout = \"grade 6.5\"", "tooth_errors.side_runout … whole number"),
    ("\"0.1 mm +- 0.04 mm\"", "\"grade 7\"", "geometry.backlash … no accuracy grade"),
    ("limits = [\"planet[1].left", "limits = [\"planet[1].right", "right_transmission_error … is not wanted"),
    ("triangular(0.04, 0.05, 0.07)", "triangular(0.08, 0.05, 0.07)", "tooth_friction.coefficient … do not define a distribution"),
    ("\"coarser\"", "\"grade 12\"", "[[alternative]] … grade 12"),
    ("accuracy_grade = \"coarser\"", "seed = \"finer\"", "tooth_errors.seed … whole numbers"),
    ("accuracy_grade = \"coarser\"", "crowning = \"finer\"", "tooth_errors.crowning … not one of the factors"),
    ("tooth_friction.coefficient = \"tri", "tooth_friction.law = \"tri", "tooth_friction.law … only real"),
    ("triangular(0.04, 0.05, 0.07)", "lognormal(0.05, much)", "tooth_friction.coefficient … much"),
    ("[factors]", "factors = 7\n[other]", "factors = 7: it is a table"),
    ("wants = [", "wants = [7, ", "wants: it contains only texts"),
    ("cost = -0.01", "cost = \"cheap\"", "[[alternative]] … cost … fraction of the price"),
    ("runs = 8", "runs = 20", "runs = 20 … power of two"),
    ("runs = 8", "seed = -1", "seed = -1"),
    ("runs = 8", "capability = 0", "capability = 0"),
    ("runs = 8", "rums = 8", "rums … did you mean runs"),
    ("runs = 8", "set.effects.tooth_errors = false", "tooth_errors. … has a tolerance, but … effects.tooth_errors = true"),
    ("runs = 8", "set.tooth_errors.runout_by_grade = true", "tooth_errors.side_runout … runout_by_grade"),
    ("[factors]", "[factors.more]", "more.tooth_errors … no such variable"),
])
def test_errors_in_a_file_are_named(old, new, parts, files):
    text = files.read_text(encoding="utf-8")
    assert old in text
    files.write_text(text.replace(old, new, 1), encoding="utf-8")
    with refused(f"{files.name} … {parts}"):
        Plan.load(files)


def test_a_wrong_factor_is_one_error_also_where_an_alternative_names_it(files):
    files.write_text(FILE.replace("accuracy_grade = \"grade 7\"", "accuracy_grade = \"grade 12\""), encoding="utf-8")
    with pytest.raises(DifferentialError) as error:
        Plan.load(files)
    assert len(str(error.value).splitlines()) == 1


def test_gears_that_do_not_vary_are_noted(files):
    files.write_text(FILE.replace("tooth_errors.seed = \"seed\"", ""), encoding="utf-8")
    assert "all gears have the same teeth" in Plan.load(files).notes[0]
