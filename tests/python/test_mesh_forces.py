"""Forces of a mesh against closed forms: normal force, thrusts, transmission error, levels without tooth pairs; and their
period."""

from math import cos, pi, radians, sin, tan

import numpy as np
import pytest
import theory
from driving import STEADY_TURN


@pytest.mark.parametrize("planets", [2, 4])
@pytest.mark.parametrize("law, force", [("impact", 16144.4), ("line", 15649.0), ("line_weber", 15649.0)])
def test_normal_force_of_a_mesh_under_each_law(run, law, force, planets):
    # held in the middle, where all pairs are on the path of contact
    record = run({"contact.law": law, "geometry.planet_count": planets, "scene.planet_spin": "imposed"}, stop=0.01,
                 output=["planet[1].left_normal_force", "planet[2].right_normal_force"])
    expected = force * 2.0 / planets
    assert record["planet[1].left_normal_force"][-1] == pytest.approx(expected, rel=5e-5)
    assert record["planet[2].right_normal_force"][-1] == pytest.approx(expected, rel=5e-5)


def thrusts(s):
    """Thrusts of side gear and planet per normal force at position s."""
    a, ds, dp = theory.PRESSURE_ANGLE, theory.SIDE_PITCH, theory.PLANET_PITCH
    return (sin(a) * sin(ds) * cos(s) - cos(ds) * sin(s), sin(a) * cos(ds) * cos(s) + sin(ds) * sin(s))


def centred_place():
    """Position on the path of a planet tooth in the middle between both flanks."""
    ratio = theory.SIDE_TEETH * cos(theory.PLANET_PITCH) / (theory.PLANET_TEETH * cos(theory.SIDE_PITCH))
    # the addenda of both gears add up to two modules
    x = 1.0 - (0.540 + 0.460 / ratio)
    half = (pi / 2.0 + 2.0 * x * tan(theory.PRESSURE_ANGLE)) / theory.PLANET_TEETH
    half -= theory.BACKLASH / (2.0 * theory.MODULE * theory.PLANET_TEETH)
    return half * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)


@pytest.mark.parametrize("planets", [2, 4])
def test_thrusts_follow_the_place_along_the_path(run, planets):
    names = ["planet[1].spin_angle", "planet[1].left_pairs", "planet[1].left_normal_force", "left.thrust_force",
             "left.normal_force"]
    record = run({**STEADY_TURN, "geometry.planet_count": planets}, stop=0.5, output=names)
    pitch = theory.TOOTH_PITCH * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)
    travel = record["planet[1].spin_angle"] * sin(theory.PLANET_PITCH) * cos(theory.PRESSURE_ANGLE)
    place = (centred_place() + travel + pitch / 2.0) % pitch - pitch / 2.0
    # one pair on the path, near the pitch point
    alone = (record["planet[1].left_pairs"] == 1.0) & (np.abs(place) < 0.08)
    assert alone.sum() > 50
    expected = np.array([thrusts(s)[0] for s in place[alone]])
    assert record["left.thrust_force"][alone] / record["left.normal_force"][alone] == pytest.approx(expected, rel=1e-6)
    # the textbook's values are for the pitch point
    force = theory.normal_force(planets)
    assert thrusts(0.0)[0] * force == pytest.approx(4682.4 * 2 / planets, rel=1e-4)
    assert thrusts(0.0)[1] * force == pytest.approx(2926.5 * 2 / planets, rel=1e-4)
    assert force == pytest.approx(16144.4 * 2 / planets, rel=1e-5)


def test_a_transmission_error_without_load_is_zero(run):
    for law in ("impact", "line", "line_weber"):
        record = run({"contact.law": law, "left.load_torque": 1e-3, "right.load_torque": 1e-3}, stop=0.002,
                     output=["planet[1].left_transmission_error"])
        assert 0.0 <= record["planet[1].left_transmission_error"][-1] < 2e-8


def test_a_lumped_mesh_is_a_spring_of_the_stiffness_that_is_given(run):
    record = run({"scene.gear_contact": "lumped", "contact.mesh_stiffness_from_geometry": False,
                  "contact.mesh_stiffness": 1.6e10}, stop=0.002, output=["planet[1].left_transmission_error"])
    arc = theory.LOAD / theory.PLANETS / theory.SIDE_LEVER / (1.6e10 * theory.FACE_MOMENT)
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
    spin = (moving["left.acceleration"] - moving["carrier.acceleration"]) / theory.RATIO
    # torques of the side gears on the planets differ by the torque that accelerates the planets
    difference = (moving["right.tangential_force"] - moving["left.tangential_force"]) * radius
    assert difference == pytest.approx(theory.PLANETS * 3e-5 / theory.RATIO * spin, rel=1e-9)


def test_a_steady_turn_repeats_itself_after_a_tooth_cycle(drive):
    spin, points, tolerance = radians(200.0), 20, 1e-9
    cycle = 2.0 * pi / 10.0 / spin
    scene, rows = drive(STEADY_TURN | {"solver.relative_tolerance": tolerance}), []
    names = [name for name, v in scene.fmu.variables.items() if v.causality == "output"
             and not name.startswith(("heat.", "solver.")) and not name.endswith(("angle", "].tooth"))]
    scene.to(2.0 * cycle, cycle / points)
    scene.to(4.0 * cycle, cycle / points, lambda s: rows.append(s.read(names)))
    one, other = np.array(rows[:points]), np.array(rows[points:])
    units = np.array([scene.fmu.variable(name).unit or "" for name in names])
    for column, name in enumerate(names):
        limit = 1e-5 * np.max(np.abs(one[:, units == units[column]]))
        if units[column] == "rad/s2":
            # ten tolerances of the speeds, times the 7.8 kHz at which meshes ring
            limit = 10.0 * tolerance * (1.0 + 2.0 * STEADY_TURN["carrier.speed_command"] + spin) * 2.0 * pi * 7800.0
        assert np.max(np.abs(other[:, column] - one[:, column])) <= limit, name
