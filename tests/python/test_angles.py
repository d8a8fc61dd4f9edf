"""Angles are the integrals of speeds, over every communication step of random scenes, with every method.

Scenes with teeth are run again with communication points at round times, as used by hosts, and with a tooth that breaks at
one of them."""

import numpy as np
import plausible_scenes
import pytest
import random_scenes
from bevel_differential import DifferentialError
from integrals import Walk, motions

SEED, SCENES = 11, 8
METHODS = ["adaptive", "fixed_step", "radau"]
TOLERANCE = 1e-8
# factor by which scenes with fixed steps are shorter, because these steps do not grow
SHORT = {"fixed_step": 0.1}
FIXED = 1e-6
# number of points of a scene at round times, and their distances [s]; each scene has two of these distances
POINTS, ROUND = 12, [1e-4, 2e-4, 5e-4, 1e-3]
TOOTH, EQUILIBRIUM = 3, 1


def scenes(fmu, method):
    """Yields (index, start, steps) for a method: plausible scenes, then those with teeth at round times, with a tooth that breaks."""
    number = 1 + METHODS.index(method)
    short = SHORT.get(method, 1.0)
    for index, scene in random_scenes.scenes(fmu, "plausible", SCENES * len(METHODS), SEED):
        if index % len(METHODS) + 1 != number:
            continue
        # a lock follows its actuator at communication points, too, so its motion depends on them
        start = scene["start"] | {"solver.method": number, "solver.relative_tolerance": TOLERANCE, "solver.fixed_step": FIXED,
                                  "lock.stroke_time": 0.0, "lock.response_time": 0.0}
        if start["scene.start"] == plausible_scenes.STEADY_HEAT:
            # at this tolerance the heat cycles exceed the maximum number of steps, so the start would be refused after seconds
            start["scene.start"] = EQUILIBRIUM
        yield index, start, [(short * size, inputs) for size, inputs in scene["steps"]]
        random = np.random.default_rng([SEED, index])
        for size in random.choice(ROUND, 2, replace=False) if start["scene.gear_contact"] == TOOTH else []:
            onset = int(random.integers(2, POINTS - 1)) * short * size
            fault = {"effects.tooth_fault": True, "tooth_fault.at_onset": True, "tooth_fault.onset": onset}
            yield index, start | fault, [(short * size, {})] * POINTS


@pytest.mark.parametrize("method", METHODS)
def test_angles_are_the_integrals_of_speeds_over_every_communication_step(fmu, method):
    pairs = [((position,), rate) for position, rate in motions(fmu)]
    steps, turned = 0, 0.0
    for index, start, schedule in scenes(fmu, method):
        with fmu.open() as opened:
            try:
                opened.initialise(start)
            except DifferentialError:
                continue
            walk = Walk(opened, pairs, TOLERANCE, FIXED if method == "fixed_step" else None)
            for k, (size, inputs) in enumerate(schedule):
                opened.set(inputs)
                begin = opened.time
                try:
                    wrong = walk.step(size)
                except DifferentialError:
                    # the step failed; test_random_scenes.py covers failures
                    break
                steps += 1
                assert not wrong, f"scene {index}, step {k} from {begin} s by {size} s: {wrong}"
            turned += abs(opened.get("carrier.angle"))
    assert steps > 100 and turned > 0.1 * SHORT.get(method, 1.0)
