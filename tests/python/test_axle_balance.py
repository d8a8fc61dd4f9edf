"""Final drive and propeller shaft: momentum (final_drives.py), power, friction, wind-up, forces and the joint."""

from math import atan, cos, sin, tan

import numpy as np
import pytest
from driving import Drive

ON = {"effects.final_drive": True, "scene.carrier_drive": "torque", "pinion.torque_command": 200.0, "pinion.speed_command": 150.0,
      "inertia.left_end": 1.0, "inertia.right_end": 1.0, "left.load_torque": 300.0, "right.load_torque": 300.0}
ELASTIC = {"final_drive.elastic_mesh": True}
ERRORS = ELASTIC | {"final_drive.error_1": 5e-6, "final_drive.error_2": 3e-6, "final_drive.error_phase_2": 1.0, "final_drive.error_3": 1e-6,
                    "final_drive.pinion_runout": 2e-5, "final_drive.ring_runout": 3e-5, "final_drive.ring_runout_phase": 0.5}
SHAFT = {"effects.propeller_shaft": True}
FRICTION = {"final_drive.friction_torque": 2.0, "final_drive.viscous": 0.01}
SCENES = {
    "rigid": {}, "rigid with friction": FRICTION, "elastic": ELASTIC, "errors": ERRORS, "errors and friction": ERRORS | FRICTION,
    "rigid behind a shaft": SHAFT, "elastic behind a shaft": ELASTIC | SHAFT | FRICTION,
    "rigid behind a joint": SHAFT | {"propeller_shaft.joint_angle": 0.2},
    "errors behind a joint": ERRORS | SHAFT | FRICTION | {"propeller_shaft.joint_angle": 0.3, "propeller_shaft.joint_quarter_turn": True},
    "errors at an imposed speed": ERRORS | FRICTION | {"scene.carrier_drive": "speed"},
    "joint at an imposed speed": ELASTIC | SHAFT | {"scene.carrier_drive": "speed", "propeller_shaft.joint_angle": 0.2}}


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("name", SCENES)
def test_momentum_and_energy_are_in_balance(fmu, name, contact):
    with Drive(fmu, ON | {"scene.gear_contact": contact} | SCENES[name]) as drive:
        drive.to(0.02, 5e-4)
        # the load changes its sign, so that flanks cross the lash
        drive.set({"left.load_torque": -200.0, "right.load_torque": 100.0, "pinion.torque_command": -100.0})
        drive.to(0.05, 5e-4)
        assert drive.imbalance() < 1e-5
        power, port = drive.read(["power.in", "propeller.torque"])
        assert power == pytest.approx(port * drive["propeller.speed"], rel=1e-9)


@pytest.mark.parametrize("name", ["rigid with friction", "elastic with friction"])
def test_friction_takes_its_torque_from_the_mesh_and_gives_its_power_as_heat(drive, name):
    driven = drive(ON | FRICTION | (ELASTIC if name.startswith("elastic") else {}) | {"scene.carrier_drive": "speed"}).to(0.1, 0.01)
    before = driven["heat.final_drive"]
    friction = 2.0 + 0.01 * 150.0
    port, ring = driven.read(["propeller.torque", "carrier.torque"])
    assert ring == pytest.approx(4.1 * (port - friction), rel=1e-6)
    assert driven["power.loss"] == pytest.approx(friction * 150.0, rel=1e-4)
    driven.to(0.2, 0.01)
    assert driven["heat.final_drive"] - before == pytest.approx(friction * 150.0 * 0.1, rel=1e-4)
    assert driven["efficiency"] == pytest.approx(1.0 - friction / port, rel=1e-4)


def test_an_elastic_mesh_and_a_shaft_wind_up_by_their_stiffness_and_lash(drive):
    """The start is in equilibrium, so the pinion is ahead of the carrier by half of the lash and the deflection of the mesh."""
    driven = drive(ON | ELASTIC | SHAFT | {"scene.gear_contact": "ideal", "pinion.torque_command": 600.0 / 4.1})
    pinion, carrier, end = driven.read(["pinion.angle", "carrier.angle", "propeller.angle"])
    radius = 0.09
    assert pinion / 4.1 - carrier == pytest.approx(600.0 / (3e8 * radius**2) + 0.06e-3 / radius, rel=1e-9)
    assert end - pinion == pytest.approx(600.0 / 4.1 / 2e4, rel=1e-9)


@pytest.mark.parametrize("torque", [400.0, -400.0])
def test_forces_of_the_mesh_are_those_of_its_angles_and_the_bearings_balance_them(drive, torque):
    """Spiral bevel gears by the equations of the forces on a cone, with a left-hand ring gear on the left of the planets."""
    spiral, cone, drives, coasts, radius, offset, left, right = 0.6, 1.25, 0.33, 0.4, 0.095, 0.03, 0.08, 0.07
    driven = drive(ON | {"final_drive.spiral_angle": spiral, "final_drive.pitch_angle": cone, "final_drive.drive_pressure_angle": drives,
                         "final_drive.coast_pressure_angle": coasts, "final_drive.mean_radius": radius, "final_drive.hand": "left",
                         "final_drive.ring_offset": offset, "final_drive.left_bearing": left, "final_drive.right_bearing": right,
                         "pinion.torque_command": torque / 4.1, "left.load_torque": 0.5 * torque, "right.load_torque": 0.5 * torque})
    tangential, axial, radial, on_ring = driven.read([*(f"ring_gear.{name}_force" for name in ("tangential", "axial", "radial")), "carrier.torque"])
    angle, sign = (drives, 1.0) if torque > 0.0 else (coasts, -1.0)
    assert tangential == pytest.approx(on_ring / radius, rel=1e-12)
    pressing = abs(tangential) / cos(spiral)
    assert axial == pytest.approx(pressing * (tan(angle) * sin(cone) + sign * sin(spiral) * cos(cone)), rel=1e-12)
    assert radial == pytest.approx(pressing * (tan(angle) * cos(cone) - sign * sin(spiral) * sin(cone)), rel=1e-12)
    bearings = [driven.read([f"{side}_bearing.{name}_force" for name in ("longitudinal", "axial", "vertical")]) for side in ("left", "right")]
    # the mesh is in front of the axle, where a forward force on the circumference acts downward
    assert np.sum(bearings, axis=0) == pytest.approx([-radial, axial, -tangential], rel=1e-12)
    [lx, _, lz], [rx, _, rz] = bearings
    assert left * lz - right * rz == pytest.approx(-offset * tangential, rel=1e-9)
    assert right * rx - left * lx == pytest.approx(radius * axial + offset * radial, rel=1e-9)


def test_the_joint_turns_its_output_by_its_kinematics(drive):
    """A heavy driven end turns evenly, and a stiff shaft follows the joint."""
    bend = 0.3
    driven = drive(ON | SHAFT | {"scene.carrier_drive": "speed", "scene.start": "rolling", "propeller_shaft.joint_angle": bend,
                                 "propeller_shaft.stiffness": 1e7, "propeller_shaft.damping": 500.0, "pinion.speed_command": 30.0})
    seen = []
    driven.to(0.3, 1e-3, lambda d: seen.append(d.read(["propeller.angle", "pinion.angle"])))
    end, pinion = np.array(seen[50:]).T
    expected = np.arctan2(np.cos(bend) * np.sin(end), np.cos(end))
    off = np.angle(np.exp(1j * (pinion - expected)))
    assert np.abs(off - np.mean(off)).max() < 2e-3 and abs(np.mean(off)) < 2e-3
    assert np.ptp(end - pinion) == pytest.approx(2.0 * atan(tan(0.5 * bend) ** 2), rel=0.1)
