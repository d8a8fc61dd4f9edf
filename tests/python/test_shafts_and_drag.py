"""Half-shafts, pins and case, drag, excitation by the final drive's error, a chipped tooth, damping by restitution."""

from math import cos, pi, radians, sqrt

import numpy as np
import pytest
import theory
from driving import STEADY_TURN
from final_drives import steady_amplitude


def test_a_half_shaft_twists_by_its_stiffness_and_oscillates_with_its_end(drive):
    # soft relative to the teeth, which deflect too
    stiffness, inertia, extra = 1e3, 0.5, 50.0
    base = {"effects.half_shaft": True, "half_shaft.left_stiffness": stiffness, "half_shaft.left_damping": 0.0,
            "scene.planet_spin": "imposed"}
    assert drive(base)["left.twist"] == pytest.approx(theory.LOAD / stiffness, rel=1e-12)
    driven = drive(base | {"inertia.left_end": inertia, "contact.law": "line"})
    assert driven["left.twist"] == pytest.approx(theory.LOAD / stiffness, rel=1e-6)
    driven.set({"left.load_torque": theory.LOAD + extra})
    period, twist = 2.0 * pi * sqrt(inertia / stiffness), []
    driven.to(1.99 * period, period / 100.0, lambda d: twist.append(d["left.twist"]))
    expected = (theory.LOAD + extra * (1.0 - np.cos(2.0 * pi * np.arange(1, 200) / 100.0))) / stiffness
    assert np.abs(np.array(twist) - expected).max() < 0.05 * extra / stiffness


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
def test_pins_and_case_are_springs_in_series_with_the_teeth(run, contact):
    pin, case = 4e8, 7e8
    base = {"scene.gear_contact": contact, "scene.planet_spin": "imposed", "contact.law": "line",
            "carrier.speed_command": 0.0}
    names = ["left.angle", "left.thrust_force", "planet[1].left_normal_force"]
    rigid = run(base, stop=0.001, output=names)
    soft = run({**base, "effects.pin_compliance": True, "pin_compliance.pin_stiffness": pin,
                "pin_compliance.case_stiffness": case}, stop=0.001, output=names)
    arm = theory.MEAN_CONE * cos(theory.PLANET_PITCH)
    pins = 2.0 * theory.LOAD / (theory.PLANETS * pin * arm**2)
    thrust = soft["left.thrust_force"][0]
    share = thrust / (theory.PLANETS * soft["planet[1].left_normal_force"][0])
    seat = thrust / case * share / theory.SIDE_LEVER
    wind_up = rigid["left.angle"][0] - soft["left.angle"][0]
    # the seat moves all slices by the same amount, so it acts at the cone distance of the resultant
    assert wind_up == pytest.approx(pins + seat / theory.RESULTANT, rel=0.01)


def test_drag_adds_its_torques_to_the_carrier_s_drive(run):
    values = {"bearing_drag.carrier_torque": 1.5, "bearing_drag.carrier_viscous": 0.02,
              "bearing_drag.carrier_churning": 3e-4, "bearing_drag.side_torque": 0.7, "bearing_drag.side_viscous": 0.01}
    for contact in ("ideal", "lumped", "tooth"):
        record = run({**values, "effects.bearing_drag": True, "scene.gear_contact": contact}, stop=0.05,
                     output=["carrier.torque", "heat.drag"])
        speed = radians(2861.0)
        carrier, side = 1.5 + 0.02 * speed + 3e-4 * speed**2, 0.7 + 0.01 * speed
        assert record["carrier.torque"][-1] == pytest.approx(1670.0 + carrier + 2.0 * side, rel=1e-6)
        assert record["heat.drag"][-1] == pytest.approx((carrier + 2.0 * side) * speed * 0.05, rel=1e-5)


# speeds of the carrier below, near and above that of its resonance on the mesh [rad/s]; elastic teeth are stiff well below it
@pytest.mark.parametrize("contact, speed, close", [("ideal", 60.0, 1e-3), ("ideal", 250.0, 1e-3), ("ideal", 400.0, 1e-3), ("tooth", 60.0, 0.01)])
def test_the_transmission_error_excites_the_carrier_with_the_mesh_order(drive, contact, speed, close):
    error, radius, teeth, ratio = 1e-6, 0.09, 10, 4.1
    driven = drive({"effects.final_drive": True, "final_drive.elastic_mesh": True, "final_drive.error_1": error, "scene.gear_contact": contact,
                    "pinion.speed_command": ratio * speed, "contact.law": "line", "solver.relative_tolerance": 1e-8})
    inertia = np.sum(driven.momentum.weights())
    expected = steady_amplitude(3e8 * radius**2, 3e3 * radius**2, inertia, error / radius, ratio * teeth * speed)
    period, seen = 2.0 * pi / (ratio * teeth * speed), []
    # free oscillations die out within 20 ms
    driven.to(0.02, 1e-3)
    driven.to(driven.time + 8.0 * period, period / 20.0, lambda d: seen.append(d.read(["pinion.angle", "carrier.torque", "carrier.speed"])))
    angle, torque, speeds = np.array(seen).T
    turning = np.exp(-1j * teeth * angle)
    assert 2.0 * abs(np.mean(turning * torque)) == pytest.approx(expected, rel=close)
    # the torque accelerates the carrier, which oscillates at the same order about its mean speed
    swing = expected / (inertia * ratio * teeth * speed)
    assert np.mean(speeds) == pytest.approx(speed, rel=1e-5)
    assert 2.0 * abs(np.mean(turning * speeds)) == pytest.approx(swing, rel=2.0 * close)
    others = [abs(np.mean(turning**n * torque)) for n in (2, 3)]
    assert max(others) < 0.01 * expected or contact == "tooth"


def test_a_chipped_tooth_shows_once_per_revolution_of_its_planet_in_each_mesh(run):
    names = ["planet[1].left_transmission_error", "planet[1].right_transmission_error", "planet[1].spin_angle"]
    base = {**STEADY_TURN, "spin.command": 10.0, "contact.law": "line"}
    stop = 2.0 * pi / 10.0
    sound = run(base, stop=stop, output=names)
    broken = run({**base, "effects.tooth_fault": True, "tooth_fault.at_onset": True, "tooth_fault.onset": 1e-9, "tooth_fault.tooth": 3,
                  "tooth_fault.missing_fraction": 0.3}, stop=stop, output=names)
    for name in names[:2]:
        deeper = np.abs(broken[name] - sound[name]) > 3e-6
        # each revolution has ten pitches, and the tooth is in contact for the contact ratio's share of them
        assert 0.08 < deeper.mean() < 0.25, name
        begins = np.flatnonzero(np.diff(deeper.astype(int)) == 1)
        gaps = np.diff(broken["time"][begins]) > 0.5 * stop / 10.0
        assert gaps.sum() <= 1, name


def test_restitution_damping_is_finite_and_in_balance(run):
    lost = []
    for restitution in (0.3, 0.7, 0.95):
        record = run({**STEADY_TURN, "contact.damping_model": "restitution", "contact.restitution": restitution,
                      "contact.impact_speed": 0.01, "scene.start": "rolling", "solver.relative_tolerance": 1e-5},
                     stop=0.02, output=["heat.contact", "solver.energy_residual"])
        lost.append(record["heat.contact"][-1])
        assert abs(record["solver.energy_residual"][-1]) < 1e-3 * record["heat.contact"][-1]
    assert lost[0] > 0.0 and all(np.isfinite(lost))
