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
    # where the pair really touches, closer to the planet's tip, the planet's flank is flatter and the side gear's sharper
    assert record["stress.contact_max"][-1] == pytest.approx(pressure, rel=0.15)


def test_damage_counts_relative_revolutions_and_nothing_without_them(run):
    names = ["damage.planet", "damage.side", "stress.root_planet_max", "stress.root_side_max", "planet[1].spin_angle",
             "planet[1].left_normal_force", "planet[1].right_normal_force"]
    straight = run({"effects.strength": True}, output=names)
    assert straight["damage.planet"][-1] == 0.0
    assert straight["damage.side"][-1] == 0.0
    turn = run({**STEADY_TURN, "effects.strength": True, "spin.command": 20.0}, stop=2.0, output=names)
    # Miner's sum at a constant stress: each side gear loads another flank of a planet's tooth once a revolution,
    # N planets the same flank of a side gear's tooth
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


@pytest.mark.parametrize("steps", [1, 1000])
def test_damage_of_a_ramp_of_load_is_its_integral(fmu, steps):
    low, high, spin = 80.0, 835.0, 20.0
    loads = ["left.load_torque", "right.load_torque"]
    with fmu.open() as instance:
        instance.initialise({"scene.gear_contact": "lumped", "scene.planet_spin": "imposed", "scene.start": "equilibrium",
                             "effects.strength": True, "spin.command": spin, **dict.fromkeys(loads, low)})
        for k in range(steps):
            instance.set_slopes(dict.fromkeys(loads, high - low))
            instance.do_step(k / steps, 1.0 / steps)
        damage, stress = instance.read(["damage.planet", "stress.root_planet_max"])
    # ∫ (σ/S)^k dn/N with σ in proportion to the load; the first half of a pitch brings no new tooth into mesh
    slope, begin = log(3e6 / 1e3) / log(2.5), pi / 10 / spin
    powers = [(load / high) ** (slope + 1.0) for load in (low + (high - low) * begin, high)]
    integral = (powers[1] - powers[0]) / (slope + 1.0) * high / (high - low)
    assert damage == pytest.approx(spin / (2.0 * pi) / 3e6 * (stress / 700e6) ** slope * integral, rel=1e-4)


def test_stresses_above_the_strength_warn_once_each(drive):
    weak = drive({"effects.strength": True, "strength.bending_strength": 1e7, "strength.contact_strength": 1e8})
    log = weak.to(0.02, 1e-3).messages
    warnings = [line for line in log if "exceeds the strength" in line]
    gears = ["root stress of planet[1]", "root stress of the left side gear", "contact stress between planet[1]"]
    assert len(warnings) == 3 and all(any(gear in line for line in warnings) for gear in gears), log
    assert all("at t = " in line and "MPa" in line for line in warnings)
    strong = drive({"effects.strength": True, "strength.bending_strength": 1e11, "strength.contact_strength": 1e11})
    assert not any("exceeds the strength" in line for line in strong.to(0.02, 1e-3).messages)
