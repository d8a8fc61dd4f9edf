"""Tooth contact over the face under every law, against sums made outside the program: deflection of crowned teeth, pressure at
toe, middle and heel, and the pressure at the pitch point."""

from math import log, pi, sqrt, tan

import numpy as np
import pytest
import theory
from plain import Gears
from scipy.optimize import brentq

YOUNG, POISSON = 2.07e11, 0.25
CONTACT_MODULUS = YOUNG / (2.0 * (1.0 - POISSON**2))
# B of Weber's Hertz part: p = ω (Q − B ln ω)
LOCAL = 2.0 * (1.0 - POISSON**2) / (pi * YOUNG)
INNER, MIDDLE, OUTER, RESULTANT = theory.INNER_CONE, theory.MEAN_CONE, theory.OUTER_CONE, theory.RESULTANT
SLICES = INNER + (np.arange(4000) + 0.5) * theory.FACE_WIDTH / 4000

PAIRS = [f"mesh.pair[{k}]" for k in (1, 2, 3)]
WATCHED = ["planet[1].left_transmission_error", "planet[1].left_normal_force"] + [
    f"{pair}.{value}" for pair in PAIRS
    for value in ("force", "height", "tooth", "toe_pressure", "middle_pressure", "heel_pressure")]


def load_per_cone(law, compliance, arc):
    """ω = w/R at the penetration arc p: constant compliance, or p = ω (Q − B ln ω)."""
    arc = np.maximum(arc, 1e-300)
    if law == "line":
        return arc / compliance
    # Newton on v − ln v = Q/B − ln(p/B), ω = p/(B v)
    level = compliance / LOCAL - np.log(arc / LOCAL)
    v = level + np.log(level)
    for _ in range(40):
        v -= (v - np.log(v) - level) / (1.0 - 1.0 / v)
    return np.where(arc > 1e-299, arc / (LOCAL * v), 0.0)


def arc_at(approach, crowning, cone):
    """p(R) = A − e(R)/R, e the parabola of symmetric crowning."""
    gap = crowning * ((cone - MIDDLE) / (theory.FACE_WIDTH / 2.0)) ** 2
    return approach - gap / cone


def moment(law, compliance, approach, crowning):
    """∫ω R² dR."""
    load = load_per_cone(law, compliance, arc_at(approach, crowning, SLICES))
    return np.sum(load * SLICES**2) * theory.FACE_WIDTH / len(SLICES)


def of_load(law, approach, crowning, wanted):
    """Compliance with which a pair at this approach carries this moment."""
    low, high = (1e-13, 1e-9) if law == "line" else (LOCAL * (1.0 + log(1e9)), 100.0 * LOCAL * log(1e9))
    return brentq(lambda q: moment(law, q, approach, crowning) / wanted - 1.0, low, high, xtol=1e-24, rtol=1e-14)


def standing(run, law, crowning, torque, **values):
    """Outputs of a planet whose left mesh is in equilibrium at rest; None if more than one pair carries."""
    record = run({"contact.law": law, "effects.tooth_errors": True, "tooth_errors.crowning": crowning, "effects.strength": True,
                  "scene.planet_spin": "imposed", "spin.command": 0.0, "scene.start": "equilibrium",
                  "left.load_torque": torque, "right.load_torque": torque, **values},
                 stop=0.02, output=WATCHED + ["stress.contact_pitch", "stress.contact_max"])
    last = {name: record[name][-1] for name in WATCHED + ["stress.contact_pitch", "stress.contact_max"]}
    return last if sum(last[f"{pair}.tooth"] >= 0 for pair in PAIRS) == 1 else None


@pytest.mark.parametrize("law", ["line", "line_weber"])
@pytest.mark.parametrize("torque", [5.0, 150.0, 835.0])
def test_crowned_teeth_deflect_as_4000_slices_do(run, law, torque):
    wanted = torque / (theory.PLANETS * theory.SIDE_LEVER)
    plain = standing(run, law, 1e-9, torque)
    # compliance of a pair at this place, from teeth without crowning
    compliance = of_load(law, plain["planet[1].left_transmission_error"] / MIDDLE, 1e-9, wanted)
    compared = 0
    for crowning in (3e-6, 20e-6, 48e-6, 100e-6, 200e-6, 300e-6):
        crowned = standing(run, law, crowning, torque)
        if crowned is None:
            continue
        compared += 1
        own = brentq(lambda a: moment(law, compliance, a, crowning) / wanted - 1.0, 1e-9, 0.05, xtol=1e-15, rtol=1e-13)
        assert crowned["planet[1].left_transmission_error"] == pytest.approx(own * MIDDLE, rel=1e-3), crowning
    # under the full load the tip of the next pair starts to carry
    assert compared == 6 or (torque == 835.0 and compared >= 3), compared


@pytest.mark.parametrize("law", ["line", "line_weber"])
@pytest.mark.parametrize("torque", [150.0, 835.0])
def test_pairs_have_the_pressure_of_their_load_at_toe_middle_and_heel(run, law, torque):
    gears = Gears()
    for crowning in (1e-9, 10e-6, 20e-6, 48e-6, 70e-6, 100e-6):
        last = standing(run, law, crowning, torque)
        assert last, "one pair carries"
        pair = next(pair for pair in PAIRS if last[f"{pair}.tooth"] >= 0)
        approach = last["planet[1].left_transmission_error"] / MIDDLE
        compliance = of_load(law, approach, crowning, torque / (theory.PLANETS * theory.SIDE_LEVER))
        polar = gears.pitch["planet"] + last[f"{pair}.height"] / MIDDLE
        arcs = [gears.arc("planet", polar)]
        arcs.append(gears.pitch_arc["planet"] + gears.pitch_arc["side"] - arcs[0])
        for name, cone in (("toe", INNER), ("middle", MIDDLE), ("heel", OUTER)):
            line_load = cone * float(load_per_cone(law, compliance, arc_at(approach, crowning, cone)))
            radius = 1.0 / sum(1.0 / (cone * tan(arc)) for arc in arcs)
            wanted = sqrt(line_load * CONTACT_MODULUS / (pi * radius))
            assert last[f"{pair}.{name}_pressure"] == pytest.approx(wanted, rel=1e-3, abs=1e6), (crowning, name)


@pytest.mark.parametrize("contact, law, resultant", [
    ("tooth", "impact", MIDDLE), ("tooth", "line", RESULTANT), ("tooth", "line_weber", RESULTANT),
    ("lumped", "line", RESULTANT), ("solid", "impact", MIDDLE)])
@pytest.mark.parametrize("planets", [2, 4])
def test_the_pressure_at_the_pitch_point_is_hertz_s_of_the_resultant(run, contact, law, resultant, planets):
    names = ["stress.contact_pitch", "stress.contact_max", "safety.flank_min", "stress.root_planet_max"]
    record = run({"effects.strength": True, "scene.gear_contact": contact, "contact.law": law, "geometry.planet_count": planets,
                  "scene.planet_spin": "imposed", "spin.command": 0.0, "scene.start": "equilibrium"},
                 stop=0.02, output=names)
    last = {name: record[name][-1] for name in names}
    gears = Gears()
    force = theory.LOAD / (planets * resultant * theory.SIDE_LEVER)

    def pressure(psi):
        # w/R is F/(b R_m) at every section that a line law loads, and at the middle one under the others
        curvature = sum(1.0 / (MIDDLE * tan(arc)) for arc in (psi, gears.pitch_arc["planet"] + gears.pitch_arc["side"] - psi))
        return sqrt(force / theory.FACE_WIDTH * CONTACT_MODULUS * curvature / pi)

    pitch = gears.pitch_arc["planet"]
    assert last["stress.contact_pitch"] == pytest.approx(pressure(pitch), rel=1e-4)
    inner = max(pressure(pitch + s) for s in (gears.end["planet"] - gears.base_pitch, gears.base_pitch - gears.end["side"]))
    assert last["safety.flank_min"] == pytest.approx(1500e6 / inner, rel=1e-3)
    if contact == "lumped":
        assert last["stress.contact_max"] == pytest.approx(last["stress.contact_pitch"], rel=1e-12)
