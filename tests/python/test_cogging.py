"""The threshold at which free planets roll under unequal loads, against statics computed here from the formulas.

Stiffness that varies along the path makes a potential well for the planets' spin. Its depth and steepest slope follow
from the tooth geometry alone: energy of all pairs, side gears in balance with their load, as the planets turn."""

from math import acos, asin, atan, atan2, cos, pi, sin, tan

import numpy as np
import pytest
import theory

GLEASON_SIDE = (0.54 + 0.46 * (theory.PLANET_TEETH / theory.SIDE_TEETH) ** 2) * theory.MODULE
ADDENDUM = {"planet": 2.0 * theory.MODULE - GLEASON_SIDE, "side": GLEASON_SIDE}
PITCH = {"planet": theory.PLANET_PITCH, "side": theory.SIDE_PITCH}
BASE = {gear: asin(sin(PITCH[gear]) * cos(theory.PRESSURE_ANGLE)) for gear in PITCH}


def arc(gear, polar):
    return acos(cos(polar) / cos(BASE[gear]))


PITCH_ARC = {gear: arc(gear, PITCH[gear]) for gear in PITCH}
TIP = {gear: PITCH[gear] + atan(ADDENDUM[gear] / theory.OUTER_CONE) for gear in PITCH}
TIP_ARC = {gear: arc(gear, TIP[gear]) for gear in PITCH}
END = {gear: TIP_ARC[gear] - PITCH_ARC[gear] for gear in PITCH}
BASE_PITCH = 2.0 * pi * sin(BASE["planet"]) / theory.PLANET_TEETH
SHIFT = (ADDENDUM["planet"] - ADDENDUM["side"]) / 2.0 / theory.MODULE
HALF_TOOTH = ((pi / 2.0 + 2.0 * SHIFT * tan(theory.PRESSURE_ANGLE)) / theory.PLANET_TEETH
              - theory.BACKLASH / 2.0 / theory.MODULE / theory.PLANET_TEETH)


def involute(gear, psi):
    return psi / sin(BASE[gear]) - atan2(tan(psi), sin(BASE[gear]))


def gap(gear, past):
    """Arc by which the mate's flank is clear of the tip corner of `gear`, `past` beyond the end of the path."""
    mate = "side" if gear == "planet" else "planet"
    turned = atan2(tan(TIP_ARC[gear]), sin(BASE[gear])) - atan2(tan(PITCH_ARC[gear]), sin(BASE[gear]))
    azimuth = turned + past / sin(BASE[gear])
    # axes at a right angle: the mate's axis is x, the gear's z
    x, y, z = sin(TIP[gear]) * cos(azimuth), sin(TIP[gear]) * sin(azimuth), cos(TIP[gear])
    touch = atan2(y, z) - involute(mate, acos(x / cos(BASE[mate]))) + involute(mate, PITCH_ARC[mate])
    return END[gear] + past - sin(BASE[mate]) * touch


def energy(approach, travel):
    """Elastic energy of one mesh whose flanks approach by `approach`, planet's travel `travel`."""
    total = 0.0
    for k in range(-3, 4):
        s = HALF_TOOTH * sin(BASE["planet"]) + travel + k * BASE_PITCH
        clear = 0.0
        if s > END["planet"]:
            clear = gap("planet", s - END["planet"]) if s < END["planet"] + 0.15 else 1.0
        elif s - approach < -END["side"]:
            clear = gap("side", approach - END["side"] - s) if s > -END["side"] - 0.15 else 1.0
        depth = max(approach - clear, 0.0) * theory.MEAN_CONE
        total += theory.STIFFNESS * depth ** (theory.EXPONENT + 1.0) / (theory.EXPONENT + 1.0)
    return total


def balanced(sign, spin):
    """Potential of one side with its two planets, the side gear where its load is borne."""
    travel = sign * sin(BASE["planet"]) * spin
    lever = sin(BASE["side"])

    def potential(approach):
        return theory.PLANETS * energy(approach, travel) + theory.LOAD * (travel - approach) / lever

    low, high, golden = 0.0, 0.02, (5.0**0.5 - 1.0) / 2.0
    for _ in range(60):
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if potential(a) < potential(b) else (a, high)
    return potential(0.5 * (low + high))


@pytest.fixture(scope="module")
def threshold():
    spins = np.linspace(0.0, pi / theory.PLANET_TEETH, 401)
    well = np.array([balanced(1.0, spin) + balanced(-1.0, spin) for spin in spins])
    assert np.max(well) - well[0] == pytest.approx(1.32, abs=0.01)
    # against the side gear's angle α = ψ z_p/z_s
    return np.max(np.abs(np.gradient(well, spins))) * theory.SIDE_TEETH / theory.PLANET_TEETH


@pytest.mark.parametrize("share, rolls", [(0.97, False), (1.03, True)])
def test_free_planets_roll_beyond_the_steepest_slope_of_their_well(open_fmu, threshold, share, rolls):
    with open_fmu() as opened:
        opened.set("left.load_torque", theory.LOAD + share * threshold)
        opened.initialise()
        for k in range(200):
            opened.fmu.doStep(k * 1e-3, 1e-3)
        assert (abs(opened.get("planet[1].spin_speed")) > 10.0) == rolls, threshold
