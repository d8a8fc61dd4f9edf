"""Threshold at which free planets roll under unequal loads, against the statics of the same gears. For `impact` it is
calculated from the formulas here; for laws from the tooth shape, from the torque that turns the planets slowly.

Stiffness that varies along the path causes a potential well for the planets' spin. Its depth and steepest slope follow
only from the tooth geometry: the energy of all pairs while the planets turn, with side gears in balance with their load."""

from math import pi

import numpy as np
import pytest
import theory
from plain import Differential, Gears, Scene

GEARS = Gears()
# only elastic forces are used: pairs at zero speed
MODEL = Differential(Scene())
# spin at which inertia and damping cause less than a thousandth of the torque [rad/s]
SLOW = 0.01


def energy(approach, travel):
    """Elastic energy of one mesh with the approach `approach` of its flanks and the planet's travel `travel`."""
    pairs = MODEL.pairs(approach, 0.0, travel, 0.0) if approach > 0.0 else ()
    return sum(force * depth for _, _, depth, force, _, _ in pairs) / (theory.EXPONENT + 1.0)


def balanced(sign, spin):
    """Potential of one side with its two planets, with the side gear in balance with its load."""
    travel = sign * GEARS.lever["planet"] * spin
    lever = GEARS.lever["side"]

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
    # slope with respect to the side gear's angle α = ψ z_p/z_s
    return np.max(np.abs(np.gradient(well, spins))) * theory.SIDE_TEETH / theory.PLANET_TEETH


@pytest.mark.parametrize("law", ["impact", "line", "line_weber"])
def test_the_threshold_is_the_largest_torque_that_turning_the_planets_slowly_takes(drive, law, threshold):
    points = 400
    turned = drive({"contact.law": law, "scene.planet_spin": "imposed", "spin.command": SLOW})
    torques = []
    turned.to(theory.TOOTH_PITCH / SLOW, theory.TOOTH_PITCH / SLOW / points, lambda d: torques.append(d["spin.torque"]))
    # a load difference ΔT acts on the planets with ΔT z_p/z_s
    steepest = np.max(np.abs(torques)) * theory.SIDE_TEETH / theory.PLANET_TEETH
    if law == "impact":
        assert steepest == pytest.approx(threshold, rel=2e-3)
    for share, rolls in [(0.97, False), (1.03, True)]:
        driven = drive({"contact.law": law, "left.load_torque": theory.LOAD + share * steepest}).to(0.2, 1e-3)
        assert (abs(driven["planet[1].spin_speed"]) > 10.0) == rolls, steepest
