"""`LossMap`: a map from the file of `losses`, evaluated at any point."""

import re
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import DifferentialError, LossMap, Scene
from bevel_differential.losses import VARIABLES, inputs, losses
from bevel_differential.losses.grid import Bound, grid_points
from bevel_differential.losses.point import PointTask
from bevel_differential.losses.tables import save
from refusals import refused
from test_losses import DRAG, PRELOAD, STRIBECK_CLUTCH, over_kinetic

VALUES = STRIBECK_CLUTCH | DRAG
LEVELS = dict(zip(VARIABLES, ([-900.0, 900.0], [10.0, 40.0], [0.5, 15.0], [300.0, 350.0])))
TEMPERATURE = 330.0


@pytest.fixture(scope="module")
def measured(fmu_file):
    with Scene("clutch", set=VALUES, fmu=fmu_file) as scene:
        yield losses(scene, LEVELS, bound=Bound(0.002, 0.1), unseen=80, workers=0)


@pytest.fixture(scope="module")
def file(measured, tmp_path_factory):
    return save(measured, tmp_path_factory.mktemp("map") / "map.csv")


@pytest.fixture(scope="module")
def loaded(file):
    return LossMap.load(file)


@pytest.fixture(scope="module")
def backward(measured):
    """Coarse map of the same differential with a carrier that turns backward."""
    levels = {**LEVELS, VARIABLES[1]: [-40.0, -10.0]}
    return losses(measured.scene, levels, bound=Bound(10.0, 1000.0), unseen=0, workers=0)


def test_a_file_has_the_whole_map(measured, loaded, file):
    """Also as Parquet, and as a CSV file that a spreadsheet has saved with decimal commas."""
    commas = file.with_name("commas.csv")
    text = file.read_text(encoding="utf-8").splitlines()
    rows = [text[0].replace(",", ";"), *(line.replace(",", ";").replace(".", ",") for line in text[1:])]
    commas.write_text("\ufeff" + "\r\n".join(rows), encoding="utf-8")
    for found in (loaded, LossMap.load(save(measured, file.with_name("map.parquet"))), LossMap.load(commas)):
        assert all(np.array_equal(a, b) for a, b in zip(found.lines, measured.lines, strict=True))
        assert np.array_equal(found.slipping, measured.slipping) and np.array_equal(found.stuck, measured.stuck)
        worst = np.abs(found.at(measured.unseen) - measured.found).max(axis=0)
        assert found.error == (f"80 unseen points: the largest errors are {worst[0]:.2g} N.m at the left, {worst[1]:.2g} N.m at the right, "
                               f"and {worst[2]:.2g} W")


def test_points_of_the_map_are_reproduced(loaded):
    for values, sign in [*zip(loaded.slipping, (1.0, -1.0)), (loaded.stuck, 0.0)]:
        lines = loaded.lines if sign else (*loaded.lines[:2], [0.0], loaded.lines[3])
        torque, speed, difference, temperature = np.moveaxis(grid_points(lines) * [1.0, 1.0, sign or 1.0, 1.0], -1, 0)
        left, right = loaded.torques(torque, speed, difference, temperature)
        # 1e-12 of 900 N·m is rounding
        assert np.allclose(left, values[..., 0], rtol=1e-12, atol=1e-9) and np.allclose(right, values[..., 1], rtol=1e-12, atol=1e-9)
        assert np.allclose(loaded.loss(torque, speed, difference, temperature), values[..., 2], rtol=1e-12, atol=1e-8)


def test_between_its_points_the_map_has_the_error_that_it_states(measured, loaded):
    """Runs of the FMU at points that were not used for the map, and the closed form of clutches and drag."""
    task, draws = PointTask(measured.scene), np.random.default_rng(7)
    low, high = ([line[end] for line in loaded.lines] for end in (0, -1))
    for number in range(12):
        point = draws.uniform(low, high)
        point[2] *= -1.0 if number % 2 else 1.0
        if number > 9:
            point[2] = 0.0
        run = list(task.evaluate(0, inputs(point)).figures.values())[:3]
        found = np.array([*loaded.torques(*point), loaded.loss(*point)])
        assert np.all(np.abs(found - run) <= measured.bound.of_figures(np.array(run), point)), point
    task.close()
    for difference in (0.7, -3.0, 11.0):
        sides = 2.0 * 0.7 * 30.0 + 0.005 * sum((30.0 + 0.5 * sign * difference)**2 for sign in (1.0, -1.0))
        clutch = PRELOAD * over_kinetic(difference)
        expected = (2.0 + 0.02 * 30.0 + 1e-3 * 30.0**2) * 30.0 + sides + clutch * abs(difference)
        bound = measured.bound.of_figures(np.array([0.0, 0.0, expected]), np.array([500.0, 30.0, difference, TEMPERATURE]))[2]
        assert loaded.loss(500.0, 30.0, difference, TEMPERATURE) == pytest.approx(expected, abs=bound)


def test_loss_is_power_in_less_power_out(measured, loaded):
    draws = np.random.default_rng(3)
    points = draws.uniform(*([line[end] for line in loaded.lines] for end in (0, -1)), (200, 4))
    points[100:, 2] *= -1.0
    points[:20, 2] = 0.0
    torque, speed, difference, _ = points.T
    left, right = loaded.torques(*points.T)
    loss = loaded.loss(*points.T)
    balance = torque * speed - left * (speed + 0.5 * difference) - right * (speed - 0.5 * difference)
    bounds = measured.bound.of_figures(np.stack([left, right, loss], axis=-1), points)
    allowed = bounds[:, 2] + bounds[:, 0] * np.abs(speed + 0.5 * difference) + bounds[:, 1] * np.abs(speed - 0.5 * difference)
    assert np.all(np.abs(balance - loss) <= allowed)
    efficiency = loaded.efficiency(*points.T)
    fed = sum(np.maximum(power, 0.0) for power in (torque * speed, -left * (speed + 0.5 * difference), -right * (speed - 0.5 * difference)))
    assert np.allclose(efficiency * fed, fed - loss) and np.all(efficiency < 1.0)


def test_mirrored_points_have_mirrored_torques(measured, loaded, backward):
    """If all signs are negated, or left and right exchanged, torques and loss only change their signs and sides."""
    # points in both maps
    points = np.array([[900.0, 40.0, 15.0, 300.0], [-900.0, 10.0, -0.5, 350.0], [900.0, 10.0, 0.0, 300.0], [0.0, 40.0, 0.5, 350.0]])
    torque, speed, difference, temperature = points.T
    (left, right), loss = loaded.torques(*points.T), loaded.loss(*points.T)
    bound = 2.0 * measured.bound.of_figures(np.stack([left, right, loss], axis=-1), points).T
    mirrored, exchanged = ((torque * sign, speed * sign, -difference, temperature) for sign in (-1.0, 1.0))
    for of, axes, expected in ((backward, mirrored, (-left, -right)), (loaded, exchanged, (right, left))):
        for found, value, allowed in zip((*of.torques(*axes), of.loss(*axes)), (*expected, loss), bound):
            assert np.all(np.abs(found - value) <= allowed)


def test_numbers_give_numbers_and_arrays_are_broadcast(loaded):
    one = loaded.loss(500, 30, 5, TEMPERATURE)
    assert isinstance(one, float) and isinstance(loaded.efficiency(500, 30, 5, TEMPERATURE), float)
    assert all(isinstance(value, float) for value in loaded.torques(500, 30, 5, TEMPERATURE))
    table = loaded.loss([[500.0], [600.0]], 30.0, [5.0, -5.0, 0.0], TEMPERATURE)
    assert table.shape == (2, 3) and table[0, 0] == one == loaded.loss([500.0], 30.0, 5.0, TEMPERATURE)[0]
    assert loaded.loss([], 30.0, 5.0, TEMPERATURE).shape == (0,)
    # a value that is outside only by rounding is accepted
    assert loaded.loss(900.0 * (1.0 + 1e-12), 30.0, 5.0, TEMPERATURE) == loaded.loss(900.0, 30.0, 5.0, TEMPERATURE)
    with pytest.raises(DifferentialError, match="arrays of one shape"):
        loaded.loss([1.0, 2.0], [1.0, 2.0, 3.0], 5.0, TEMPERATURE)


@pytest.mark.parametrize("point, parts", [
    ((901.0, 30.0, 5.0, TEMPERATURE), "torque = 901 N.m … -900 to 900 N.m … --torque"),
    ((500.0, -41.0, 5.0, TEMPERATURE), "speed = -41 rad/s … 10 to 40 rad/s … --speed"),
    ((500.0, 30.0, -15.5, TEMPERATURE), "difference = -15.5 rad/s … 0, and 0.5 to 15 rad/s in both directions"),
    ((500.0, 30.0, 0.1, TEMPERATURE), "difference = 0.1 rad/s … 0, and 0.5 to 15 rad/s in both directions"),
    ((500.0, 30.0, 5.0, 80.0), "temperature = 80 K … 300 to 350 K … --temperature"),
    ((500.0, float("nan"), 5.0, TEMPERATURE), "speed = nan rad/s"),
    (([500.0, 1000.0, 2000.0], 30.0, 5.0, TEMPERATURE), "torque = 1000 N.m … (and 1 more)"),
])
def test_outside_the_map_the_axis_its_unit_and_range_are_reported(loaded, point, parts):
    for call in (loaded.torques, loaded.loss, loaded.efficiency):
        with refused(parts):
            call(*point)


@pytest.mark.parametrize("change, parts", [
    (lambda lines: [line for line in lines if not line.startswith("stuck")][:-1], "rows of the map are missing"),
    (lambda lines: [*lines[:5], *lines[6:]], "rows of the map are missing"),
    (lambda lines: [*lines, lines[5]], "doubled"),
    (lambda lines: [*lines[:4], lines[4].replace(",", ",x", 1), *lines[5:]], "line 5 … column carrier.torque … it is a number"),
    (lambda lines: [line.replace("power.loss", "loss") for line in lines], "no column power.loss … `losses --csv`"),
    (lambda lines: [lines[0], *(line for line in lines if line.startswith("unseen"))], "no rows of the kinds map and stuck"),
])
def test_a_file_that_is_not_a_map_is_refused(file, tmp_path, change, parts):
    changed = tmp_path / "changed.csv"
    changed.write_text("\n".join(change(file.read_text(encoding="utf-8").splitlines())), encoding="utf-8")
    with refused(f"changed.csv … {parts}"):
        LossMap.load(changed)


def test_a_missing_file_and_a_folder_are_reported(tmp_path):
    for name in ("none.csv", "none.parquet", ""):
        with pytest.raises(DifferentialError, match=str(tmp_path)):
            LossMap.load(tmp_path / name)


def test_the_example_of_the_page_runs(file, loaded, monkeypatch):
    page = Path(__file__).resolve().parents[2] / "docs" / "design.md"
    code = next(code for code in re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL) if "LossMap" in code)
    assert '"losses.csv"' in code
    monkeypatch.chdir(file.parent)
    found = {}
    exec(code.replace("losses.csv", file.name), found)
    assert found["loss"].shape == (3,) and found["loss"][1] == loaded.loss(800.0, 30.0, 5.0, 333.15)
    powers = [found["left"] * (30.0 + 2.5), found["right"] * (30.0 - 2.5)]
    assert found["efficiency"] == pytest.approx(sum(powers) / (800.0 * 30.0), rel=2e-3)
