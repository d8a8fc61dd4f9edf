"""Random scenes on the packaged FMU: each finishes in balance or is refused with a clear error.

None panics, hangs, accepts a step whose values are not numbers, or exceeds the allowed number of steps. The default is 200 scenes;
`python3 crates/lab/lab.py test-python -k random --scenes 10000` runs more."""

import collections

import numpy as np
import plausible_scenes
import pytest
import random_scenes
import scene_runs
from bevel_differential import DifferentialError
from sampling import latin, spread

SEED = 1
# number of failures that are shown with their whole scene
SHOWN = 5


def described(fmu, kind, count, index, record):
    """Text that reproduces a failure."""
    _, scene = next(random_scenes.scenes(fmu, kind, count, SEED, index, index + 1))
    return f"{kind} scene {index} of {count}: {record['problems']}\nlog: {record['log']}\nscene: {scene!r}\n"


@pytest.mark.parametrize("kind", random_scenes.KINDS)
def test_random_scenes_finish_in_balance_or_are_refused_with_a_clear_error(fmu, request, kind):
    count = max(request.config.getoption("--scenes") // len(random_scenes.KINDS), 1)
    verdicts, failures, balanced, compared = collections.Counter(), [], 0, 0
    for index, record in scene_runs.attempts(fmu.file, kind, count, SEED):
        verdicts[record["verdict"]] += 1
        balanced += record.get("balanced", False)
        compared += record.get("compared", 0)
        if record["verdict"] == "failed":
            failures.append((index, record))
    print(kind, dict(verdicts))
    shown = "\n".join(described(fmu, kind, count, *failure) for failure in failures[:SHOWN])
    assert not failures, f"{len(failures)} of {count} failed: {[index for index, _ in failures]}\n{shown}"
    assert sum(verdicts.values()) == count
    if kind == "plausible":
        assert verdicts["ran"] >= 0.5 * count, verdicts
        # nearly all of them with gears that momentum.py can weigh
        assert balanced >= 0.8 * verdicts["ran"], balanced
        # at the start and after each of some ten steps
        assert compared > 6 * count
    if kind == "wild" and count >= 10:
        assert verdicts["refused"] >= 0.5 * count, verdicts


def test_a_latin_hypercube_has_one_value_in_each_part_of_each_dimension():
    column = latin(50, np.random.default_rng(3))
    assert np.all(np.sort(np.floor(50 * column)) == np.arange(50))
    assert not np.all(np.floor(50 * column) == np.arange(50))


def test_values_are_spread_over_their_ranges_to_the_ends(fmu):
    for variable in random_scenes.free_variables(fmu):
        if variable.kind not in ("Real", "Integer"):
            continue
        (low, high), start = plausible_scenes.limits(variable), variable.start
        values = [random_scenes.wild_value(variable, u) for u in np.linspace(0.0, 1.0 - 1e-12, 101).tolist()]
        assert all(low <= value <= high for value in values), variable.name
        assert min(values) == pytest.approx(low, abs=1e-6 * (high - low)), variable.name
        assert max(values) == pytest.approx(high, rel=1e-3, abs=1e-6 * (high - low)), variable.name
        # the start value is not beyond nearly all drawn values
        assert start in (low, high) or min(values) < start < max(values), variable.name
    assert spread(0.5, 1e-3, 1e3, 1.0) == pytest.approx(1.0)


def test_the_printed_failure_reproduces_its_scene(fmu):
    again = [random_scenes.scenes(fmu, "bold", 20, SEED, 7, 8) for _ in range(2)]
    first, second = (next(scenes) for scenes in again)
    assert first == second
    assert eval(repr(first[1])) == first[1]


def test_a_process_that_crashes_or_hangs_is_reported_with_its_scene_and_the_next_one_runs(fmu, monkeypatch):
    crashed = list(scene_runs.attempts("no such folder", "wild", 2, SEED))
    assert [index for index, _ in crashed] == [0, 1]
    assert all("process ended with 1" in record["problems"][0] for _, record in crashed)
    # no answer within less time than the start needs
    monkeypatch.setattr(scene_runs, "PATIENCE", 1e-3)
    hung = list(scene_runs.attempts(fmu.file, "wild", 2, SEED))
    assert [record["verdict"] for _, record in hung] == ["failed", "failed"]
    assert all("no answer" in record["problems"][0] for _, record in hung)


def test_an_attempt_fails_that_is_out_of_balance_or_not_refused_by_name(fmu, monkeypatch):
    scenes = (scene for _, scene in random_scenes.scenes(fmu, "plausible", 20, SEED))
    attempts = ((scene, scene_runs.Attempt(fmu, scene)) for scene in scenes)
    # a scene whose rounding error leaves a small imbalance
    scene = next(scene for scene, attempt in attempts if attempt.verdict == "ran" and attempt.imbalance > 0.0)
    monkeypatch.setattr(scene_runs, "IMBALANCE", 0.0)
    out_of_balance = scene_runs.Attempt(fmu, scene)
    assert out_of_balance.verdict == "failed" and "energy residual" in out_of_balance.problems[0]
    scene["start"]["geometry.shaft_angle"] = 1.0
    monkeypatch.setattr(scene_runs.StatusInstance, "names_a_variable", lambda *_: False)
    nameless = scene_runs.Attempt(fmu, scene)
    assert nameless.verdict == "failed" and "refused with 3" in nameless.problems[0]


def test_plausible_clutches_have_all_kinds_of_torque_and_are_accepted(fmu):
    clutched = [scene["start"] for _, scene in random_scenes.scenes(fmu, "plausible", 150, SEED) if scene["start"]["effects.limited_slip"]]
    curve = "limited_slip.curve[1]"
    kinds = {"both sides": lambda start: start["limited_slip.pressed_by"] == 2,
             "coast": lambda start: start["limited_slip.coast_ratio"] != 1.0,
             "viscous": lambda start: start["limited_slip.viscous_torque"] > 0.0, "curve": lambda start: start[f"{curve}.slip"] > 0.0,
             "breakaway": lambda start: start[f"{curve}.slip"] == 0.0 and start[f"{curve}.torque"] > 0.0,
             "dry": lambda start: start["limited_slip.viscous_torque"] == start[f"{curve}.torque"] == 0.0}
    for name, is_kind in kinds.items():
        drawn = [start for start in clutched if is_kind(start)]
        assert drawn and (name == "coast" or len(drawn) < len(clutched)), name
    # gears may be refused, but never the clutches
    for start in clutched:
        with fmu.open() as instance:
            try:
                instance.initialise(start)
            except DifferentialError as refused:
                assert "limited_slip" not in str(refused)
