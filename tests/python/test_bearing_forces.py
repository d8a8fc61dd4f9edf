"""Forces of the ring gear's mesh and on the bearings of the carrier, against vector algebra from the normal of a flank."""

from itertools import product
from math import atan

import flank_reference
import numpy as np
import pytest
from final_drive_scenes import DRIVEN, RATIO, loads, sampled

# relative to the force of the mesh
SAME = 1e-9
MESH = ["ring_gear.tangential_force", "ring_gear.axial_force", "ring_gear.radial_force"]
BEARINGS = [f"{side}_bearing.{along}_force" for side in ("left", "right") for along in ("longitudinal", "axial", "vertical")]
COMBINATIONS = list(product([True, False], [True, False], [80.0, -80.0], [900.0, -900.0]))


def design(random):
    """Random gears and bearings, by the names of the final drive."""
    return {"drive_pressure_angle": random.uniform(0.2, 0.5), "coast_pressure_angle": random.uniform(0.2, 0.5),
            "spiral_angle": random.uniform(0.0, 0.9), "pitch_angle": random.uniform(0.0, 1.5), "mean_radius": random.uniform(0.05, 0.2),
            "azimuth": random.uniform(-3.1, 3.1), "ring_offset": random.uniform(-0.03, 0.08), "left_bearing": random.uniform(0.04, 0.15),
            "right_bearing": random.uniform(0.04, 0.15)}


def scene(of, right_hand, left, speed, torque):
    return DRIVEN | loads(torque) | {f"final_drive.{name}": value for name, value in of.items()} | {
        "scene.gear_contact": "ideal", "final_drive.hand": "right" if right_hand else "left",
        "final_drive.ring_side": "left" if left else "right", "pinion.speed_command": speed, "pinion.torque_command": 1.1 * torque / RATIO}


def read(fmu, values):
    """Torque on the ring gear, components of the mesh force, and the forces on both bearings (x, y, z)."""
    with fmu.open() as opened:
        opened.initialise(values)
        opened.step(1e-3)
        return opened.get("carrier.torque"), np.array(opened.read(MESH)), np.array(opened.read(BEARINGS)).reshape(2, 3)


def expected(of, right_hand, left, torque):
    """Components of the mesh force, and the forces on both bearings."""
    pressure = of["drive_pressure_angle"] if torque > 0.0 else of["coast_pressure_angle"]
    force = flank_reference.flank_force(torque, of["mean_radius"], pressure, of["spiral_angle"], of["pitch_angle"], right_hand, left,
                                        of["azimuth"])
    at = flank_reference.place(of["mean_radius"], of["ring_offset"], left, of["azimuth"])
    return (flank_reference.in_components(force, left, of["azimuth"]),
            flank_reference.bearing_forces(force, at, of["left_bearing"], of["right_bearing"]))


@pytest.mark.parametrize("seed, combination", list(enumerate(COMBINATIONS * 2)))
def test_forces_are_those_of_the_flank_and_in_balance_across_the_axle(fmu, seed, combination):
    of = design(np.random.default_rng(seed))
    right_hand, left, _, torque = combination
    ring, mesh, (on_left, on_right) = read(fmu, scene(of, *combination))
    assert np.sign(ring) == np.sign(torque)
    force = flank_reference.from_components(mesh, left, of["azimuth"])
    at = flank_reference.place(of["mean_radius"], of["ring_offset"], left, of["azimuth"])
    y = np.array([0.0, 1.0, 0.0])
    rest = force - on_left - on_right
    moment = np.cross(at, force) - np.cross(of["left_bearing"] * y, on_left) + np.cross(of["right_bearing"] * y, on_right)
    size = np.linalg.norm(force)
    assert np.abs(rest).max() < SAME * size
    assert np.abs(moment[[0, 2]]).max() < SAME * size
    # bearings bear no torque about the axle
    assert moment[1] == pytest.approx(ring, rel=SAME)
    # one bearing carries the whole axial force, in its own direction
    assert on_left[1] >= 0.0 >= on_right[1] and on_left[1] * on_right[1] == 0.0
    on_mesh, on_bearings = expected(of, right_hand, left, ring)
    assert np.abs(mesh - on_mesh).max() < SAME * size
    assert np.abs([on_left - on_bearings[0], on_right - on_bearings[1]]).max() < SAME * size


@pytest.mark.parametrize("hand, side, way", [("right", "left", 1.0), ("left", "left", -1.0), ("left", "right", 1.0),
                                             ("right", "right", -1.0)])
def test_usual_axles_press_the_gears_apart_in_forward_drive(fmu, hand, side, way):
    """A left-hand pinion with a right-hand ring gear on the left is pushed forward, out of the mesh, by the torque of the engine."""
    of = {"spiral_angle": 0.61, "pitch_angle": atan(RATIO), "azimuth": 0.0}
    _, mesh, _ = read(fmu, scene(of, hand == "right", side == "left", 80.0, 900.0))
    _, coast, _ = read(fmu, scene(of, hand == "right", side == "left", 80.0, -900.0))
    # along the pinion's axis, on the ring gear: the gears part in drive, and the pinion is drawn in by overrun
    assert way * mesh[2] > 0.5 * abs(mesh[0]) and way * coast[2] < 0.0


def test_straight_teeth_have_the_forces_of_textbooks(fmu):
    pressure, pitch, radius = 0.35, 1.2, 0.1
    of = {"drive_pressure_angle": pressure, "coast_pressure_angle": pressure, "pitch_angle": pitch, "mean_radius": radius}
    ring, mesh, _ = read(fmu, scene(of, True, True, 80.0, 900.0))
    tangential = ring / radius
    wanted = tangential * np.array([1.0, np.tan(pressure) * np.sin(pitch), np.tan(pressure) * np.cos(pitch)])
    assert mesh == pytest.approx(wanted, rel=SAME)


def test_errors_of_the_differential_do_not_change_mean_forces(started):
    """Mean forces over a repeat of the error pattern: all pairs of the teeth of planet and side gear."""
    spin, points, planet, side = 40.0, 16, 10, 16
    pairs = np.lcm(planet, side)
    of = design(np.random.default_rng(8))
    values = scene(of, True, True, 80.0, 0.0) | loads(900.0) | {
        "scene.gear_contact": "tooth", "contact.law": "line", "scene.carrier_drive": "speed", "scene.planet_spin": "imposed",
        "spin.command": spin, "effects.tooth_errors": True, "tooth_errors.seed": 4, "solver.relative_tolerance": 1e-6}
    means, swings = [], []
    for grade in (0, 8):
        opened = started(values | {"tooth_errors.accuracy_grade": grade})
        opened.step(0.1)
        forces = sampled(opened, [*MESH, *BEARINGS], 2.0 * np.pi / spin / planet / points, pairs * points)
        means.append(forces.mean(axis=0))
        swings.append(np.ptp(forces[:, 0]))
    size = np.linalg.norm(means[0][:3])
    # the errors move the force at every instant, much more than its mean
    assert swings[1] > 10.0 * 1e-4 * size and swings[1] > 2.0 * swings[0]
    assert np.abs(means[1] - means[0]).max() < 1e-4 * size
