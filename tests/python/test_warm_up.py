"""Temperatures: friction warms oil, gears, clutch packs, washers and case, and the heat is conserved."""

import re
from math import exp

import pytest
import theory
from bevel_differential import DifferentialError
from refusals import refused

SLIP = {"scene.planet_spin": "imposed", "spin.command": 20.0, **theory.CLUTCHES}
NODES = ["oil", "gears", "clutch", "washers", "case"]
CLOSED = {"warm_up.clutch_to_oil": 0.0, "warm_up.oil_share": 0.0}
FRICTIONS = {**theory.CLUTCHES, "effects.thrust_friction": True, **theory.DRAG,
             "effects.tooth_friction": True}
TURN = {"scene.planet_spin": "imposed", "spin.command": 3.5, "carrier.speed_command": 16.6}


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_a_pack_without_a_path_for_heat_warms_by_torque_times_slip_over_capacity(drive, contact):
    preload, capacity = 80.0, 350.0
    driven = drive(SLIP | CLOSED | {"scene.gear_contact": contact, "effects.warm_up": True, "limited_slip.preload": preload,
                                    "limited_slip.torque_coefficient": 0.0, "warm_up.clutch_capacity": capacity})
    driven.to(0.2, 1e-2)
    begin, time = driven["temperature.clutch"], driven.time
    driven.to(1.2, 1e-2)
    heat = 2.0 * preload * 20.0 * theory.RATIO * (driven.time - time)
    assert driven["temperature.clutch"] - begin == pytest.approx(heat / capacity, rel=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("given", [False, True])
def test_heat_that_enters_is_stored_or_given_off(drive, given, sign):
    driven = drive({name: sign * value if name.endswith("command") else value for name, value in TURN.items()} | FRICTIONS | {
        "left.load_torque": sign * 835.0, "right.load_torque": sign * 835.0, "effects.warm_up": True, "warm_up.sump_given": given,
        "warm_up.oil_share": 0.3, "oil.temperature": 300.0, "warm_up.ambient_temperature": 260.0,
        "solver.relative_tolerance": 1e-9})
    driven.to(0.3, 1e-3)
    entered = sum(driven[name] for name in ["heat.contact", "heat.tooth_friction", "heat.thrust", "heat.clutch", "heat.drag"])
    kept = driven["warm_up.stored"] + driven["warm_up.given_off"]
    assert entered > 50.0
    assert kept == pytest.approx(entered, rel=1e-6)
    assert driven["warm_up.given_off"] != 0.0
    if given:
        assert driven["temperature.oil"] == 300.0


def test_temperatures_do_not_depend_on_communication_points(drive):
    values = TURN | FRICTIONS | {"effects.warm_up": True, "limited_slip.hot_factor": 0.7, "limited_slip.cold_factor": 1.2,
                                 "oil.temperature": 330.0, "warm_up.clutch_capacity": 5.0}
    ends = []
    for step in [1e-3, 5e-3, 0.05]:
        driven = drive(values).to(0.3, step)
        ends.append([driven[f"temperature.{node}"] for node in NODES])
    assert ends[0][2] > 331.0
    assert ends[1] == pytest.approx(ends[0], rel=1e-12) and ends[2] == pytest.approx(ends[0], rel=1e-12)


def test_a_clutch_fades_as_it_warms_up(drive):
    # linear fade in a pack without heat paths: C T' = 2 M0 w (1 - a (T - T0)), so the torque falls exponentially
    preload, capacity, hot = 80.0, 20.0, 0.5
    driven = drive(SLIP | CLOSED | {"scene.gear_contact": "ideal", "effects.warm_up": True, "limited_slip.preload": preload,
                                    "limited_slip.torque_coefficient": 0.0, "warm_up.clutch_capacity": capacity,
                                    "limited_slip.hot_factor": hot})
    driven.to(1.0, 1e-2)
    slip, fall = 20.0 * theory.RATIO, (1.0 - hot) / 120.0
    rise = (1.0 - exp(-2.0 * preload * slip * fall / capacity * 1.0)) / fall
    # friction follows temperature in steps of 0.5 K
    assert driven["temperature.clutch"] - 353.15 == pytest.approx(rise, abs=0.5)


def test_without_the_effect_all_nodes_have_the_temperature_of_the_oil(drive):
    driven = drive(TURN | FRICTIONS | {"oil.temperature": 321.0}).to(0.05, 1e-3)
    assert [driven[f"temperature.{node}"] for node in NODES] == [321.0] * 5
    driven.set({"oil.temperature": 330.0})
    driven.to(0.06, 1e-3)
    assert driven["temperature.clutch"] == 330.0


def test_flanks_flash_and_scuff_by_the_temperatures_of_gears_and_oil(drive):
    values = TURN | FRICTIONS | {"effects.strength": True, "effects.warm_up": True, "strength.scuffing_temperature": 600.0,
                                 "warm_up.sump_given": True, "oil.temperature": 350.0}
    driven, flashes = drive(values), []
    for _ in range(40):
        driven.step(1e-3)
        flash, contact = driven["temperature.flash"], driven["temperature.contact"]
        flashes.append(flash)
        # forces are current, with the temperatures of the last completed step
        assert contact == pytest.approx(driven["temperature.gears"] + flash, abs=1e-3)
        assert driven["safety.scuffing"] == pytest.approx(250.0 / (contact - 350.0), rel=1e-9)
    # no pair slides at the pitch point; elsewhere sliding warms the flanks by a few degrees at this speed
    assert 0.0 <= min(flashes) < 0.5 * max(flashes) and 0.1 < max(flashes) < 200.0
    # doubles friction and heat
    double = drive(values | {"tooth_friction.coefficient": 0.1})
    double.to(0.02, 1e-3)
    single = drive(values).to(0.02, 1e-3)
    assert double["temperature.flash"] == pytest.approx(2.0 * single["temperature.flash"], rel=0.05)


def test_a_cold_oil_drags_by_its_viscosity(drive):
    rolling = {"scene.gear_contact": "ideal", **theory.DRAG, "bearing_drag.viscosity_from_oil": True,
               "bearing_drag.carrier_torque": 0.0, "bearing_drag.side_torque": 0.0, "bearing_drag.carrier_churning": 0.0,
               "bearing_drag.side_viscous": 0.0, "bearing_drag.carrier_viscous": 0.01, "carrier.speed_command": 30.0}
    heats = []
    for temperature in [353.15, 253.15]:
        driven = drive(rolling | {"oil.temperature": temperature}).to(1.0, 1e-2)
        heats.append(driven["heat.drag"])
    assert heats[0] == pytest.approx(0.01 * 30.0**2, rel=1e-9)
    assert heats[1] / heats[0] == pytest.approx(theory.viscosity(253.15) / theory.viscosity(353.15), rel=1e-9)


# carrier and sides turn at one speed, and only churning drags
ROLLING = {"scene.gear_contact": "ideal", **theory.DRAG, **{f"bearing_drag.{name}": 0.0 for name in (
    "carrier_torque", "carrier_viscous", "carrier_churning", "side_torque", "side_viscous")}}


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("kelvin", [373.15, 263.15])
def test_a_carrier_churns_by_its_size_the_oil_s_level_and_its_viscosity(drive, kelvin, sign):
    driven = drive(ROLLING | {"bearing_drag.churning_from_geometry": True, "bearing_drag.carrier_diameter": 0.22, "bearing_drag.oil_level": 0.4,
                              "bearing_drag.carrier_width": 0.06, "oil.temperature": kelvin, "carrier.speed_command": sign * 90.0})
    power = theory.churning(theory.kinematic_viscosity(kelvin), 90.0, 0.22, 0.06, 0.4)
    unloaded = drive(ROLLING | {"carrier.speed_command": sign * 90.0})
    assert driven["carrier.torque"] - unloaded["carrier.torque"] == pytest.approx(sign * power / 90.0, rel=1e-9, abs=1e-11)
    assert driven.to(1.0, 1e-2)["heat.drag"] == pytest.approx(power, rel=1e-9)


def test_churning_follows_the_oil_as_it_warms_up(drive):
    values = ROLLING | {"bearing_drag.churning_from_geometry": True, "effects.warm_up": True, "oil.temperature": 263.15,
                        "warm_up.oil_capacity": 200.0, "warm_up.oil_to_case": 0.0, "warm_up.gears_to_oil": 0.0, "warm_up.clutch_to_oil": 0.0,
                        "warm_up.washers_to_oil": 0.0, "warm_up.gears_to_oil_per_speed": 0.0, "carrier.speed_command": 90.0}
    driven = drive(values).to(2.0, 1e-2)
    warm, heat = driven["temperature.oil"], driven["heat.drag"]
    assert warm - 263.15 == pytest.approx(heat / 200.0, rel=1e-6) and warm > 268.0
    power = (driven.to(2.001, 1e-3)["heat.drag"] - heat) / 1e-3
    # friction follows the oil in steps of 0.1 K
    ends = [theory.churning(theory.kinematic_viscosity(warm + by), 90.0, 0.2, 0.05, 0.3) for by in (0.2, -0.2)]
    assert ends[0] < power < ends[1]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_seals_and_loaded_bearings_drag(drive, sign):
    values = ROLLING | {"carrier.speed_command": sign * 30.0}
    seals = drive(values | {"bearing_drag.seal_diameter": 0.04}).to(1.0, 1e-2)
    # ISO/TR 14179-1 for fluorocarbon rubber: 3.737e-3 N.m per millimetre, on two shafts
    assert seals["heat.drag"] == pytest.approx(2.0 * 3.737e-3 * 40.0 * 30.0, rel=1e-9)
    # Palmgren: 0.0004 F d_m in each of two bearings
    bearings = drive(values | {"bearing_drag.bearing_load": 6000.0, "bearing_drag.bearing_diameter": 0.08}).to(1.0, 1e-2)
    assert bearings["heat.drag"] == pytest.approx(2.0 * 0.0004 * 6000.0 * 0.08 * 30.0, rel=1e-9)


@pytest.mark.parametrize("name, value", [("oil_level", 1.1), ("oil_level", -0.1), ("carrier_diameter", 0.0), ("carrier_width", -1e-3),
                                         ("seal_diameter", -1e-3), ("seal_torque_per_diameter", 0.0), ("bearing_load", -1.0),
                                         ("bearing_diameter", 0.0), ("bearing_coefficient", 0.0)])
def test_values_of_drag_outside_their_ranges_are_refused(drive, name, value):
    with pytest.raises(DifferentialError, match=f"bearing_drag.{name}"):
        drive(ROLLING | {"bearing_drag.churning_from_geometry": True, f"bearing_drag.{name}": value})


@pytest.mark.parametrize("follows", [False, True])
def test_flanks_with_a_given_viscosity_do_not_follow_the_oil(drive, follows):
    values = TURN | {"effects.tooth_friction": True, "tooth_friction.law": "iso_14179", "tooth_friction.viscosity_from_oil": follows,
                     **theory.DRAG, "bearing_drag.viscosity_from_oil": True, "bearing_drag.carrier_viscous": 0.0,
                     "bearing_drag.side_viscous": 1e-9}
    heats = [drive(values | {"oil.temperature": oil}).to(0.1, 1e-3)["heat.tooth_friction"] for oil in [280.0, 380.0]]
    # a thinner oil gives more friction
    assert heats[1] > 1.1 * heats[0] if follows else heats[1] == pytest.approx(heats[0], rel=1e-6)


def test_an_oil_that_thickens_as_it_warms_up_is_refused(drive):
    with refused("oil.viscosity_100 … m2/s … oil.viscosity_40"):
        drive({"oil.viscosity_100": 2e-4, **theory.DRAG, "bearing_drag.viscosity_from_oil": True})


# 40 N·m in each pack at 20 rad/s of the planets
STEADY = SLIP | {"scene.start": "steady_heat", "effects.warm_up": True, "limited_slip.preload": 40.0,
                 "limited_slip.torque_coefficient": 0.0, "carrier.speed_command": 10.0, "warm_up.cycle": 0.1}


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
@pytest.mark.parametrize("given", [False, True])
def test_a_start_with_steady_heat_balances_the_heat_of_the_clutch(drive, contact, given):
    driven = drive(STEADY | {"scene.gear_contact": contact, "warm_up.sump_given": given, "warm_up.ambient_temperature": 285.0})
    heat = 2.0 * 40.0 * 20.0 * theory.RATIO
    # start values: 10 W/K from the clutch, 30 W/K from oil to case, 10 W/K and 0.1 W·s/(K·rad) from case to ambient
    to_ambient = 10.0 + 0.1 * 10.0
    oil = 353.15 if given else 285.0 + heat / to_ambient + heat / 30.0
    case = (30.0 * oil + to_ambient * 285.0) / (30.0 + to_ambient)
    tolerance = 1e-9 if contact == "ideal" else 1e-5
    expected = [oil, oil, oil + heat / 10.0, oil, case]
    assert [driven[f"temperature.{node}"] for node in NODES] == pytest.approx(expected, rel=tolerance)
    driven.to(30.0, 1.0)
    assert [driven[f"temperature.{node}"] for node in NODES] == pytest.approx(expected, rel=10.0 * tolerance)


def test_a_start_with_steady_heat_stays_where_friction_depends_on_temperature(drive):
    values = STEADY | {"scene.gear_contact": "lumped", "limited_slip.hot_factor": 0.5, "limited_slip.cold_factor": 1.5,
                       **theory.DRAG, "bearing_drag.viscosity_from_oil": True, "bearing_drag.carrier_viscous": 0.2}
    driven = drive(values)
    begin = [driven[f"temperature.{node}"] for node in NODES]
    driven.to(300.0, 1.0)
    # friction follows temperature in steps of 0.5 K
    assert [driven[f"temperature.{node}"] for node in NODES] == pytest.approx(begin, abs=0.5)
    # a start far away converges to the same temperatures
    far = drive(values | {"scene.start": "equilibrium", "oil.temperature": 300.0, "solver.relative_tolerance": 1e-4})
    far.to(8000.0, 20.0)
    assert [far[f"temperature.{node}"] for node in NODES] == pytest.approx(begin, abs=0.5)


@pytest.mark.parametrize(("values", "said"), [
    ({"effects.warm_up": False}, "scene.start … steady_heat … effects.warm_up"),
    ({"warm_up.clutch_to_oil": 0.0}, "no steady temperatures … clutch packs … warm_up.clutch_to_oil"),
    ({"warm_up.case_to_ambient": 0.0, "warm_up.case_to_ambient_per_speed": 0.0}, "no steady temperatures … degC"),
    ({"scene.start": "equilibrium", "warm_up.case_above_oil": 350.0}, "warm_up.case_above_oil … 350 K … 673.15 K"),
])
def test_a_start_without_steady_heat_is_refused_by_name(drive, values, said):
    with refused(said):
        drive(STEADY | {"scene.gear_contact": "ideal"} | values)


# inertias that determine the acceleration [kg.m2]: carrier, side gear, wheel; the planets' inertia is negligible
CARRIER, SIDE, WHEEL = 0.05, 1.2e-4, 1.0
FREE = {"scene.start": "steady_heat", "effects.warm_up": True, "scene.gear_contact": "ideal", "inertia.from_geometry": False,
        "inertia.carrier": CARRIER, "inertia.side_gear": SIDE, "inertia.planet": 1e-9, "inertia.left_end": WHEEL,
        "inertia.right_end": WHEEL, "left.load_torque": 0.0, "right.load_torque": 0.0, "carrier.speed_command": 10.0}


def said(driven):
    return [each for each in driven.messages if "not periodic" in each]


@pytest.mark.parametrize("torque", [0.75, 100.0, -100.0])
@pytest.mark.parametrize("cycle", [0.02, 1.0])
def test_steady_heat_of_a_car_that_accelerates_is_reported_with_the_speed_that_changes(drive, torque, cycle):
    """T = I α, so the mean speeds of adjacent cycles of length L differ by α L; cycles below 0.1 s are compared in groups."""
    driven = drive(FREE | {"scene.carrier_drive": "torque", "carrier.torque_command": torque, "warm_up.cycle": cycle})
    [warned] = said(driven)
    assert "scene.start" in warned and "scene.carrier_drive" in warned
    length, acceleration = max(cycle, 0.1), torque / (CARRIER + 2.0 * (SIDE + WHEEL))
    means = [10.0 + acceleration * length * part for part in (1.5, 2.5)]
    found = re.search(r"carrier.speed has a mean of ([-\d.]+) rad/s over ([\d.]+) s and of ([-\d.]+) rad/s", warned)
    assert float(found[2]) == length
    assert [float(found[1]), float(found[3])] == pytest.approx(means, rel=1e-4)


@pytest.mark.parametrize("side, sign", [("left", 1.0), ("right", -1.0)])
def test_steady_heat_of_wheels_that_accelerate_against_each_other_names_a_wheel(drive, side, sign):
    """At a given carrier speed, the torque T on one wheel accelerates each wheel by T/2I, with the wheel's inertia I."""
    [warned] = said(drive(FREE | {f"{side}.load_torque": -1.0}))
    mean = 10.0 + sign * 1.5 / (2.0 * (SIDE + WHEEL))
    assert "left.wheel_speed has a mean of" in warned and "carrier.speed has" not in warned
    assert float(re.search(r"mean of ([-\d.]+)", warned)[1]) == pytest.approx(mean, rel=1e-4)


@pytest.mark.parametrize("values", [
    FREE | theory.DRAG | {"scene.carrier_drive": "torque", "carrier.torque_command": 1500.0},
    # diverges too fast for three cycles, and for one
    FREE | {"scene.gear_contact": "tooth", "effects.tooth_friction": True, "left.load_torque": 300.0, "right.load_torque": 250.0,
            "warm_up.cycle": 0.1, "inertia.left_end": 0.01, "inertia.right_end": 0.01},
])
def test_steady_heat_of_a_motion_that_diverges_is_refused_without_advice_on_cooling(drive, values):
    with pytest.raises(DifferentialError) as error:
        drive(values)
    text = str(error.value)
    assert "not periodic" in text and re.search(r"(carrier.speed|left.wheel_speed) has a mean of", text), text
    assert "raise warm_up" not in text and "shorten" not in text, text


@pytest.mark.parametrize("values", [
    {"scene.gear_contact": contact, **given} for contact in ("ideal", "lumped", "tooth") for given in (
        {"left.load_torque": 300.0, "right.load_torque": 300.0},
        {"left.load_torque": 300.0, "right.load_torque": 250.0, "scene.planet_spin": "imposed", "spin.command": 5.0},
        {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 42.0,
         "right.speed_command": 38.0, "carrier.torque_command": 600.0})])
@pytest.mark.parametrize("cycle", [0.01, 1.0])
def test_steady_heat_of_a_steady_motion_gives_no_warning(drive, values, cycle):
    contact = values["scene.gear_contact"]
    driven = drive({"scene.start": "steady_heat", "effects.warm_up": True, "effects.bearing_drag": True, "warm_up.cycle": cycle,
                    "effects.thrust_friction": contact != "ideal", "effects.tooth_friction": contact == "tooth", **values})
    assert not said(driven)


def test_steady_heat_of_a_part_of_a_mesh_cycle_names_the_heat(drive):
    """The mesh period 2π/(10 teeth 0.5 rad/s) is 1.26 s, so the heat of a fifth of a second depends on its phase in the period."""
    length = 0.2
    values = {"scene.gear_contact": "tooth", "effects.tooth_friction": True, "effects.warm_up": True, "scene.planet_spin": "imposed",
              "spin.command": 0.5, "left.load_torque": 800.0, "right.load_torque": 800.0, "warm_up.cycle": length}
    [warned] = said(drive(values | {"scene.start": "steady_heat"}))
    run = drive(values | {"scene.start": "equilibrium"}).to(length, length)
    heat = [run["heat.tooth_friction"]]
    for cycle in (2, 3):
        run.to(cycle * length, length)
        heat.append(run["heat.tooth_friction"])
    means = [(later - sooner) / length for sooner, later in zip(heat, heat[1:])]
    assert abs(means[1] - means[0]) > 0.1 * max(means)
    found = re.search(r"power.loss has a mean of ([-\d.e+]+) W over 0.2 s and of ([-\d.e+]+) W", warned)
    assert [float(each) for each in found.groups()] == pytest.approx(means, rel=0.02)
    assert "warm_up.cycle" in warned
    assert not said(drive(values | {"scene.start": "steady_heat", "warm_up.cycle": 2.0 * 3.141592653589793 / 5.0}))


def test_a_drive_begins_with_nodes_above_the_oil(drive):
    above = {"gears": 12.0, "clutch": 40.0, "washers": -5.0, "case": -20.0}
    driven = drive({"effects.warm_up": True, "oil.temperature": 330.0} | {f"warm_up.{node}_above_oil": k for node, k in above.items()})
    assert [driven[f"temperature.{node}"] for node in NODES] == [330.0, 342.0, 370.0, 325.0, 310.0]
    assert driven["warm_up.stored"] == 0.0
    driven.to(50.0, 1.0)
    # without friction, the stored heat has come from ambient, and the node temperatures approach each other
    assert driven["warm_up.stored"] == pytest.approx(-driven["warm_up.given_off"], rel=1e-9)
    assert abs(driven["temperature.clutch"] - driven["temperature.oil"]) < 0.5 * 40.0


def test_a_cooler_and_the_weather_are_inputs(drive):
    # without friction, the case follows ambient by 10 W/K and 0.1 W·s/(K·rad), and the oil has the temperature of the cooler
    values = {"effects.warm_up": True, "scene.gear_contact": "ideal", "warm_up.sump_given": True, "warm_up.oil_to_case": 0.0,
              "oil.temperature": 340.0, "warm_up.ambient_temperature": 300.0, "carrier.speed_command": 20.0}
    driven = drive(values | {"warm_up.ambient_change": 10.0, "warm_up.sump_change": -5.0})
    assert driven["temperature.oil"] == driven["temperature.case"] == 335.0
    rate = (10.0 + 0.1 * 20.0) / 6000.0
    # the midpoint rule deviates by (rate h)² rate t/12 of the difference: a few microkelvins
    driven.to(100.0, 1.0)
    assert driven["temperature.oil"] == 335.0
    case = 310.0 + 25.0 * exp(-rate * 100.0)
    assert driven["temperature.case"] == pytest.approx(case, abs=1e-5)
    driven.set({"warm_up.ambient_change": -60.0, "warm_up.sump_change": 20.0})
    driven.to(200.0, 1.0)
    assert driven["temperature.oil"] == 360.0
    assert driven["temperature.case"] == pytest.approx(240.0 + (case - 240.0) * exp(-rate * 100.0), abs=1e-5)
    kept = driven["warm_up.stored"] + driven["warm_up.given_off"]
    assert abs(kept) < 1e-9 * abs(driven["warm_up.given_off"])


def test_a_sump_follows_the_slope_of_its_input(drive):
    driven = drive({"effects.warm_up": True, "scene.gear_contact": "lumped", "warm_up.sump_given": True, "oil.temperature": 340.0})
    for k in range(1, 6):
        driven.set({"warm_up.sump_change": 3.0 * (k - 1)})
        driven.set_slopes({"warm_up.sump_change": 3.0})
        driven.step(1.0)
        assert driven["temperature.oil"] == pytest.approx(340.0 + 3.0 * k, rel=1e-12)


def test_outside_temperatures_beyond_the_range_are_limited_and_reported_once(drive):
    values = {"effects.warm_up": True, "scene.gear_contact": "ideal", "warm_up.sump_given": True, "warm_up.sump_change": 400.0}
    driven = drive(values).to(1.0, 0.1)
    assert driven["temperature.oil"] == 673.15
    [said] = [each for each in driven.messages if each.startswith("warm_up.sump_change: ")]
    assert all(word in said for word in ["the sump", "753.15 K", "673.15 K"])
