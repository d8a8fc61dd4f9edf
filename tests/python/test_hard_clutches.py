"""Dry friction at crossing speed: sticks, slips, and takes few steps about it."""

from math import pi, sin

import numpy as np
import pytest
import theory
from driving import UNDAMPED

CLUTCH = {"effects.limited_slip": True, "limited_slip.preload": 100.0, "limited_slip.torque_coefficient": 0.0,
          "inertia.left_end": 0.5, "inertia.right_end": 0.5}
# integrator steps allowed for a half-cycle of the load, besides one for each communication step. It sticks and breaks
# loose once; after either the step size grows again from that of the landing, and a mesh that was shaken rings: some
# tens of steps each, where chatter takes them by the hundred. Gears that roll pass some teeth besides.
PER_HALF_CYCLE = {"ideal": 100.0, "lumped": 100.0, "tooth": 400.0}
CROSSING = 100.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("static_ratio", [1.0, 1.5])
@pytest.mark.parametrize("step", [1e-3, 1e-2])
def test_a_clutch_at_crossing_speed_sticks_and_slips_in_a_bounded_number_of_steps(drive, contact, static_ratio, step):
    frequency, duration = 10.0, 1.0
    scene = drive(CLUTCH | {"scene.gear_contact": contact, "limited_slip.static_ratio": static_ratio})
    held, speeds = [], []

    def swing(s):
        difference = 160.0 * sin(2.0 * pi * frequency * s.time)
        s.load(theory.LOAD + difference, theory.LOAD - difference)
        held.append(s["held.sides"])
        speeds.append(s["left.speed"] - s["right.speed"])

    scene.to(duration, step, swing)
    halves = 2.0 * frequency * duration
    # it does slide, both ways, and it does stick
    assert max(speeds) > 1.0 and min(speeds) < -1.0
    assert 0 < np.count_nonzero(held) < len(held)
    # once stuck and once loose in each half-cycle: no chatter; teeth that roll may let go of one side before the other
    changes = np.count_nonzero(np.diff(held))
    assert changes <= (4.0 if contact == "tooth" else 2.0) * halves
    assert scene.work()[0] < PER_HALF_CYCLE[contact] * halves + duration / step
    assert scene.imbalance() < UNDAMPED
    assert scene["heat.clutch"] > 1.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("step", [1e-3, 1e-2])
def test_a_clutch_that_is_crossed_under_far_more_than_it_holds_turns_round_without_chatter(drive, contact, step):
    halves, work = 20, []
    # the same oscillation without a clutch shows the steps that rolling gears need
    for clutch in [{"limited_slip.preload": 10.0}, {"effects.limited_slip": False}]:
        scene = drive(CLUTCH | {"scene.gear_contact": contact} | clutch)
        speeds = []
        for half in range(halves):
            sign = 1.0 if half % 2 == 0 else -1.0
            scene.load(theory.LOAD + sign * 400.0, theory.LOAD - sign * 400.0)
            # a half first, so that the speed swings about zero
            scene.to(scene.time + (0.03 if half == 0 else 0.06), step)
            speeds.append(scene["left.speed"] - scene["right.speed"])
        assert min(speeds) < -1.0 and max(speeds) > 1.0
        work.append(scene.work()[0])
    assert work[0] < 1.5 * work[1] + CROSSING * halves
    assert scene.imbalance() < UNDAMPED


@pytest.mark.parametrize("load", [0.5, -2.4, -5.0])
def test_washers_of_gears_that_rattle_stick_and_slip_without_a_long_search(drive, load):
    # hardly loaded side gears bounce in their backlash: what holds their washers comes and goes, and their speed turns round
    scene = drive({"scene.gear_contact": "lumped", "scene.start": "equilibrium", "scene.planet_spin": "imposed",
                   "effects.thrust_friction": True, "carrier.speed_command": 18.75, "spin.command": 0.025,
                   "left.load_torque": 5.5, "right.load_torque": 5.5})
    scene.to(0.05, 1e-2)
    scene.load(load, load)
    steps, rejected = scene["solver.steps"], scene["solver.rejected"]
    scene.to(0.1, 5e-3)
    # a switch is found by some halvings of a step, each switch begins a few steps
    assert scene["solver.rejected"] - rejected < 5.0 * (scene["solver.steps"] - steps)
    assert scene["heat.thrust"] > 0.0
