"""The report compares each stress with the limit of its rating, and its colours leave out the seam at the foot of a flank."""

import re

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.report import pattern
from bevel_differential.report.gears import pair_of
from bevel_differential.report.simulated import Simulated
from bevel_differential.report.strength import limits, section
from driving import CARRIER, STEADY_TURN

# stresses may be higher between communication points by the first fraction; their largest values are met within the second one
BETWEEN, MET = 1e-4, 0.02
# scenes that start in equilibrium: planets roll; are at rest; rock; and roll with a changing load
SCENES = {
    "turn": STEADY_TURN,
    "straight": {"carrier.speed_command": CARRIER},
    "line": {**STEADY_TURN, "contact.law": "line", "strength.idler_factor": 0.6},
    "misaligned": {**STEADY_TURN, "contact.law": "line", "effects.tooth_errors": True, "tooth_errors.crowning": 5e-6,
                   "tooth_errors.axis_offset": 2e-5, "strength.application_factor": 1.3},
}


def simulated(fmu_file, values, stop=0.3):
    scene = Scene("limits", stop=stop, step=1e-4, outputs=["left.speed"], fmu=fmu_file)
    scene.set({"effects.strength": True, "solver.relative_tolerance": 1e-7, **values})
    return Simulated.of(scene)


@pytest.mark.parametrize("name", SCENES)
def test_the_least_distance_of_drawn_stresses_to_drawn_limits_is_the_safety_factor(fmu_file, name):
    run = simulated(fmu_file, SCENES[name])
    flanks, planets, sides = limits(run)
    # the start itself is not rated
    least = [float(np.min(each.limit[1:] / each.stress[1:])) for each in (flanks, planets, sides)]
    for drawn, output in ((least[0], "safety.flank_min"), (min(least[1:]), "safety.root_min")):
        rated = float(run.record[output][-1])
        assert (1.0 - BETWEEN) * rated <= drawn <= (1.0 + MET) * rated, (output, drawn, rated)
    # a stress above the limit in the caption agrees with a factor below 1
    text = section(run).blocks[0].caption
    over = [float(share) for share in re.findall(r"([\d.]+) % of the limit", text)]
    assert len(over) == 3
    assert 100.0 / max(over[1:]) == pytest.approx(float(run.record["safety.root_min"][-1]), rel=MET)
    assert 100.0 / over[0] == pytest.approx(float(run.record["safety.flank_min"][-1]), rel=MET)


def test_limits_of_planets_fall_when_they_have_met_both_side_gears_and_not_before(fmu_file):
    run = simulated(fmu_file, {**STEADY_TURN, "spin.command": 12.0})
    planets = limits(run)[1]
    strength, idler = (float(run.value(f"strength.{name}")) for name in ("bending_strength", "idler_factor"))
    spin = np.abs(run.series("planet[1].spin_angle") - run.series("planet[1].spin_angle")[0])
    assert np.all(planets.limit[spin < 0.99 * np.pi] == strength)
    assert np.all(planets.limit[spin > 1.01 * np.pi] == idler * strength) and np.any(spin > 1.01 * np.pi)


def test_the_scale_of_the_pattern_ends_at_the_largest_pressure_outside_the_seam(fmu_file):
    run = simulated(fmu_file, STEADY_TURN, 0.6)
    pair = pair_of(run)
    contacts = pattern.Contacts.of(run, 1.0, pair)
    # one pair at the pitch point has 2385 MPa (docs/inside/theory.md, section 10), and the pressure under IMPACT is that at the mean cone
    toe = np.sqrt(0.5 * (pair.inner_cone + pair.outer_cone) / pair.inner_cone)
    single = 2384.6e6
    assert contacts.pressure.max() > 2.0 * toe * single
    assert contacts.most() <= 2.0 * toe * single
    assert contacts.most() >= single
    # the seam is only at the foot
    assert 0 < np.sum(contacts.in_seam) < 0.3 * len(contacts.force)
    assert contacts.height[contacts.in_seam].max() < 0.0
    standing = pattern.Contacts.of(simulated(fmu_file, {}), 1.0, pair)
    assert standing.most() == standing.pressure.max()
