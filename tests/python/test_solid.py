"""Solid teeth: they converge to tooth pairs on the path of contact, balance their energy, and are restored to the bit."""

import numpy as np
import pytest
import theory
from driving import CARRIER, SIDES, TURN, UNDAMPED, Drive
from refusals import refused_start

SOLID = {"scene.gear_contact": "solid"}
STEADY = TURN | {"scene.start": "equilibrium", "solver.relative_tolerance": 1e-8}
FORCES = [f"planet[1].{side}_normal_force" for side in SIDES]
WATCHED = FORCES + [f"{side}.speed" for side in SIDES] + ["planet[1].left_transmission_error"]
MISALIGNED = {"effects.tooth_errors": True, "tooth_errors.shaft_angle_error": 1e-3,
              "tooth_errors.planet_axial_offset": 5e-5, "tooth_errors.side_axial_offset": -3e-5,
              "tooth_errors.axis_offset": 8e-5, "tooth_errors.crowning": 1.5e-5}


@pytest.fixture(scope="module")
def turn(fmu):
    """turn(facets): outputs every millisecond over a mesh cycle of the study's turn; 0 facets are tooth pairs on the path of contact."""
    kept = {}

    def record(facets):
        if facets not in kept:
            level, rows = SOLID | {"solid.facets": facets} if facets else {}, []
            with Drive(fmu, STEADY | level) as driven:
                # one mesh cycle of 5.556 Hz
                driven.to(0.18, 1e-3, lambda d: rows.append(d.read(WATCHED)))
            kept[facets] = np.array(rows)
        return kept[facets]

    return record


def ripple(record):
    """ripple(record)(facets, part): effect of facets on forces and speeds, as rms of the difference to 0 facets over the mean."""
    def of(facets, part):
        off = record(facets)[:, part] - record(0)[:, part]
        return np.sqrt((off**2).mean()) / np.abs(record(0)[:, part]).mean()
    return of


def test_mean_force_is_that_of_tooth_pairs_within_one_percent_at_32_facets_and_a_tenth_at_128(turn):
    exact = turn(0)[:, :2].mean(axis=0)
    assert np.all(np.abs(turn(32)[:, :2].mean(axis=0) / exact - 1.0) < 0.01)
    assert np.all(np.abs(turn(128)[:, :2].mean(axis=0) / exact - 1.0) < 0.001)


def test_straight_ahead_the_normal_force_is_the_torque_over_the_base_circle_s_lever(drive):
    for facets, within in [(32, 1e-2), (128, 1e-3)]:
        driven = drive(SOLID | {"solid.facets": facets}).to(0.02, 1e-3)
        for name in FORCES:
            assert driven[name] == pytest.approx(theory.normal_force(), rel=within)
        for side in SIDES:
            assert driven[f"{side}.speed"] == pytest.approx(CARRIER, rel=1e-6)
            assert driven[f"{side}.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)


@pytest.mark.parametrize("part, order", [(slice(0, 2), 1.0), (slice(2, 4), 1.0), (slice(4, 5), 1.5)],
                         ids=["force", "speed", "deflection"])
def test_the_effect_of_facets_falls_with_their_number_at_the_expected_order(turn, part, order):
    """Arc heights over facets determine deflections and fall with the square of the number of facets. Tip corners add a logarithm:
    the patch there is on one side of the corner, and its part of the sum falls with the softness. Slopes determine forces and speeds.
    They fall with the number, and faster where the patch smooths them."""
    of = ripple(turn)
    values = np.array([of(facets, part) for facets in (8, 16, 32, 64)])
    assert np.all(np.diff(values) < 0.0), values
    assert np.log2(values[1] / values[3]) / 2.0 > order, values


@pytest.mark.parametrize("values", [{}, MISALIGNED], ids=["aligned", "misaligned"])
def test_a_state_in_mid_contact_is_restored_to_the_bit_here_and_in_another_instance(drive, outputs, values):
    scene = TURN | SOLID | values | {"solid.facets": 32}
    driven = drive(scene).to(0.02, 1e-3)
    kept = driven.save()
    first = driven.to(0.03, 1e-3).read(outputs)
    assert driven.restore(kept).to(0.03, 1e-3).read(outputs) == first
    assert drive(scene).restore(kept).to(0.03, 1e-3).read(outputs) == first


@pytest.mark.parametrize("values", [{}, MISALIGNED], ids=["aligned", "misaligned"])
def test_energy_is_kept_without_damping(drive, values):
    driven = drive(STEADY | SOLID | values | {"contact.damping": 0.0, "solver.relative_tolerance": 1e-6}).to(0.02, 1e-3)
    assert driven.imbalance() < UNDAMPED


def test_misaligned_forces_balance(drive):
    driven = drive(SOLID | MISALIGNED).to(0.05, 1e-3)
    for side in SIDES:
        assert driven[f"{side}.shaft_torque"] == pytest.approx(835.0, rel=1e-6)
        assert driven[f"{side}.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    assert driven["carrier.torque"] == pytest.approx(2.0 * 835.0, rel=1e-6)
    # the planet whose offset moves it ahead takes nearly all the load
    first, second = ([driven[f"planet[{i}].{side}_normal_force"] for side in SIDES] for i in (1, 2))
    assert min(first) > 100.0 * max(second) >= 0.0
    assert driven.imbalance() < UNDAMPED


def test_planets_that_are_alike_are_simulated_once_and_give_the_same_bits(drive):
    scene = TURN | SOLID | {"solid.facets": 16, "geometry.planet_count": 4}
    once, each = (drive(scene | {"solver.merge_planets": merged}).to(0.01, 1e-3) for merged in (True, False))
    for name in WATCHED + ["carrier.torque", "power.loss", "left.acceleration"]:
        assert once[name] == each[name], name


@pytest.mark.parametrize("teeth", [(9, 14), (10, 15), (14, 14)])
def test_other_gears_and_reversals_of_load_run(drive, teeth):
    planets = 3 if teeth[1] == 15 else 2
    driven = drive(SOLID | {"geometry.planet_teeth": teeth[0], "geometry.side_teeth": teeth[1],
                            "geometry.planet_count": planets, "scene.planet_spin": "imposed",
                            "spin.command": 3.0, "scene.start": "rolling"}).to(0.05, 1e-3)
    driven.load(-400.0)
    driven.to(0.15, 1e-3)
    ratio = teeth[0] / teeth[1]
    assert driven["left.speed"] == pytest.approx(CARRIER + ratio * 3.0, rel=2e-3)
    assert driven["right.speed"] == pytest.approx(CARRIER - ratio * 3.0, rel=2e-3)
    assert np.isfinite(driven["solver.energy_residual"])


@pytest.mark.parametrize("values, name", [
    ({"contact.law": "line"}, "contact.law"),
    ({"effects.corner_contact": False}, "effects.corner_contact"),
    ({"effects.tooth_friction": True}, "effects.tooth_friction"),
    ({"effects.pin_compliance": True}, "effects.pin_compliance"),
    ({"effects.tooth_errors": True, "tooth_errors.accuracy_grade": 6}, "tooth_errors.accuracy_grade"),
    ({"solid.facets": 1}, "solid.facets"),
])
def test_settings_that_solid_teeth_do_not_support_are_refused_by_name(fmu, values, name):
    refused_start(fmu, SOLID | values, name)
