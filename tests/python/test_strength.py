"""Stresses at the pitch point, and damage by Miner's rule."""

from math import log, pi

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
    names = ["damage.planet", "damage.side", "stress.root_planet_max", "stress.root_side_max"]
    straight = run({"effects.strength": True}, output=names)
    assert straight["damage.planet"][-1] == 0.0
    assert straight["damage.side"][-1] == 0.0
    # Miner's sum at a constant stress, over 8 revolutions of the planets, which are 5 of the side gears: in each revolution, both side
    # gears bend a planet's tooth in turn, and N planets bend a side gear's tooth in the same direction
    slope, period = log(3e6 / 1e3) / log(2.5), 8 * 2.0 * pi / 20.0
    turn = run({**STEADY_TURN, "scene.gear_contact": "lumped", "effects.strength": True, "spin.command": 20.0}, stop=2 * period, step=period,
               output=names)
    planet, side = (turn[name][-1] - turn[name][-2] for name in names[:2])
    assert planet == pytest.approx(8 / 3e6 * (turn["stress.root_planet_max"][-1] / 700e6) ** slope, rel=5e-3)
    assert side == pytest.approx(5 * theory.PLANETS / 3e6 * (turn["stress.root_side_max"][-1] / 1000e6) ** slope, rel=5e-3)
