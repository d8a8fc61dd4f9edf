"""Dry friction at zero crossings of the speed: it sticks, slips, and takes few steps."""

from math import pi, sin

import numpy as np
import pytest
import theory
from driving import UNDAMPED

CLUTCH = {"effects.limited_slip": True, "limited_slip.preload": 100.0, "limited_slip.torque_coefficient": 0.0,
          "inertia.left_end": 0.5, "inertia.right_end": 0.5}
# Allowed integrator steps for a half-cycle of the load, in addition to one for each communication step. The clutch sticks and
# breaks loose once. After both, the step size grows again from that of the event, and an excited mesh rings; each takes some tens
# of steps, but chatter takes hundreds. With rolling gears, some teeth also pass.
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
    # it slides in both directions, and it sticks
    assert max(speeds) > 1.0 and min(speeds) < -1.0
    assert 0 < np.count_nonzero(held) < len(held)
    # it sticks and breaks loose once in each half-cycle, without chatter; with rolling teeth one side may break loose before the other
    changes = np.count_nonzero(np.diff(held))
    assert changes <= (4.0 if contact == "tooth" else 2.0) * halves
    assert scene.work()[0] < PER_HALF_CYCLE[contact] * halves + duration / step
    assert scene.imbalance() < UNDAMPED
    assert scene["heat.clutch"] > 1.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("step", [1e-3, 1e-2])
def test_a_clutch_that_is_crossed_under_far_more_than_it_holds_turns_round_without_chatter(drive, contact, step):
    halves, work = 20, []
    # the same oscillation without a clutch shows the number of steps that rolling gears need
    for clutch in [{"limited_slip.preload": 10.0}, {"effects.limited_slip": False}]:
        scene = drive(CLUTCH | {"scene.gear_contact": contact} | clutch)
        speeds = []
        for half in range(halves):
            sign = 1.0 if half % 2 == 0 else -1.0
            scene.load(theory.LOAD + sign * 400.0, theory.LOAD - sign * 400.0)
            # a half interval first, so that the speed oscillates about zero
            scene.to(scene.time + (0.03 if half == 0 else 0.06), step)
            speeds.append(scene["left.speed"] - scene["right.speed"])
        assert min(speeds) < -1.0 and max(speeds) > 1.0
        work.append(scene.work()[0])
    assert work[0] < 1.5 * work[1] + CROSSING * halves
    assert scene.imbalance() < UNDAMPED


@pytest.mark.parametrize("load", [0.5, -2.4, -5.0])
def test_washers_of_gears_that_rattle_stick_and_slip_without_a_long_search(drive, load):
    # nearly unloaded side gears bounce in their backlash: the friction of their washers comes and goes, and their speed reverses
    scene = drive({"scene.gear_contact": "lumped", "scene.start": "equilibrium", "scene.planet_spin": "imposed",
                   "effects.thrust_friction": True, "carrier.speed_command": 18.75, "spin.command": 0.025,
                   "left.load_torque": 5.5, "right.load_torque": 5.5})
    scene.to(0.05, 1e-2)
    scene.load(load, load)
    steps, rejected = scene["solver.steps"], scene["solver.rejected"]
    scene.to(0.1, 5e-3)
    # a switch is located by some halvings of a step, and each switch begins with a few steps
    assert scene["solver.rejected"] - rejected < 5.0 * (scene["solver.steps"] - steps)
    assert scene["heat.thrust"] > 0.0
