"""Efficiency by the powers of all ports, bias of vanishing torques, temperatures without rating, mass and inertia of a side gear."""

from math import sqrt

import numpy as np
import pytest
from driving import SIDES
from fmpy.fmi2 import FMU2Model

CONTACTS = pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
PRELOAD = 20.0
CLUTCH = {"effects.limited_slip": True, "limited_slip.preload": PRELOAD, "limited_slip.torque_coefficient": 0.0}
LEFT = {"scene.left_drive": "speed"}
FLOWS = {
    "carrier drives": {"scene.planet_spin": "imposed", "spin.command": 20.0, "left.load_torque": 400.0,
                       "right.load_torque": 400.0},
    "left drives right": LEFT | {"carrier.speed_command": 0.0, "left.speed_command": 30.0, "right.load_torque": -300.0},
    "right drives left": LEFT | {"carrier.speed_command": 0.0, "left.speed_command": 30.0, "right.load_torque": 300.0},
    "left drives right and carrier": LEFT | {"carrier.speed_command": 1.0, "left.speed_command": 30.0, "right.load_torque": -300.0},
    "both drive the carrier": LEFT | {"carrier.speed_command": 30.0, "left.speed_command": 35.0, "right.load_torque": -300.0},
    "one wheel backward": LEFT | {"carrier.speed_command": 30.0, "left.speed_command": -10.0, "right.load_torque": 300.0},
}


@pytest.mark.parametrize("sign", [1.0, -1.0])
@CONTACTS
@pytest.mark.parametrize("flow", FLOWS)
def test_efficiency_is_the_part_of_the_input_power_that_is_not_lost(drive, flow, contact, sign):
    values = {name: sign * value if name.endswith(("command", "torque")) else value for name, value in FLOWS[flow].items()}
    driven = drive(CLUTCH | {"effects.thrust_friction": contact != "ideal", "scene.gear_contact": contact} | values)
    driven.to(0.3, 0.01)
    ports = [driven["carrier.torque"] * driven["carrier.speed"], driven["spin.torque"] * driven["planet[1].spin_speed"]]
    ports += [-driven[f"{side}.shaft_torque"] * driven[f"{side}.wheel_speed"] for side in SIDES]
    fed = sum(max(port, 0.0) for port in ports)
    assert fed > 1e3
    assert driven["efficiency"] == pytest.approx(1.0 - driven["power.loss"] / fed, rel=1e-12)
    # without a moving energy store, the ports share the loss
    if contact != "tooth":
        assert driven["efficiency"] == pytest.approx(1.0 - sum(ports) / fed, abs=1e-3)
    assert 0.6 < driven["efficiency"] < 0.999


def test_a_wheel_that_drives_the_other_one_loses_the_friction_of_both_packs(drive):
    # with a held carrier both packs slip, each with its preload, and wheels turn at the same speed in opposite directions
    load = 300.0
    driven = drive(CLUTCH | {"scene.gear_contact": "ideal"} | FLOWS["left drives right"])
    driven.to(0.3, 0.01)
    assert driven["efficiency"] == pytest.approx(load / (load + 2.0 * PRELOAD), rel=1e-9)


@CONTACTS
def test_efficiency_is_one_without_input_power(drive, contact):
    # the differential coasts: clutch and inertia, no drive
    driven = drive(CLUTCH | {"scene.gear_contact": contact, "scene.carrier_drive": "torque", "carrier.torque_command": 0.0,
                             "left.load_torque": 0.0, "right.load_torque": 0.0, "carrier.speed_command": 50.0})
    driven.to(0.01, 1e-3)
    assert driven["efficiency"] == 1.0


@pytest.mark.parametrize("apart", [2.0, -2.0])
@CONTACTS
def test_opposed_torques_without_a_sum_have_no_bias_at_any_level(drive, contact, apart):
    driven = drive({"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.preload": 50.0,
                    "limited_slip.torque_coefficient": 0.0, "scene.carrier_drive": "torque", "carrier.torque_command": 0.0,
                    "scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 20.0 + apart,
                    "right.speed_command": 20.0})
    for _ in range(100):
        driven.step(1e-3)
        assert (driven["locking_value"], driven["torque_bias_ratio"]) == (0.0, 1.0)
    torques = driven.read([f"{side}.shaft_torque" for side in SIDES])
    assert np.abs(torques) == pytest.approx(50.0, rel=0.01) and abs(sum(torques)) < 1e-3


@pytest.mark.parametrize("push", [1.0, -40.0, 300.0])
def test_a_small_sum_of_torques_has_the_same_locking_value_at_every_level(drive, push):
    values = {"effects.limited_slip": True, "limited_slip.preload": 50.0, "limited_slip.torque_coefficient": 0.0,
              "scene.carrier_drive": "torque", "carrier.torque_command": push, "scene.left_drive": "speed",
              "scene.right_drive": "speed", "left.speed_command": 22.0, "right.speed_command": 20.0}
    for contact in ["ideal", "lumped"]:
        driven = drive(values | {"scene.gear_contact": contact})
        driven.to(0.3, 1e-2)
        # the wheels get half of the carrier's torque, and the clutch moves its torque from the fast side to the slow one
        assert driven["locking_value"] == pytest.approx(100.0 / abs(push), rel=1e-4)
        slow, fast = 0.5 * abs(push) + 50.0, 0.5 * abs(push) - 50.0
        assert driven["torque_bias_ratio"] == pytest.approx(slow / fast, rel=1e-3)


@pytest.mark.parametrize("warm_up", [False, True])
@CONTACTS
def test_flanks_that_nobody_rates_have_the_temperature_of_the_gears(drive, contact, warm_up):
    driven = drive({"scene.gear_contact": contact, "oil.temperature": 331.0, "effects.warm_up": warm_up,
                    "warm_up.gears_above_oil": 12.0 if warm_up else 0.0})
    driven.to(0.02, 1e-3)
    gears = driven["temperature.gears"]
    assert driven["temperature.contact"] == pytest.approx(gears, abs=1e-6)
    assert gears == pytest.approx(343.0 if warm_up else 331.0, abs=0.1)
    assert driven["temperature.flash"] == 0.0


def seat_stiffness_over_mass(fmu, values):
    """-∂(acceleration)/∂(position) of the left seat [1/s²]."""
    numbers = {variable.name: number for variable, number in fmu.numbers(values)}
    references = {variable.name: variable.valueReference for variable in fmu.description.modelVariables}
    unit = FMU2Model(guid=fmu.description.guid, unzipDirectory=fmu.folder,
                     modelIdentifier=fmu.description.modelExchange.modelIdentifier, instanceName="seat")
    unit.instantiate()
    unit.setupExperiment(startTime=0.0)
    for name, number in numbers.items():
        put = {"Real": unit.setReal, "Boolean": unit.setBoolean}.get(fmu.variables[name].kind, unit.setInteger)
        put([references[name]], [number])
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    slope = unit.getDirectionalDerivative([references["der(left.seat_speed)"]], [references["left.seat_position"]], [1.0])[0]
    solid = unit.getReal([references["geometry.side_mass"]])[0]
    unit.terminate()
    unit.freeInstance()
    return -slope, solid


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
def test_a_side_gear_swings_on_its_seat_with_its_mass_whatever_its_inertia(fmu, contact):
    # with teeth in mid-gap, only the case pushes back
    case = 7e8
    values = {"scene.gear_contact": contact, "scene.start": "rolling", "effects.pin_compliance": True,
              "pin_compliance.case_stiffness": case, "inertia.from_geometry": False}
    for inertia in (1.47e-4, 0.01, 1.0):
        found, solid = seat_stiffness_over_mass(fmu, values | {"inertia.side_gear": inertia})
        assert sqrt(found) == pytest.approx(sqrt(case / solid), rel=1e-9)
        for mass in (0.1, 2.5):
            found, _ = seat_stiffness_over_mass(fmu, values | {"inertia.side_gear": inertia, "inertia.side_gear_mass": mass})
            assert sqrt(found) == pytest.approx(sqrt(case / mass), rel=1e-9)
    # the solid's mass if inertias are those of solids
    found, solid = seat_stiffness_over_mass(fmu, values | {"inertia.from_geometry": True})
    assert found == pytest.approx(case / solid, rel=1e-9)
