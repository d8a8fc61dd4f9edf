"""The start `equilibrium` straight ahead: a minimum of the potential, for each law and number of planets.

Stiffness varies along the path of contact, so loaded teeth hold free planets in a well. If the middle position is a maximum of the
potential, there are two wells next to it, which are mirror images of each other."""

import numpy as np
import pytest
from opened_scenes import GEARS

LAWS = ["impact", "line", "line_weber"]
NUDGE, LASTING = 0.05, 1e-3
# smallest spin angle that counts as different from the middle position [rad]
ASIDE = 1e-6


def scene(law, gears, sign=1.0):
    planets, planet_teeth, side_teeth = gears
    # the load of one planet is equal in all scenes
    load = sign * 417.5 * planets
    return {"contact.law": law, "geometry.planet_count": planets, "geometry.planet_teeth": planet_teeth,
            "geometry.side_teeth": side_teeth, "carrier.speed_command": sign * 50.0, "left.load_torque": load,
            "right.load_torque": load}


def places(driven, gears):
    """Spin angles, and the angles of the side gears relative to the carrier [rad]."""
    carrier, *sides = driven.read(["carrier.angle", "left.angle", "right.angle"])
    return np.array(driven.read([f"planet[{i + 1}].spin_angle" for i in range(gears[0])])
                    + [side - carrier for side in sides])


def nudged(drive, law, gears, sign, nudge, stop):
    """Positions every millisecond, after a millisecond with an additional load on the left."""
    driven = drive(scene(law, gears, sign))
    load, found = driven["left.load_torque"], [places(driven, gears)]
    driven.load(load + nudge, load)
    driven.to(LASTING, LASTING)
    driven.load(load)
    driven.to(stop, 1e-3, lambda d: found.append(places(d, gears)))
    return np.array(found)


@pytest.mark.parametrize("gears", GEARS)
@pytest.mark.parametrize("law", LAWS)
def test_gears_in_equilibrium_stay_where_they_are(drive, law, gears):
    driven = drive(scene(law, gears))
    start, moved = places(driven, gears), []
    driven.to(1.0, 1e-2, lambda d: moved.append(np.max(np.abs(places(d, gears) - start))))
    assert max(moved) < 1e-9


@pytest.mark.parametrize("gears", GEARS)
@pytest.mark.parametrize("law", LAWS[1:])
def test_after_a_nudge_gears_come_to_rest_where_they_were(drive, law, gears):
    for nudge in (NUDGE, -NUDGE):
        moved = nudged(drive, law, gears, 1.0, nudge, 1.0)
        spin = moved[:, :gears[0]].mean(axis=1)
        # a well next to the middle is not left through the middle
        assert np.all(np.sign(spin) == np.sign(spin[0]))
        assert np.max(np.abs(moved[600:] - moved[0])) < 1e-9


@pytest.mark.parametrize("law", LAWS)
def test_of_two_equal_wells_the_one_at_positive_spin_is_chosen(drive, law):
    for sign in (1.0, -1.0):
        spin = drive(scene(law, (2, 10, 16), sign))["planet[1].spin_angle"]
        assert sign * spin >= 0.0
        assert (abs(spin) > ASIDE) == (law != "impact")
