"""Elastic mesh of the final drive: lash, excitation by its error, loss of contact, and two lashes in series."""

from math import degrees, pi, sqrt

import numpy as np
import pytest
from final_drive_reference import LumpedMesh, Rattle, ToothMesh, TwoLashes, forced_amplitude
from final_drive_scenes import DRIVEN, ELASTIC, RATIO, loads, sampled, turning_inertia

RADIUS = 0.09
# both wheels stand still behind stiff half-shafts
HELD = {"scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 0.0, "right.speed_command": 0.0,
        "pinion.speed_command": 0.0}


def test_lash_at_the_pinion_is_that_of_the_differential_and_that_of_the_final_drive(started):
    shafts = {f"half_shaft.{side}_{what}": value for side in ("left", "right") for what, value in (("stiffness", 2e4), ("damping", 60.0))}
    scene = ELASTIC | DRIVEN | HELD | shafts | {"scene.gear_contact": "lumped", "solver.relative_tolerance": 1e-10}
    names = ["pinion.angle", "carrier.angle", "left.angle"]
    opened = started(scene | {"pinion.torque_command": 10.0})
    places = []
    for torque in (10.0, 20.0, -20.0, -10.0):
        opened.set({"pinion.torque_command": torque})
        opened.step(0.5)
        assert np.abs(opened.read(["pinion.speed", "carrier.speed", "left.speed"])).max() < 1e-9
        places.append(np.array(opened.read(names)) / [RATIO, 1.0, 1.0])
    # the springs are linear, so the angles at 10 and 20 N.m continue to those without torque
    forward, backward = 2.0 * places[0] - places[1], 2.0 * places[3] - places[2]
    free = RATIO * (forward - backward)
    assert degrees(free[1] - free[2]) == pytest.approx(0.6525, abs=5e-5)
    assert degrees(free[0] - free[1]) == pytest.approx(0.3132, abs=5e-5)
    assert free[1] - free[2] == pytest.approx(RATIO * LumpedMesh(1e9, 1.0, 1e-4, 1e-4).lash, rel=1e-7)
    assert free[0] - free[1] == pytest.approx(RATIO * 1.2e-4 / RADIUS, rel=1e-7)


REVERSALS, LASTS, POINTS = 50, 0.12, 60
# inertias of side gear, carrier and pinion [kg.m2], and shafts that let the whole swing out between reversals
SIDE, PINION, SHAFT = 2e-3, 3e-3, (2e4, 30.0)
BODIES = {"inertia.from_geometry": False, "inertia.side_gear": SIDE, "inertia.planet": 2e-5, "inertia.carrier": 0.01}
SPRING = {"damping": 2e4, "depth": 1e-4, "backlash": 1e-4}


@pytest.mark.parametrize("level, mesh, law, within", [
    ("lumped", LumpedMesh(2e9, **SPRING), {"contact.mesh_stiffness_from_geometry": False, "contact.mesh_stiffness": 2e9}, 1e-6),
    ("tooth", ToothMesh(2e10, **SPRING), {"contact.law": "impact", "contact.stiffness": 2e10}, 1e-4)], ids=["lumped", "tooth"])
def test_two_lashes_in_series_agree_with_a_separate_integration(fmu, started, level, mesh, law, within):
    stiffness, damping, lash, torque = 5e7, 4e2, 1.2e-4, 10.0
    scene = BODIES | ELASTIC | DRIVEN | HELD | law | {
        "scene.gear_contact": level, "contact.damping": SPRING["damping"], "contact.penetration_depth": SPRING["depth"],
        "geometry.backlash": SPRING["backlash"], "final_drive.stiffness": stiffness, "final_drive.damping": damping, "final_drive.backlash": lash, "inertia.pinion": PINION,
        "final_drive.mean_radius": RADIUS, "pinion.torque_command": torque, "solver.relative_tolerance": 1e-10}
    scene |= {f"half_shaft.{side}_{what}": value for side in ("left", "right") for what, value in zip(("stiffness", "damping"), SHAFT)}
    reference = TwoLashes(mesh, stiffness * RADIUS**2, damping * RADIUS**2, lash / RADIUS, PINION * RATIO**2,
                          turning_inertia(fmu, BODIES) - 2.0 * SIDE, SIDE, SHAFT)
    torque *= RATIO
    reference.state = reference.at_rest(torque)
    names, per = ["pinion.angle", "carrier.angle", "left.angle", "right.angle"], np.array([RATIO, 1.0, 1.0, 1.0])
    times, worst = np.linspace(0.0, LASTS, POINTS + 1), 0.0
    opened = started(scene)
    # angles count from the start
    zero = opened.read(names) / per - reference.state[[0, 1, 2, 2]]
    for _ in range(REVERSALS):
        torque = -torque
        opened.set({"pinion.torque_command": torque / RATIO})
        expected = reference.follow(torque, times)[:, [0, 1, 2, 2]]
        found = np.vstack([sampled(opened, names, LASTS / POINTS, POINTS), opened.read(names)]) / per - zero
        assert mesh.depth_and_rate(1, np.abs(expected[:, 1] - expected[:, 2]).max(), 0.0)[0] < mesh.deepest
        worst = max(worst, np.abs(found - expected).max())
        # both lashes are closed, and everything rests
        assert np.abs(reference.state - reference.at_rest(torque))[:3].max() < 1e-9 * reference.lash
    assert reference.touches > 4 * REVERSALS
    assert worst < within * min(reference.lash, reference.differential.lash)


@pytest.mark.parametrize("rho", [0.2, 0.5, 0.8, 0.95, 1.0, 1.05, 1.25, 1.8, 3.0])
def test_an_error_excites_the_mesh_torque_of_a_forced_oscillator(fmu, started, rho):
    stiffness, zeta, error, teeth = 3e8, 0.1, 1e-6, 10
    inertia, spring = turning_inertia(fmu), stiffness * RADIUS**2
    natural = sqrt(spring / inertia)
    damping = 2.0 * zeta * sqrt(spring * inertia)
    expected = forced_amplitude(spring, damping, inertia, error / RADIUS, rho * natural)
    # the flanks stay in contact
    mean = 400.0
    assert expected < 0.5 * mean
    period, points, periods = 2.0 * pi / (rho * natural), 40, 10
    opened = started(ELASTIC | loads(mean) | {
        "scene.gear_contact": "ideal", "final_drive.stiffness": stiffness, "final_drive.damping": damping / RADIUS**2,
        "final_drive.mean_radius": RADIUS, "final_drive.error_1": error, "final_drive.error_phase_1": 0.4,
        "pinion.speed_command": rho * natural / teeth, "solver.relative_tolerance": 1e-8})
    # the transient decays to 1e-6
    opened.step(np.ceil(14.0 / zeta / natural / period) * period)
    torques = sampled(opened, ["carrier.torque"], period / points, points * periods)[:, 0]
    spectrum = np.fft.rfft(torques) / len(torques)
    assert 2.0 * abs(spectrum[periods]) == pytest.approx(expected, rel=1e-3)
    assert spectrum[0].real == pytest.approx(mean, rel=1e-6)


# a pair with lash that lifts off: damping ratio, mean load, and error in half lashes
ZETA, MEAN, ERROR = 0.05, 0.1, 0.05
# many teeth, so that a change of the mesh frequency changes the pinion's speed by little
TEETH, STEP, SETTLED, TAKEN, POINTS_OF_PERIOD = (250, 1000), 0.002, 150, 50, 32
# jumps of the speed from one frequency to the next, and periods between them
JUMPS, BETWEEN = 4, 20


def swept(fmu, frequencies):
    """Standard deviations of the deviation in half lashes over a sweep, by the FMU and by the separate calculation."""
    stiffness, lash = 1e6, 5e-4
    spring, half, ratio = stiffness * RADIUS**2, 0.5 * lash / RADIUS, TEETH[1] / TEETH[0]
    inertia = turning_inertia(fmu)
    natural, reference = sqrt(spring / inertia), Rattle(ZETA, MEAN, ERROR)
    scene = ELASTIC | loads(MEAN * spring * half) | {
        "scene.gear_contact": "ideal", "final_drive.pinion_teeth": TEETH[0], "final_drive.ring_teeth": TEETH[1],
        "final_drive.mean_radius": RADIUS, "final_drive.stiffness": stiffness, "final_drive.backlash": lash,
        "final_drive.damping": 2.0 * ZETA * sqrt(spring * inertia) / RADIUS**2, "final_drive.error_1": ERROR * half * RADIUS,
        "pinion.speed_command": frequencies[0] * natural / TEETH[0], "solver.relative_tolerance": 1e-8}
    found, expected, before = [], [], frequencies[0]
    with fmu.open() as opened:
        opened.initialise(scene)
        for frequency in frequencies:
            # in small jumps of the pinion's speed, in which the carrier keeps its own, so that the motion stays on its branch
            for part in np.linspace(before, frequency, JUMPS + 1)[1:]:
                opened.set({"pinion.speed_command": part * natural / TEETH[0]})
                reference.v += (part - before) / (TEETH[1] * half)
                before, period = part, 2.0 * pi / (part * natural)
                periods = BETWEEN if part != frequency else SETTLED
                opened.step(periods * period)
                reference.run(part, periods)
            pinion, carrier = sampled(opened, ["pinion.angle", "carrier.angle"], period / POINTS_OF_PERIOD, TAKEN * POINTS_OF_PERIOD).T
            found.append(np.std((pinion / ratio - carrier) / half - ERROR * np.cos(TEETH[0] * pinion)))
            expected.append(np.std(reference.run(frequency, TAKEN, POINTS_OF_PERIOD)))
    return np.array(found), np.array(expected)


def jump(frequencies, deviations):
    """Frequencies before and after the only jump of a sweep in small steps."""
    changes = np.abs(np.diff(deviations))
    at = int(np.argmax(changes))
    assert np.delete(changes, at).max() < 0.1 * changes[at]
    return frequencies[at:at + 2]


@pytest.mark.parametrize("begin, end, known", [(0.8, 0.84, (0.826, 0.828)), (0.6, 0.57, (0.582, 0.58))])
def test_a_pair_that_lifts_off_jumps_at_the_same_frequencies(fmu, begin, end, known):
    fine = np.linspace(begin, end, round(abs(end - begin) / STEP) + 1)
    # the branch of large motion begins above its resonance
    coarse = [] if begin < end else [0.9, 0.85, 0.8, 0.75, 0.7, 0.65]
    found, expected = swept(fmu, [*coarse, *fine])
    assert np.abs(found - expected).max() < 1e-4
    fine_found, fine_expected = found[len(coarse):], expected[len(coarse):]
    assert jump(fine, fine_found) == pytest.approx(jump(fine, fine_expected))
    assert jump(fine, fine_found) == pytest.approx(known)


def test_the_separate_calculation_finds_the_published_jumps_if_the_gap_damps():
    for frequencies, known in (((0.82, 0.84), (0.828, 0.83)), ((0.72, 0.7), (0.71, 0.708))):
        reference = Rattle(ZETA, MEAN, ERROR, damps_in_gap=True)
        fine = np.linspace(*frequencies, 11)
        for before in [0.7, 0.76, 0.8] if fine[0] < fine[1] else [1.0, 0.9, 0.82, 0.76]:
            reference.run(before, 2 * SETTLED)
        deviations = []
        for frequency in fine:
            reference.run(frequency, 2 * SETTLED)
            deviations.append(np.std(reference.run(frequency, TAKEN, POINTS_OF_PERIOD)))
        assert jump(fine, deviations) == pytest.approx(known)


@pytest.mark.parametrize("name, order, by", [("error_1", 10, "pinion"), ("error_2", 20, "pinion"), ("error_3", 30, "pinion"),
                                             ("pinion_runout", 1, "pinion"), ("ring_runout", 1, "carrier")])
def test_each_error_has_its_order_and_phase(started, name, order, by):
    # so slow that the deflection is that of the load alone
    size, phase, load = 2e-5, 0.7, 300.0
    phase_name = name.replace("error_", "error_phase_") if name.startswith("error") else f"{name}_phase"
    opened = started(ELASTIC | loads(load) | {"scene.gear_contact": "ideal", "pinion.speed_command": 0.05, f"final_drive.{name}": size,
                                              f"final_drive.{phase_name}": phase, "solver.relative_tolerance": 1e-9})
    opened.step(1.0)
    seen = sampled(opened, ["pinion.angle", "carrier.angle", "carrier.torque", "pinion.torque"], 1.0, 80)
    pinion, carrier, torque, driving = seen.T
    angle = pinion if by == "pinion" else carrier
    error = size / RADIUS * np.cos(order * angle + phase)
    slope = -order * size / RADIUS * np.sin(order * angle + phase)
    # power of a mesh that follows its error: T (1 + de/dtheta_c) on the carrier, and T_p = T (1/i - de/dtheta_p)
    on_carrier, on_pinion = (1.0 + slope, 1.0 / RATIO) if by == "carrier" else (1.0, 1.0 / RATIO - slope)
    mesh = load / on_carrier
    assert torque == pytest.approx(np.full(len(torque), load), rel=1e-6)
    assert driving == pytest.approx(mesh * on_pinion, rel=1e-6)
    found = pinion / RATIO - carrier - mesh / (3e8 * RADIUS**2)
    # the start counts as zero for each angle
    found -= np.mean(found - error)
    assert np.abs(found - error).max() < 1e-5 * size / RADIUS
