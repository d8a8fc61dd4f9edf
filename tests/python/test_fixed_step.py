"""The method with fixed steps: stable in all tooth contacts, and of order 2 if the motion is smooth."""

import numpy as np
import pytest
import theory
from driving import CARRIER, SIDES, TURN

STRAIGHT = {}
SCENES = {"straight": STRAIGHT, "turn": TURN}
OUTPUTS = [f"{side}.speed" for side in SIDES] + [f"planet[1].{side}_normal_force" for side in SIDES]


def record(drive, values, size, stop=0.4):
    """Outputs every 10 ms, with fixed steps of `size` or, if it is 0 or None, with a tolerance of 1e-9."""
    method = {"solver.method": "fixed_step", "solver.fixed_step": size} if size else {"solver.relative_tolerance": 1e-9}
    driven, rows = drive(values | method), []
    driven.to(stop, 1e-2, lambda d: rows.append(d.read(OUTPUTS)))
    return np.array(rows), driven


def errors(rows, reference):
    """Largest errors of speed and force, each relative to the largest value."""
    off = np.abs(rows - reference)
    return [off[:, part].max() / np.abs(reference[:, part]).max() for part in (slice(0, 2), slice(2, 4))]


@pytest.mark.parametrize("start", ["equilibrium", "rolling", "rest"])
@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("size", [1e-3, 1e-4])
def test_the_study_s_gears_settle_to_the_right_motion_from_every_start(drive, scene, start, size):
    values = SCENES[scene] | {"scene.start": start}
    reference, _ = record(drive, values, None)
    rows, driven = record(drive, values, size)
    # impacts have ended after 0.1 s; with a step of 1 ms, a load transfer between tooth pairs then takes some five steps
    speed, force = errors(rows[10:], reference[10:])
    assert speed < 1e-3 and force < 1e-3
    # no speed that gears without teeth would not have, except the rebound of an impact
    assert np.abs(rows[:, :2]).max() < 1.5 * CARRIER
    # every requested step is one step
    assert driven["solver.steps"] == round(0.4 / size) and driven["solver.rejected"] == 0.0


def test_errors_fall_with_the_square_of_the_step(drive):
    values = TURN | {"scene.start": "equilibrium"}
    reference, _ = record(drive, values, None, 0.1)
    coarse, fine = (errors(record(drive, values, size, 0.1)[0], reference)[0] for size in (4e-4, 1e-4))
    # steps that are four times finer are sixteen times more accurate, unless a kink is within a step
    assert fine < coarse / 8.0


@pytest.mark.parametrize("size", [1e-3, 1e-4])
def test_suddenly_reversed_loads_move_to_the_other_flanks(drive, size):
    driven = drive({"solver.method": "fixed_step", "solver.fixed_step": size, "scene.start": "rolling"}).to(0.05, 1e-3)
    for sign in [-1.0, 1.0, -1.0]:
        driven.load(sign * theory.LOAD)
        driven.to(driven.time + 0.1, 1e-3)
        for side in SIDES:
            assert driven[f"{side}.speed"] == pytest.approx(CARRIER, rel=1e-6)
            assert driven[f"{side}.tangential_force"] == pytest.approx(sign * theory.TANGENTIAL_FORCE, rel=1e-6)
