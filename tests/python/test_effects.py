"""Effects on the packaged FMU: each against its closed form, and each without a trace when it is off."""

from math import cos, log, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

import theory

RATIO = theory.PLANET_TEETH / theory.SIDE_TEETH
TOOTH_PITCH = 2.0 * pi / theory.PLANET_TEETH
TURN = {"scene.planet_spin": "imposed", "carrier.speed_command": radians(954.0), "planet.spin_command": radians(200.0)}
EFFECTS = ["tooth_errors", "tooth_fault", "tooth_friction", "thrust_friction", "limited_slip", "half_shaft",
           "pin_compliance", "bearing_drag", "final_drive", "strength"]


# ---- forces --------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("planets", [2, 4])
@pytest.mark.parametrize("law, force", [("impact", 16144.4), ("line", 15649.0), ("line_weber", 15649.0)])
def test_normal_force_of_a_mesh_under_each_law(run, law, force, planets):
    record = run({"contact.law": law, "geometry.planet_count": planets}, stop=0.01,
                 output=["planet[1].left_normal_force", "planet[2].right_normal_force"])
    expected = force * 2.0 / planets
    assert record["planet[1].left_normal_force"][-1] == pytest.approx(expected, rel=5e-5)
    assert record["planet[2].right_normal_force"][-1] == pytest.approx(expected, rel=5e-5)


def thrusts(s):
    """Of side gear and planet per normal force at place s."""
    a, ds, dp = theory.PRESSURE_ANGLE, theory.SIDE_PITCH, theory.PLANET_PITCH
    return (sin(a) * sin(ds) * cos(s) - cos(ds) * sin(s), sin(a) * cos(ds) * cos(s) + sin(ds) * sin(s))


def centred_place():
    """Place on the path of a planet tooth in the middle between both flanks."""
    ratio = theory.SIDE_TEETH * cos(theory.PLANET_PITCH) / (theory.PLANET_TEETH * cos(theory.SIDE_PITCH))
    # addenda of both gears are two modules together
    x = 1.0 - (0.540 + 0.460 / ratio)
    half = (pi / 2.0 + 2.0 * x * tan(theory.PRESSURE_ANGLE)) / theory.PLANET_TEETH
    half -= theory.BACKLASH / (2.0 * theory.MODULE * theory.PLANET_TEETH)
    return half * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)


@pytest.mark.parametrize("planets", [2, 4])
def test_thrusts_straight_ahead(run, planets):
    record = run({"geometry.planet_count": planets}, stop=0.01, output=["left.thrust_force", "planet[1].thrust_force"])
    side, planet = thrusts(centred_place())
    force = theory.normal_force(planets)
    assert record["left.thrust_force"][-1] / planets == pytest.approx(side * force, rel=1e-4)
    assert record["planet[1].thrust_force"][-1] / 2.0 == pytest.approx(planet * force, rel=1e-4)
    # the figures of the straight state, two planets
    assert side * theory.normal_force(2) == pytest.approx(3914.0, rel=2e-3)
    assert planet * theory.normal_force(2) == pytest.approx(4116.0, rel=2e-3)


@pytest.mark.parametrize("planets", [2, 4])
def test_thrusts_follow_the_place_along_the_path(run, planets):
    names = ["planet[1].spin_angle", "planet[1].left_pairs", "planet[1].left_normal_force", "left.thrust_force",
             "left.normal_force"]
    record = run({**TURN, "geometry.planet_count": planets}, stop=0.5, output=names)
    pitch = TOOTH_PITCH * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)
    travel = record["planet[1].spin_angle"] * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)
    place = (centred_place() + travel + pitch / 2.0) % pitch - pitch / 2.0
    # one pair on the path, near the pitch point
    alone = (record["planet[1].left_pairs"] == 1.0) & (np.abs(place) < 0.08)
    assert alone.sum() > 50
    expected = np.array([thrusts(s)[0] for s in place[alone]])
    assert record["left.thrust_force"][alone] / record["left.normal_force"][alone] == pytest.approx(expected, rel=1e-6)
    # the textbook's values are those of the pitch point
    force = theory.normal_force(planets)
    assert thrusts(0.0)[0] * force == pytest.approx(4682.4 * 2 / planets, rel=1e-4)
    assert thrusts(0.0)[1] * force == pytest.approx(2926.5 * 2 / planets, rel=1e-4)
    assert force == pytest.approx(16144.4 * 2 / planets, rel=1e-5)


def test_a_transmission_error_without_load_is_zero(run):
    for law in ("impact", "line", "line_weber"):
        record = run({"contact.law": law, "left.load_torque": 1e-3, "right.load_torque": 1e-3}, stop=0.002,
                     output=["planet[1].left_transmission_error"])
        assert 0.0 <= record["planet[1].left_transmission_error"][-1] < 2e-8


# ---- lumped and ideal ----------------------------------------------------------------------------------------------

def test_a_lumped_mesh_is_a_spring_of_the_stiffness_that_is_given(run):
    outer, inner = theory.OUTER_CONE, theory.OUTER_CONE - theory.FACE_WIDTH
    moment = (outer**3 - inner**3) / 3.0
    record = run({"scene.gear_contact": "lumped", "contact.mesh_stiffness_from_geometry": False,
                  "contact.mesh_stiffness": 1.6e10}, stop=0.002, output=["planet[1].left_transmission_error"])
    arc = theory.LOAD / theory.PLANETS / theory.SIDE_LEVER / (1.6e10 * moment)
    assert record["planet[1].left_transmission_error"][-1] == pytest.approx(arc * theory.MEAN_CONE, rel=1e-6)


def test_the_ideal_differential_keeps_willis_and_shares_torque_equally(run):
    base = {"scene.gear_contact": "ideal", "inertia.from_geometry": False, "inertia.planet": 3e-5}
    names = ["left.speed", "right.speed", "carrier.speed", "left.tangential_force", "right.tangential_force",
             "left.acceleration", "carrier.acceleration"]
    steady = run(base, output=names)
    radius = theory.MODULE * theory.SIDE_TEETH / 2.0
    assert steady["left.speed"] + steady["right.speed"] == pytest.approx(2.0 * steady["carrier.speed"], rel=1e-12)
    assert steady["left.tangential_force"] == pytest.approx(steady["right.tangential_force"], rel=1e-12)
    moving = run({**base, "left.load_torque": 800.0, "inertia.left_end": 0.3, "inertia.right_end": 0.2}, output=names)
    assert np.ptp(moving["left.speed"]) > 10.0
    assert moving["left.speed"] + moving["right.speed"] == pytest.approx(2.0 * moving["carrier.speed"], rel=1e-12)
    spin = (moving["left.acceleration"] - moving["carrier.acceleration"]) / RATIO
    # torques that the side gears give to the planets differ by what these take to spin up
    difference = (moving["right.tangential_force"] - moving["left.tangential_force"]) * radius
    assert difference == pytest.approx(theory.PLANETS * 3e-5 / RATIO * spin, rel=1e-9)


# ---- dry friction --------------------------------------------------------------------------------------------------

BIAS = {"scene.carrier_drive": "torque", "carrier.torque_command": 1670.0, "carrier.speed_command": 50.0,
        "scene.left_drive": "speed", "scene.right_drive": "speed",
        "left.speed_command": 52.5, "right.speed_command": 47.5}
RADII = {"pin": 8e-3, "planet": 14e-3, "side": 22e-3}
PATH = ["left.shaft_torque", "right.shaft_torque", "left.thrust_force", "right.thrust_force", "planet[1].thrust_force",
        "planet[1].pin_force", "planet[1].spin_angle", "locking_value", "torque_bias_ratio"]


def over_whole_cycles(record, names, begin=0.3):
    """Means over whole mesh cycles after the start has settled."""
    cycle = record["planet[1].spin_angle"] / TOOTH_PITCH
    first = np.ceil(np.interp(begin, record["time"], cycle))
    last = np.floor(cycle[-1])
    assert last - first >= 4
    inside = (cycle >= first) & (cycle < last)
    return {name: record[name][inside].mean() for name in names}


def parts_of_bias(mean, mu):
    """Locking values of side washers, pins, planet washers, by the formula with the run's own averages."""
    thrust = 0.5 * (mean["left.thrust_force"] + mean["right.thrust_force"])
    torque = mean["left.shaft_torque"] + mean["right.shaft_torque"]
    side = 2.0 * mu * thrust * RADII["side"] / torque
    pins = theory.PLANETS / RATIO * mu * mean["planet[1].pin_force"] * RADII["pin"] / torque
    washers = theory.PLANETS / RATIO * mu * mean["planet[1].thrust_force"] * RADII["planet"] / torque
    return side, pins, washers


@pytest.mark.parametrize("law", ["impact", "line"])
def test_without_friction_a_differential_shares_torque_equally(run, law):
    record = run({**BIAS, "contact.law": law}, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    difference = abs(mean["left.shaft_torque"] - mean["right.shaft_torque"])
    assert difference / (mean["left.shaft_torque"] + mean["right.shaft_torque"]) < 2e-3
    assert record["locking_value"][-1] < 2e-3


@pytest.mark.parametrize("part", range(3))
@pytest.mark.parametrize("law", ["impact", "line"])
def test_each_surface_locks_by_its_formula(run, part, law):
    mu = 0.05
    off = {"thrust_friction.side_washer_radius": 0.0, "thrust_friction.pin_radius": 0.0,
           "thrust_friction.planet_washer_radius": 0.0}
    name, radius = [("side_washer_radius", "side"), ("pin_radius", "pin"), ("planet_washer_radius", "planet")][part]
    values = {**BIAS, **off, f"thrust_friction.{name}": RADII[radius], "contact.law": law,
              "effects.thrust_friction": True}
    record = run(values, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    measured = (mean["right.shaft_torque"] - mean["left.shaft_torque"]) / (
        mean["left.shaft_torque"] + mean["right.shaft_torque"])
    expected = parts_of_bias(mean, mu)[part]
    assert measured == pytest.approx(expected, rel=0.03)
    # the textbook's value is that of the pitch point
    textbook = [0.01234, 0.02326, 0.00785][part]
    assert expected == pytest.approx(textbook, rel=0.25)
    assert record["locking_value"][-1] == pytest.approx(expected, rel=0.05)


def test_teeth_lock_by_the_losses_of_their_path(run):
    mu = 0.05
    record = run({**BIAS, "effects.tooth_friction": True, "tooth_friction.regularisation_speed": 1e-5}, stop=1.5,
                 output=PATH + ["heat.tooth_friction"])
    mean = over_whole_cycles(record, PATH)
    total = mean["left.shaft_torque"] + mean["right.shaft_torque"]
    measured = (mean["right.shaft_torque"] - mean["left.shaft_torque"]) / total
    # loss factor from the heat: H = mu H_v T (|dw_L| + |dw_R|) over whole cycles
    cycle = record["planet[1].spin_angle"] / TOOTH_PITCH
    bounds = np.ceil(np.interp(0.3, record["time"], cycle)), np.floor(cycle[-1])
    heat = np.diff(np.interp(bounds, cycle, record["heat.tooth_friction"]))[0]
    turned = 2.0 * (bounds[1] - bounds[0]) * TOOTH_PITCH * RATIO
    loss_factor = heat / (mu * total / 2.0 * turned)
    assert measured == pytest.approx(mu * loss_factor, rel=0.03)
    # IMPACT's load sharing gives 0.267, the planar formula 0.2391
    assert loss_factor == pytest.approx(0.267, rel=0.03)


@pytest.mark.parametrize("mu, ratio", [(0.05, 1.117), (0.08, 1.195), (0.10, 1.249)])
def test_all_friction_together_is_near_the_textbook_s_bias_ratio(run, mu, ratio):
    record = run({**BIAS, "effects.thrust_friction": True, "effects.tooth_friction": True,
                  "thrust_friction.coefficient": mu, "thrust_friction.pin_coefficient": mu,
                  "tooth_friction.coefficient": mu}, stop=1.5, output=PATH)
    mean = over_whole_cycles(record, PATH)
    measured = mean["right.shaft_torque"] / mean["left.shaft_torque"]
    # path averages differ from the pitch point's values by some per cent of the bias
    assert measured - 1.0 == pytest.approx(ratio - 1.0, rel=0.1)
    assert record["torque_bias_ratio"][-1] == pytest.approx(measured, rel=0.01)


def started(opened, **values):
    for name, value in values.items():
        opened.set(name, value)
    opened.initialise()


def walk(opened, stop, step=1e-3, begin=0.0):
    for k in range(round((stop - begin) / step)):
        opened.fmu.doStep(begin + k * step, step)


def test_a_stuck_differential_carries_any_bias_up_to_its_friction(open_fmu):
    # lumped teeth have no cogging, so that friction alone holds
    base = {"scene.gear_contact": "lumped", "effects.thrust_friction": True}
    with open_fmu() as slipping:
        started(slipping, **base, **{**BIAS, "right.speed_command": 47.5})
        walk(slipping, 1.0)
        limit = slipping.get("locking_value")
    for share, holds in ((0.5, True), (0.9, True), (0.98, True), (1.05, False)):
        with open_fmu() as opened:
            extra = share * limit * 835.0
            started(opened, **base, **{"left.load_torque": 835.0, "right.load_torque": 835.0})
            walk(opened, 0.2)
            opened.set("left.load_torque", 835.0 + extra)
            opened.set("right.load_torque", 835.0 - extra)
            walk(opened, 0.6, begin=0.2)
            difference = opened.get("left.speed") - opened.get("right.speed")
            if holds:
                assert abs(difference) < 1e-6, share
                assert opened.get("locking_value") == pytest.approx(share * limit, rel=1e-6)
            else:
                assert abs(difference) > 1.0


def test_shafts_keep_their_twist_when_both_wheels_come_to_the_same_speed(open_fmu):
    with open_fmu() as opened:
        started(opened, **BIAS, **{"scene.gear_contact": "lumped", "effects.thrust_friction": True})
        walk(opened, 1.0)
        sliding = opened.get("locking_value")
        for side in ("left", "right"):
            opened.set(f"{side}.speed_command", 50.0)
        walk(opened, 2.0, begin=1.0)
        kept = opened.get("right.shaft_torque") - opened.get("left.shaft_torque")
        # the bias stays, at most at what friction holds, and does not creep away
        assert 0.0 < kept / 1670.0 <= sliding * 1.001
        walk(opened, 12.0, step=1e-2, begin=2.0)
        assert opened.get("right.shaft_torque") - opened.get("left.shaft_torque") == pytest.approx(kept, rel=1e-6)
        assert opened.get("held.sides") == 2.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_limited_slip_below_its_lock_torque_does_not_creep(open_fmu, contact):
    with open_fmu() as opened:
        started(opened, **{"scene.gear_contact": contact, "effects.limited_slip": True, "limited_slip.preload": 100.0,
                           "limited_slip.torque_coefficient": 0.0, "left.load_torque": 835.0 + 90.0,
                           "right.load_torque": 835.0 - 90.0})
        walk(opened, 0.5)
        wound_up = [opened.get(f"{side}.angle") - opened.get("carrier.angle") for side in ("left", "right")]
        walk(opened, 10.5, step=1e-2, begin=0.5)
        after = [opened.get(f"{side}.angle") - opened.get("carrier.angle") for side in ("left", "right")]
        assert after == pytest.approx(wound_up, abs=1e-6)
        assert opened.get("held.sides") == 2.0
        # and above it slips: the lighter side runs away with what is left of the torque
        for side, sign in (("left", 1.0), ("right", -1.0)):
            opened.set(f"{side}.load_torque", 835.0 + sign * 150.0)
        walk(opened, 10.6, begin=10.5)
        assert opened.get("right.speed") > opened.get("left.speed") + 1.0


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_locked_differential_turns_as_one(open_fmu, contact):
    with open_fmu() as opened:
        started(opened, **{"scene.gear_contact": contact, "left.load_torque": 1600.0, "right.load_torque": 70.0,
                           "lock.command": 1.0, "inertia.left_end": 0.5, "inertia.right_end": 0.5})
        walk(opened, 0.5)
        carrier = opened.get("carrier.speed")
        assert opened.get("left.speed") == pytest.approx(carrier, rel=1e-6)
        assert opened.get("right.speed") == pytest.approx(carrier, rel=1e-6)
        # opened again, the lighter side runs ahead by its closed form
        opened.set("lock.command", 0.0)
        walk(opened, 0.51, begin=0.5)
        assert opened.get("right.speed") > carrier + 5.0
        assert opened.get("left.speed") < carrier - 5.0


def test_an_ideal_limited_slip_accelerates_the_ends_by_its_closed_form(open_fmu):
    end, preload = 0.5, 60.0
    with open_fmu() as opened:
        started(opened, **{"scene.gear_contact": "ideal", "effects.limited_slip": True, "limited_slip.preload": preload,
                           "limited_slip.torque_coefficient": 0.0, "inertia.left_end": end, "inertia.right_end": end,
                           "inertia.from_geometry": False, "inertia.side_gear": 1e-4, "inertia.planet": 2e-5,
                           "left.load_torque": 1000.0, "right.load_torque": 600.0})
        walk(opened, 0.1)
        begin = opened.get("right.speed")
        walk(opened, 0.3, begin=0.1)
        # r (T_L - T_R) less the friction of both clutches over the inertia of the relative motion
        relative = 2.0 * RATIO * (end + 1e-4) + theory.PLANETS * 2e-5 / RATIO
        acceleration = (0.5 * 400.0 - preload) * 2.0 / relative * RATIO
        assert opened.get("right.speed") - begin == pytest.approx(acceleration * 0.2, rel=1e-6)


# ---- shafts, pins, drag, excitation, a broken tooth ----------------------------------------------------------------

def test_a_half_shaft_twists_by_its_stiffness_and_swings_with_its_end(open_fmu):
    # soft against the teeth, which give way too
    stiffness, inertia, extra = 1e3, 0.5, 50.0
    base = {"effects.half_shaft": True, "half_shaft.left_stiffness": stiffness, "half_shaft.left_damping": 0.0, "scene.planet_spin": "imposed"}
    with open_fmu() as opened:
        started(opened, **base)
        assert opened.get("left.twist") == pytest.approx(theory.LOAD / stiffness, rel=1e-12)
    with open_fmu() as opened:
        started(opened, **base, **{"inertia.left_end": inertia, "contact.law": "line"})
        assert opened.get("left.twist") == pytest.approx(theory.LOAD / stiffness, rel=1e-6)
        opened.set("left.load_torque", theory.LOAD + extra)
        period = 2.0 * pi * sqrt(inertia / stiffness)
        times = np.arange(1, 200) * period / 100.0
        twist = []
        for k, time in enumerate(times):
            opened.fmu.doStep(k * period / 100.0, period / 100.0)
            twist.append(opened.get("left.twist"))
        expected = (theory.LOAD + extra * (1.0 - np.cos(2.0 * pi * times / period))) / stiffness
        assert np.abs(np.array(twist) - expected).max() < 0.05 * extra / stiffness


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
def test_pins_and_case_give_way_in_series_with_the_teeth(run, contact):
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
    # the seat moves all slices alike, so that it acts at the cone distance of the resultant
    outer, inner = theory.OUTER_CONE, theory.OUTER_CONE - theory.FACE_WIDTH
    resultant = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2)
    assert wind_up == pytest.approx(pins + seat / resultant, rel=0.01)


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


@pytest.mark.parametrize("contact", ["ideal", "tooth"])
def test_the_final_drive_excites_the_carrier_with_its_mesh_order(run, contact):
    base = {"effects.final_drive": True, "final_drive.ring_teeth": 41, "final_drive.amplitude": 0.03,
            "scene.gear_contact": contact}
    record = run(base, stop=0.05, step=2e-4, output=["carrier.speed", "carrier.angle"])
    speed = radians(2861.0)
    expected = speed * (1.0 + 0.03 * np.cos(41.0 * record["carrier.angle"]))
    assert record["carrier.speed"] == pytest.approx(expected, rel=1e-5)
    record = run({**base, "scene.carrier_drive": "torque", "inertia.left_end": 1.0, "inertia.right_end": 1.0}, stop=0.05,
                 step=2e-4, output=["carrier.torque", "carrier.angle"])
    expected = 1670.0 * (1.0 + 0.03 * np.sin(41.0 * record["carrier.angle"]))
    assert record["carrier.torque"] == pytest.approx(expected, rel=1e-9)


def test_a_chipped_tooth_shows_once_per_revolution_of_its_planet_in_each_mesh(run):
    names = ["planet[1].left_transmission_error", "planet[1].right_transmission_error", "planet[1].spin_angle"]
    base = {**TURN, "planet.spin_command": 10.0, "contact.law": "line"}
    stop = 2.0 * pi / 10.0
    sound = run(base, stop=stop, output=names)
    broken = run({**base, "effects.tooth_fault": True, "tooth_fault.onset": 1e-9, "tooth_fault.tooth": 3,
                  "tooth_fault.missing_fraction": 0.3}, stop=stop, output=names)
    for name in names[:2]:
        deeper = np.abs(broken[name] - sound[name]) > 3e-6
        # the tooth is in contact for the contact ratio's share of a revolution's ten pitches
        assert 0.08 < deeper.mean() < 0.25, name
        begins = np.flatnonzero(np.diff(deeper.astype(int)) == 1)
        gaps = np.diff(broken["time"][begins]) > 0.5 * stop / 10.0
        assert gaps.sum() <= 1, name


def test_restitution_damping_takes_less_the_nearer_it_is_to_one(run):
    lost = []
    for restitution in (0.3, 0.7, 0.95):
        record = run({**TURN, "contact.damping_model": "restitution", "contact.restitution": restitution,
                      "contact.impact_speed": 0.01, "scene.start": "rolling", "solver.relative_tolerance": 1e-5},
                     stop=0.02, output=["heat.contact", "solver.energy_residual"])
        lost.append(record["heat.contact"][-1])
        assert abs(record["solver.energy_residual"][-1]) < 1e-3 * record["heat.contact"][-1]
    assert lost[0] > 0.0 and all(np.isfinite(lost))


# ---- strength ------------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("planets, pressure", [(4, 1686e6), (2, 2385e6)])
def test_hertz_pressure_at_the_pitch_point_of_the_mean_section(run, planets, pressure):
    record = run({"effects.strength": True, "geometry.planet_count": planets}, stop=0.002,
                 output=["stress.contact_pitch", "stress.contact_max"])
    assert record["stress.contact_pitch"][-1] == pytest.approx(pressure, rel=0.02)
    # where the pair really touches, closer to the planet's tip, the planet's flank is flatter and the side gear's sharper
    assert record["stress.contact_max"][-1] == pytest.approx(pressure, rel=0.15)


def test_damage_counts_relative_revolutions_and_nothing_without_them(run):
    names = ["damage.planet", "damage.side", "stress.root_planet_max", "stress.root_side_max", "planet[1].spin_angle",
             "planet[1].left_normal_force", "planet[1].right_normal_force"]
    straight = run({"effects.strength": True}, output=names)
    assert straight["damage.planet"][-1] == 0.0
    assert straight["damage.side"][-1] == 0.0
    turn = run({**TURN, "effects.strength": True, "planet.spin_command": 20.0}, stop=2.0, output=names)
    # Miner's sum at a constant stress: each side gear loads another flank of a planet's tooth once a revolution,
    # N planets the same flank of a side gear's tooth
    slope = log(3e6 / 1e3) / log(2.5)
    turns = abs(turn["planet[1].spin_angle"][-1]) / (2.0 * pi)
    forces = {side: turn[f"planet[1].{side}_normal_force"] for side in ("left", "right")}
    largest = np.maximum(forces["left"], forces["right"])

    def worst(stress, strength):
        return max(np.mean((stress * force / largest) ** slope) for force in forces.values()) / strength**slope

    planet = turns / 3e6 * worst(turn["stress.root_planet_max"], 700e6)
    side = turns * RATIO * theory.PLANETS / 3e6 * worst(turn["stress.root_side_max"], 1000e6)
    assert turn["damage.planet"][-1] == pytest.approx(planet, rel=0.02)
    assert turn["damage.side"][-1] == pytest.approx(side, rel=0.02)


# ---- switches ------------------------------------------------------------------------------------------------------

OUTPUTS = ["left.angle", "left.speed", "left.acceleration", "left.shaft_torque", "left.thrust_force", "right.speed",
           "carrier.torque", "carrier.acceleration", "planet[1].spin_angle", "planet[1].left_normal_force",
           "planet[2].right_normal_force", "planet[1].left_transmission_error", "heat.contact", "solver.steps",
           "solver.energy_residual", "locking_value", "stress.contact_max", "damage.planet"]


def other_value(variable):
    """A value of a parameter that is neither its start value nor out of range."""
    if variable.type == "Boolean":
        return variable.start != "true"
    if variable.type == "Enumeration":
        return len(variable.declaredType.items)
    start, low, high = (float(x) for x in (variable.start, variable.min, variable.max))
    value = start * 1.37 + 1e-3 * (high - low) if start * 1.37 + 1e-3 * (high - low) <= high else 0.5 * (low + start)
    return int(min(start + 1, high) if start < high else start - 1) if variable.type == "Integer" else value


@pytest.fixture(scope="module")
def plain(run):
    return {"turn": run(TURN, stop=0.2, output=OUTPUTS), "straight": run({}, stop=0.05, output=OUTPUTS)}


@pytest.mark.parametrize("effect", EFFECTS + ["lock"])
def test_what_is_off_leaves_no_trace(run, plain, description, effect):
    own = [v for v in description.modelVariables if v.name.startswith(effect + ".") and v.causality == "parameter"]
    assert len(own) >= 2
    values = {v.name: other_value(v) for v in own if v.type != "Enumeration"}
    for name, base, stop in (("turn", TURN, 0.2), ("straight", {}, 0.05)):
        record = run({**base, **values}, stop=stop, output=OUTPUTS)
        for output in OUTPUTS:
            assert np.array_equal(record[output], plain[name][output]), (output, name)


ON = {"tooth_errors": {"tooth_errors.accuracy_grade": 7, "tooth_errors.planet_tip_relief": 20e-6,
                       "tooth_errors.crowning": 10e-6, "contact.law": "line"},
      "tooth_fault": {"tooth_fault.onset": 0.05, "contact.law": "line"},
      "limited_slip": {"inertia.left_end": 0.2, "inertia.right_end": 0.2},
      "half_shaft": {"inertia.left_end": 0.2, "inertia.right_end": 0.2},
      "strength": {}}


@pytest.mark.parametrize("effect", EFFECTS)
def test_what_is_on_keeps_its_books(run, plain, effect):
    names = OUTPUTS + ["carrier.speed", "power.in"]
    record = run({**TURN, **ON.get(effect, {}), f"effects.{effect}": True}, stop=0.2, output=names)
    exchanged = 2.0 * theory.LOAD * radians(954.0) * 0.2
    assert abs(record["solver.energy_residual"][-1]) < 1e-5 * exchanged
    changed = [o for o in OUTPUTS if not np.array_equal(record[o], plain["turn"][o])]
    assert changed
    for output in names:
        assert np.isfinite(record[output]).all()


@pytest.mark.parametrize("planets", [2, 4])
@pytest.mark.parametrize("law", ["impact", "line"])
def test_planets_simulated_once_give_the_bits_of_all_simulated(run, planets, law):
    base = {**TURN, "geometry.planet_count": planets, "contact.law": law}
    once = run(base, stop=0.2, output=OUTPUTS)
    each = run({**base, "solver.merge_planets": False}, stop=0.2, output=OUTPUTS)
    for output in OUTPUTS:
        assert np.array_equal(once[output], each[output]), output


# ---- wrong combinations --------------------------------------------------------------------------------------------

WRONG = [
    ({"scene.planet_spin": "imposed", "scene.left_drive": "speed", "scene.right_drive": "speed",
      "scene.carrier_drive": "torque"}, "scene.planet_spin"),
    ({"scene.left_drive": "speed", "scene.right_drive": "speed"}, "scene.carrier_drive"),
    ({"scene.left_drive": "speed", "half_shaft.left_stiffness": 0.0}, "half_shaft.left_stiffness"),
    ({"scene.gear_contact": "ideal", "effects.thrust_friction": True}, "effects.thrust_friction"),
    ({"scene.gear_contact": "ideal", "effects.limited_slip": True}, "limited_slip.torque_coefficient"),
    ({"scene.gear_contact": "lumped", "effects.tooth_friction": True}, "effects.tooth_friction"),
    ({"scene.gear_contact": "lumped", "effects.tooth_errors": True}, "effects.tooth_errors"),
    ({"contact.stiffness_from_hertz": True, "contact.exponent": 2.0}, "contact.exponent"),
    ({"effects.tooth_fault": True, "tooth_fault.tooth": 10}, "tooth_fault.tooth"),
]


@pytest.mark.parametrize("values, name", WRONG)
def test_wrong_combinations_are_refused_by_name(open_fmu, values, name):
    with open_fmu() as opened:
        for key, value in values.items():
            opened.set(key, value)
        with pytest.raises(Exception):
            opened.initialise()
        assert any(name in line for line in opened.log), opened.log


# ---- state ---------------------------------------------------------------------------------------------------------

def test_a_state_with_stuck_clutches_and_a_broken_tooth_is_restored_to_the_bit(open_fmu):
    values = {"effects.limited_slip": True, "effects.tooth_fault": True, "effects.half_shaft": True,
              "inertia.left_end": 0.1, "inertia.right_end": 0.1, "contact.law": "line", "effects.strength": True,
              "left.load_torque": 900.0}
    with open_fmu() as opened:
        started(opened, **values)
        walk(opened, 0.05)
        opened.set("fault.trigger", 1.0)
        walk(opened, 0.1, begin=0.05)
        state = opened.fmu.getFMUstate()
        kept = opened.fmu.serializeFMUstate(state)
        walk(opened, 0.2, begin=0.1)
        first = [opened.get(name) for name in OUTPUTS]
        opened.fmu.setFMUstate(state)
        walk(opened, 0.2, begin=0.1)
        assert [opened.get(name) for name in OUTPUTS] == first
        opened.fmu.freeFMUstate(state)
    with open_fmu() as other:
        started(other, **values)
        state = other.fmu.deSerializeFMUstate(kept)
        other.fmu.setFMUstate(state)
        walk(other, 0.2, begin=0.1)
        assert [other.get(name) for name in OUTPUTS] == first
        other.fmu.freeFMUstate(state)


# ---- conduct -------------------------------------------------------------------------------------------------------

def test_a_friction_law_outside_its_range_warns_once(open_fmu):
    with open_fmu() as opened:
        started(opened, **TURN, **{"effects.tooth_friction": True, "tooth_friction.law": "xu_kahraman"})
        walk(opened, 0.02)
        told = [line for line in opened.log if "tooth_friction.law" in line]
        assert len(told) == 1 and "outside" in told[0], opened.log
    with open_fmu() as opened:
        started(opened, **TURN, **{"effects.tooth_friction": True})
        walk(opened, 0.02)
        assert not any("tooth_friction" in line for line in opened.log)


def test_stresses_above_the_strength_warn_once_each(open_fmu):
    with open_fmu() as opened:
        started(opened, **{"effects.strength": True, "strength.bending_strength": 1e7, "strength.contact_strength": 1e8})
        walk(opened, 0.02)
        warnings = [line for line in opened.log if "exceeds the strength" in line]
        gears = ["root stress of planet[1]", "root stress of the left side gear", "contact stress between planet[1]"]
        assert len(warnings) == 3 and all(any(gear in line for line in warnings) for gear in gears), opened.log
        assert all("at t = " in line and "MPa" in line for line in warnings)
    with open_fmu() as opened:
        started(opened, **{"effects.strength": True, "strength.bending_strength": 1e11,
                           "strength.contact_strength": 1e11})
        walk(opened, 0.02)
        assert not any("exceeds the strength" in line for line in opened.log)


def test_pins_and_washers_that_do_not_fit_the_gears_warn(open_fmu):
    small = {"geometry.module": 2.25e-3, "geometry.face_width": 10e-3, "effects.thrust_friction": True}
    for values, expected in [({}, 3), ({"thrust_friction.radii_from_geometry": True}, 0)]:
        with open_fmu() as opened:
            started(opened, **small, **values)
            assert sum("radii_from_geometry" in line for line in opened.log) == expected, opened.log


@pytest.mark.parametrize("law", ["benedict_kelley", "iso_14179", "xu_kahraman"])
def test_published_friction_laws_lose_what_their_coefficients_say(run, law):
    record = run({**TURN, "effects.tooth_friction": True, "tooth_friction.law": law}, stop=0.36,
                 output=["heat.tooth_friction", "solver.energy_residual"])
    # mu H_v T |dw| of both sides, H_v = 0.267 on the path; all three lie between 0.02 and 0.2 here
    per_mu = 0.267 * 2.0 * theory.LOAD * radians(200.0) * RATIO * 0.36
    assert 0.02 < record["heat.tooth_friction"][-1] / per_mu < 0.2
    assert abs(record["solver.energy_residual"][-1]) < 1e-3 * record["heat.tooth_friction"][-1]


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
def test_a_clutch_that_slides_and_sticks_does_not_feel_the_communication_step(open_fmu, contact):
    """Bodies turn by many tooth pitches within one step, slide, come to the carrier's speed, and are held there."""
    ends = []
    for step in (1e-3, 0.25):
        with open_fmu() as opened:
            started(opened, **{"scene.gear_contact": contact, "effects.limited_slip": True,
                               "limited_slip.preload": 100.0, "limited_slip.torque_coefficient": 0.0,
                               "inertia.left_end": 0.5, "inertia.right_end": 0.5})
            for begin, difference in ((0.0, 150.0), (0.5, -30.0), (1.5, 60.0)):
                opened.set("left.load_torque", 835.0 + difference)
                opened.set("right.load_torque", 835.0 - difference)
                walk(opened, begin + (0.5 if begin == 0.0 else 1.0), step=step, begin=begin)
            assert opened.get("held.sides") == 2.0
            assert abs(opened.get("left.speed") - opened.get("right.speed")) < 1e-3
            ends.append([opened.get(name) for name in ("left.angle", "right.angle", "heat.clutch", "solver.steps")])
            assert abs(opened.get("solver.energy_residual")) < 1e-3 * opened.get("heat.clutch")
    fine, coarse = ends
    assert coarse[:2] == pytest.approx(fine[:2], abs=1e-3)
    assert coarse[2] == pytest.approx(fine[2], rel=1e-3)
    # no chatter
    assert coarse[3] < 5e3
