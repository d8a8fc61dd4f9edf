"""Impacts of teeth: torque steps, clunk through the backlash, rattle, small and large backlash."""

from math import sqrt

import numpy as np
import pytest
import theory
from driving import BLOWS, GIVEN, SIDES, TURN, UNDAMPED, UNLOADED

# a minimal load, which determines the flank on which the teeth touch
TOUCH = 1e-3


@pytest.mark.parametrize("corner", [False, True])
@pytest.mark.parametrize("law, rise", [("line", 2.0), ("impact", 2.5)])
@pytest.mark.parametrize("torque", [5000.0, theory.LOAD])
def test_a_torque_step_from_the_touching_flank_peaks_at_its_law_s_multiple_of_the_static_force(
        drive, law, rise, torque, corner):
    # a spring F ~ d^e under a suddenly applied torque first stops at (e + 1) times this torque
    scene = drive({"contact.law": law, "contact.damping": 0.0, "scene.planet_spin": "imposed",
                   "carrier.speed_command": 0.0, "left.load_torque": TOUCH, "right.load_torque": TOUCH,
                   "effects.corner_contact": corner})
    scene.load(torque)
    forces, pairs = [], []
    scene.to(2e-3, 2e-6, lambda s: (forces.append(s["left.tangential_force"]), pairs.append(s["planet[1].left_pairs"])))
    peak = max(forces) / (torque / (theory.MODULE * theory.SIDE_TEETH / 2.0))
    assert np.isfinite(forces).all()
    # the largest sample is at most half a step from the crest of an oscillation of at least 15 kHz, which is 2e-3 of it
    if max(pairs) == 1.0:
        assert peak == pytest.approx(rise, rel=2e-3)
    else:
        # a bent pair brings tip corners into mesh, which stiffen the spring
        assert rise < peak < 1.1 * rise
    assert (max(pairs) == 1.0) or corner
    assert scene.imbalance() < UNDAMPED


def test_a_torque_step_of_5000_newton_metres_in_one_communication_step_finishes(drive):
    for values in ({}, {"contact.damping": 0.0}, {"contact.law": "line"}):
        scene = drive({**UNLOADED, "scene.start": "rolling", **values}).to(0.01, 1e-3)
        scene.load(5000.0)
        scene.to(0.06, 1e-3)
        assert np.isfinite(scene.read([f"{side}.normal_force" for side in SIDES])).all()
        if values.get("contact.damping") != 0.0:
            assert scene["left.tangential_force"] == pytest.approx(5000.0 / 0.036, rel=1e-5)
        assert scene.imbalance() < UNDAMPED


def test_clunk_peaks_at_the_torque_of_two_inertias_across_the_lash(drive):
    stiffness, inertia_1, inertia_2, torque = 2e4, 0.05, 1.0, 100.0
    backlash = 0.1885e-3
    # at rest on the coast flanks under a minimal load
    scene = drive({
        "scene.carrier_drive": "torque", "carrier.torque_command": -2.0 * TOUCH, "carrier.speed_command": 0.0,
        "left.load_torque": -TOUCH, "right.load_torque": -TOUCH, "inertia.carrier": inertia_1,
        "inertia.from_geometry": False, "inertia.side_gear": 1e-6, "inertia.planet": 1e-7,
        "effects.half_shaft": True, "half_shaft.left_stiffness": stiffness / 2.0,
        "half_shaft.right_stiffness": stiffness / 2.0, "half_shaft.left_damping": 0.0,
        "half_shaft.right_damping": 0.0, "inertia.left_end": inertia_2 / 2.0, "inertia.right_end": inertia_2 / 2.0,
        "geometry.backlash": backlash, "contact.law": "line", "contact.damping": 0.0})
    scene.set({"carrier.torque_command": torque, **UNLOADED})
    torques = []
    scene.to(0.01, 2e-5, lambda s: torques.append(s["left.shaft_torque"] + s["right.shaft_torque"]))
    lash = backlash / (theory.MODULE * theory.SIDE_TEETH / 2.0)
    assert np.degrees(lash) == pytest.approx(0.3, rel=1e-3)
    mean = torque * inertia_2 / (inertia_1 + inertia_2)
    reduced = inertia_1 * inertia_2 / (inertia_1 + inertia_2)
    speed_squared = 2.0 * torque / inertia_1 * lash
    expected = mean + sqrt(mean**2 + stiffness * reduced * speed_squared)
    assert expected == pytest.approx(265.58, rel=1e-4)
    assert max(torques) == pytest.approx(expected, rel=0.01)
    assert scene.imbalance() < UNDAMPED


def relative_motion(scene):
    """Kinetic energy of the gears relative to the carrier."""
    left, right, carrier, spin = scene.read(["left.speed", "right.speed", "carrier.speed", "planet[1].spin_speed"])
    return (0.5 * GIVEN["inertia.side_gear"] * ((left - carrier) ** 2 + (right - carrier) ** 2)
            + 0.5 * theory.PLANETS * GIVEN["inertia.planet"] * spin**2)


@pytest.mark.parametrize("law", ["impact", "line"])
@pytest.mark.parametrize("damping", [5e4, 0.0])
def test_rattling_gears_gain_no_energy(drive, law, damping):
    """The carrier oscillates and makes the unloaded gears rattle; once it is at rest, nothing drives them."""
    carrier = 0.02
    scene = drive({**GIVEN, **UNLOADED, "scene.start": "rolling", "carrier.speed_command": 0.0, "contact.law": law,
                   "contact.damping": damping, "inertia.carrier": carrier})
    jumps = 0.0
    for k in range(1, 501):
        before, speed = scene["carrier.speed"], 2.1 * np.sin(2.0 * np.pi * k / 100.0)
        # an imposed speed that jumps takes the energy of the carrier from its drive
        jumps += 0.5 * carrier * abs(speed**2 - before**2)
        scene.set({"carrier.speed_command": speed if k < 500 else 0.0})
        scene.step(2e-4)
    assert scene.residual() < UNDAMPED * (jumps + scene.exchanged + scene.heat())
    begin, heat, early, late = scene["solver.energy_residual"], scene.heat(), [], []
    scene.to(0.15, 1e-4, lambda s: early.append(relative_motion(s) + s.heat() - heat))
    scene.to(0.25, 1e-4, lambda s: late.append(relative_motion(s) + s.heat() - heat))
    # between impacts nothing is deflected: all energy is kinetic energy and heat, and both stay constant
    assert max(early) > 1e-6
    assert max(late) == pytest.approx(max(early), rel=1e-3)
    assert scene.heat() > heat if damping else scene.heat() == heat == 0.0
    # the solver's error in the oscillation is tested above; the free rattle is tested separately
    assert abs(scene["solver.energy_residual"] - begin) < 1e-3 * max(early)


@pytest.mark.parametrize("values", [{"geometry.backlash": 0.0}, {"effects.backlash": False},
                                    {"geometry.backlash": 2e-3}])
@pytest.mark.parametrize("base", [{}, TURN], ids=["straight", "turn"])
@pytest.mark.parametrize("start", ["equilibrium", "rolling", "rest"])
def test_gears_without_backlash_and_with_two_millimetres_run_and_reverse(drive, values, base, start):
    scene = drive({**base, "scene.start": start, **values}).to(0.1, 1e-3)
    # ten tolerances, which are also valid between the ends of long steps
    assert scene["left.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-5)
    scene.load(-theory.LOAD)
    scene.to(0.2, 1e-3)
    assert scene["left.tangential_force"] == pytest.approx(-theory.TANGENTIAL_FORCE, rel=1e-5)
    assert scene.imbalance_of_blows() < BLOWS
