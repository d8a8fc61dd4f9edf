"""The gears of other programs in benches/peers equal those of the FMU."""

import csv
import dataclasses
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benches" / "peers"))

import gears  # noqa: E402


@pytest.fixture(scope="module")
def golden_flanks():
    """Points of reference flanks by gear. The gears have no backlash and no thickness shift."""
    with open(ROOT / "tests" / "data" / "golden_flank.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [row for row in rows if row["gear"] == name] for name in ["planet", "side"]}


@pytest.mark.parametrize("name", ["planet", "side"])
def test_flanks_of_the_peers_are_spherical_involutes(golden_flanks, name):
    gear = {"planet": gears.PLANET, "side": gears.SIDE}[name]
    plain = dataclasses.replace(gear, half_pitch=0.5 * np.pi / gear.teeth)
    rows = golden_flanks[name]
    polar, half = (np.radians([float(row[key]) for row in rows]) for key in ["phi_deg", "gamma_deg"])
    points = 1e-3 * np.array([[float(row[f"{axis}_mm"]) for axis in "xyz"] for row in rows])
    assert plain.half_angle(polar) == pytest.approx(half, abs=1e-9)
    assert gears.OUTER_CONE * gears.direction(polar, half) == pytest.approx(points, abs=1e-11)


@pytest.mark.parametrize("gear", [gears.PLANET, gears.SIDE])
def test_teeth_of_the_peers_have_their_corners_on_the_flanks(gear):
    tooth = gear.teeth_points(8, gap_first=False)[0]
    cone = np.linalg.norm(tooth, axis=1)
    assert sorted(set(np.round(cone, 12))) == pytest.approx([gears.INNER_CONE, gears.OUTER_CONE])
    polar, azimuth = np.arccos(tooth[:, 2] / cone), np.arctan2(tooth[:, 1], tooth[:, 0])
    assert np.abs(azimuth) == pytest.approx(gear.half_angle(polar), abs=1e-7)
    assert (polar.min(), polar.max()) == pytest.approx((gear.root, gear.tip))


def test_gears_of_the_peers_are_as_heavy_as_the_fmu_s(run):
    """A load spins an ideal differential in proportion to 1/(N I_p + 2 (z_p/z_s)² I_s): solids and given inertias agree."""
    scene = {"scene.gear_contact": "ideal", "left.load_torque": 0.0, "right.load_torque": 1.0}
    given = {"inertia.from_geometry": False, "inertia.planet": gears.PLANET.inertia(),
             "inertia.side_gear": gears.SIDE.inertia()}
    spins = [run(scene | more, stop=0.01, output=["planet[1].spin_speed"])["planet[1].spin_speed"][-1]
             for more in ({}, given)]
    assert spins[0] > 1.0
    assert spins[1] == pytest.approx(spins[0], rel=1e-4)
