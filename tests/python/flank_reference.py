"""Force on a ring gear from the normal of its loaded flank, and the forces on the bearings of its carrier, by vector algebra.

Frame of the housing: x forward, y to the left, z upward. The axle drives forward if it turns about +y."""

from math import cos, sin

import numpy as np

Y = np.array([0.0, 1.0, 0.0])


def directions(left, azimuth):
    """Unit vectors at the mesh: away from the planets, away from the axle, and along the forward rotation."""
    away = np.array([cos(azimuth), 0.0, sin(azimuth)])
    return (Y if left else -Y), away, np.cross(Y, away)


def flank_force(torque, radius, pressure, spiral, pitch, right_hand, left, azimuth):
    """Force of the pinion on the ring gear [N] under the torque [N.m]. `left`: the ring gear is on the left of the planets.

    A right-hand tooth is inclined clockwise from its inner to its outer end, for an observer at the apex who looks along the gear's
    axis toward the gear. For a pitch angle of zero, this is a right-hand helix."""
    outward, away, forward = directions(left, azimuth)
    # line of the pitch cone from its apex, and its normal, out of the material
    line = cos(pitch) * outward + sin(pitch) * away
    out = cos(pitch) * away - sin(pitch) * outward
    # clockwise for one who looks along a direction is a positive rotation about it
    clockwise = np.cross(outward, away)
    tooth = cos(spiral) * line + (sin(spiral) if right_hand else -sin(spiral)) * clockwise
    # side of the tooth on which the force acts: from behind, along the torque
    across = np.cross(out, tooth)
    across *= np.sign(torque) * np.sign(across @ forward)
    # the profile of this flank rises from the root and leans away from the force, so that teeth narrow toward their tips
    profile = cos(pressure) * out + sin(pressure) * across
    normal = np.cross(tooth, profile)
    normal *= np.sign(normal @ across)
    force = normal * torque / radius / (normal @ forward)
    assert abs(radius * (force @ forward) - torque) < 1e-9 * abs(torque)
    return force


def in_components(force, left, azimuth):
    """Tangential force (forward), axial force (away from the planets), and radial force (toward the axle)."""
    outward, away, forward = directions(left, azimuth)
    return np.array([force @ forward, force @ outward, -(force @ away)])


def from_components(components, left, azimuth):
    outward, away, forward = directions(left, azimuth)
    return components[0] * forward + components[1] * outward - components[2] * away


def place(radius, offset, left, azimuth):
    """Point of the mesh, from the middle of the planets' plane."""
    outward, away, _ = directions(left, azimuth)
    return radius * away + offset * outward


def bearing_forces(force, at, left_distance, right_distance):
    """Forces of the carrier on its left and right bearing: balance of forces and of moments across the axle, from linear equations. The
    bearing toward which the axial force points carries it."""
    places = [left_distance * Y, -right_distance * Y]
    # unknown: x and z of left and right
    rows, right = np.zeros((4, 4)), np.zeros(4)
    moment = np.cross(at, force)
    for k in range(4):
        unit = np.zeros(3)
        unit[[0, 2][k % 2]] = 1.0
        its = np.cross(places[k // 2], unit)
        rows[:, k] = [unit[0], unit[2], its[0], its[2]]
    right[:] = [force[0], force[2], moment[0], moment[2]]
    x_left, z_left, x_right, z_right = np.linalg.solve(rows, right)
    return np.array([[x_left, max(force[1], 0.0), z_left], [x_right, min(force[1], 0.0), z_right]])
