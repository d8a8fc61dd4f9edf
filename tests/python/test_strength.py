"""Stresses at the pitch point, and damage by Miner's rule."""

from math import log, pi

import numpy as np
import pytest
import theory
from driving import STEADY_TURN


@pytest.mark.parametrize("planets, pressure", [(4, 1686e6), (2, 2385e6)])
def test_hertz_pressure_at_the_pitch_point_of_the_mean_section(run, planets, pressure):
    record = run({"effects.strength": True, "geometry.planet_count": planets}, stop=0.002,
                 output=["stress.contact_pitch", "stress.contact_max"])
    assert record["stress.contact_pitch"][-1] == pytest.approx(pressure, rel=0.02)
    # the real contact is closer to the planet's tip, where the planet's flank is flatter and the side gear's sharper
    assert record["stress.contact_max"][-1] == pytest.approx(pressure, rel=0.15)


def test_damage_counts_relative_revolutions_and_nothing_without_them(run):
    names = ["damage.planet", "damage.side", "stress.root_planet_max", "stress.root_side_max", "planet[1].spin_angle",
             "planet[1].left_normal_force", "planet[1].right_normal_force"]
    straight = run({"effects.strength": True}, output=names)
    assert straight["damage.planet"][-1] == 0.0
    assert straight["damage.side"][-1] == 0.0
    turn = run({**STEADY_TURN, "effects.strength": True, "spin.command": 20.0}, stop=2.0, output=names)
    # Miner's sum at a constant stress: in each revolution every side gear loads a different flank of a planet's tooth, and N planets
    # load the same flank of a side gear's tooth
    slope = log(3e6 / 1e3) / log(2.5)
    turns = abs(turn["planet[1].spin_angle"][-1]) / (2.0 * pi)
    forces = {side: turn[f"planet[1].{side}_normal_force"] for side in ("left", "right")}
    largest = np.maximum(forces["left"], forces["right"])

    def worst(stress, strength):
        return max(np.mean((stress * force / largest) ** slope) for force in forces.values()) / strength**slope

    planet = turns / 3e6 * worst(turn["stress.root_planet_max"], 700e6)
    side = turns * theory.RATIO * theory.PLANETS / 3e6 * worst(turn["stress.root_side_max"], 1000e6)
    assert turn["damage.planet"][-1] == pytest.approx(planet, rel=0.02)
    assert turn["damage.side"][-1] == pytest.approx(side, rel=0.02)
