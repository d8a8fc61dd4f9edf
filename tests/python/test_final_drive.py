"""Final drive and propeller shaft: their momentum (final_drives.py) and power, the excitation by the transmission error, forces."""

from math import atan, cos, pi, radians, sin, tan

import numpy as np
import pytest
from driving import Drive
from final_drives import steady_amplitude

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
