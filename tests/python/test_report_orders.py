"""Order tracking, intervals in the backlash and contact patterns of a report, against closed forms."""

import math
import re

import numpy as np
import pytest
from bevel_differential import DifferentialError, Scene
from bevel_differential.report import traces
from bevel_differential.report.drawings import outline, unrolled
from bevel_differential.report.forces import bands, rolling, share, spectrum
from bevel_differential.report.gears import pair_of
from bevel_differential.report.waterfall import TURN, waterfall
from bevel_differential.report.pattern import Contacts
from bevel_differential.report.runup import ANGLE, SIGNAL, SPIN, run_up, theory
from bevel_differential.report.simulated import Simulated

# turns in a window: a spectral line is 1/8 of an order wide
WINDOW = 8
LINE = 1.0 / WINDOW


@pytest.fixture(scope="module")
def simulated(fmu_file):
    """simulated(name, values): scene and its record."""

    def simulate(name, values=None):
        return Simulated.of(Scene.load(name, fmu=fmu_file).set(values or {}))

    return simulate


def swept(orders, turns=64.0, per_turn=400):
    """Signal of these {order: amplitude}, over an angle that accelerates from 1 to 10; points at equal time steps."""
    times = np.linspace(0.0, 1.0, int(turns * per_turn))
    angle = TURN * turns * (times + 4.5 * times**2) / 5.5
    return angle, sum(size * np.sin(order * angle + order) for order, size in orders.items()), 1.0 + 9.0 * times


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_orders_of_a_known_signal_are_within_one_line(sense):
    known = {10.0: 3.0, 20.5: 1.0, 37.3: 0.4}
    angle, values, speed = swept(known)
    spectra = waterfall(sense * angle, values + 5.0, speed, WINDOW, 50.0)
    found = spectra.strongest(8, 0.02)
    assert len(found) == len(known)
    for (order, size), (theirs, amplitude) in zip(found, known.items()):
        assert abs(order - theirs) < 0.1 * LINE
        # between two lines, the window reduces a tone by up to 15 %
        assert (0.84 if theirs == 37.3 else 0.99) < size / amplitude < 1.01
    assert np.all(np.diff(spectra.speeds) > 0.0) and 1.0 < spectra.speeds[0] and spectra.speeds[-1] < 10.0


def test_orders_above_those_of_interest_do_not_come_back():
    # the record contains this order at low speeds, with many points in each of its periods
    angle, values, speed = swept({10.0: 1.0, 510.0: 1.0}, per_turn=8000)
    spectra = waterfall(angle, values, speed, WINDOW, 60.0)
    assert [round(order) for order, _ in spectra.strongest(8, 1e-3)] == [10]


def test_too_few_points_and_an_angle_that_turns_back_are_refused():
    angle, values, speed = swept({10.0: 1.0}, per_turn=40)
    with pytest.raises(DifferentialError, match="shorter steps"):
        waterfall(angle, values, speed, WINDOW, 60.0)
    with pytest.raises(DifferentialError, match="one way"):
        waterfall(np.sin(angle), values, speed, WINDOW, 2.0)


def test_a_run_up_has_the_orders_of_mesh_ring_gear_and_pinion(simulated):
    run = simulated("study_turning", {"effects.final_drive": True, "final_drive.ring_teeth": 9, "final_drive.pinion_teeth": 6,
                                      "final_drive.elastic_mesh": True, "final_drive.error_1": 1e-4, "final_drive.pinion_runout": 4e-4,
                                      "pinion.speed_command": "1431 deg/s", "effects.half_shaft": True, "inertia.left_end": 1.0,
                                      "inertia.right_end": 1.0})
    up = run_up(run)
    assert theory(run, up.ratio)["pinion 1.5 per carrier turn"] == 1.5 / abs(up.ratio)
    record = up.record
    spin, carrier = (np.ptp(record[name]) / np.ptp(record["time"]) for name in (ANGLE, "carrier.angle"))
    expected = {"mesh": 10.0, "second": 20.0, "ring": 9.0 * carrier / spin, "pinion": 1.5 * carrier / spin}
    spectra = waterfall(record[ANGLE], record[SIGNAL], record["carrier.speed"], WINDOW, 60.0)
    found = [order for order, _ in spectra.strongest(12, 1e-3)]
    for name, order in expected.items():
        assert min(abs(order - theirs) for theirs in found) < LINE, f"{name}: {order} is not among {found}"
    # there is nothing else: all lines are sums of multiples of both meshes and of turns of the pinion
    sums = [abs(10.0 * k + expected["pinion"] * n) for k in range(-8, 9) for n in range(-12, 13)]
    assert all(min(abs(order - theirs) for theirs in sums) < LINE for order in found), found


# 14 teeth of the side gears for 4 planets: neighbouring planets are half a pitch out of phase
OUT_OF_PHASE = {"geometry.planet_count": 4, "geometry.side_teeth": 14}


def orders_of(run):
    """Run-up, and amplitudes [m] of whole mesh orders in the scene and in its run-up."""
    here = spectrum(run, rolling(run.time, run.series(ANGLE), 10))[1]
    up = run_up(run)
    spectra = waterfall(up.record[ANGLE], up.record[SIGNAL], np.abs(up.record["carrier.speed"]), WINDOW, 60.0)
    there = [spectra.mean[np.argmin(np.abs(spectra.orders - 10.0 * (k + 1)))] for k in range(6)]
    return up, here[:6], np.array(there)


@pytest.mark.parametrize("values", [{}, {"scene.right_drive": "torque", "scene.carrier_drive": "speed", "right.load_torque": "835 N.m"}])
def test_a_run_up_with_free_planets_has_the_odd_orders_that_the_scene_has(simulated, values):
    """Each free planet balances its two meshes, and odd orders do not cancel."""
    up, here, there = orders_of(simulated("torque_bias", OUT_OF_PHASE | values))
    assert SPIN not in up.imposed and not up.is_driven_otherwise
    assert np.argmax(here) == np.argmax(there) == 0
    assert there == pytest.approx(here, rel=0.03)


def test_a_run_up_of_a_scene_driven_by_torques_leaves_the_planets_free_and_says_what_it_imposes(simulated):
    up, here, there = orders_of(simulated("limited_slip", OUT_OF_PHASE))
    assert up.imposed == ["the carrier's speed", "the left wheel's speed"] and up.is_driven_otherwise
    assert any("the left wheel's speed is imposed through its half-shaft of" in change for change in up.changed)
    assert np.argmax(here[:3]) == np.argmax(there) == 0


def test_a_heavy_wheel_does_not_add_its_inertia_to_the_load_of_the_run_up(simulated):
    run = simulated("torque_bias", {"scene.right_drive": "torque", "scene.carrier_drive": "speed", "right.load_torque": "835 N.m",
                                    "effects.half_shaft": True, "inertia.right_end": 300.0})
    # the carrier accelerates by 2 rad/s2
    assert run_up(run).loads[1] == pytest.approx(run.mean("right.shaft_torque"), rel=0.01)


def test_a_run_up_at_imposed_spin_has_even_orders_only_if_planets_are_half_a_pitch_apart(simulated):
    """In step, the odd orders of neighbouring planets have opposite signs, so that they cancel at the side gear."""
    up, here, there = orders_of(simulated("study_turning", OUT_OF_PHASE))
    assert SPIN in up.imposed and not up.is_driven_otherwise
    assert here[::2].max() < 1e-5 * here[1] and there[::2].max() < 1e-3 * there[1]
    assert there[1::2] == pytest.approx(here[1::2], rel=0.03)


def test_a_locked_scene_runs_up_with_the_lock_open(simulated):
    up = run_up(simulated("locked"))
    assert any("lock is open" in change for change in up.changed)
    found = waterfall(up.record[ANGLE], up.record[SIGNAL], up.record["carrier.speed"], WINDOW, 60.0).strongest(3, 1e-2)
    assert all(abs(order / 10.0 - round(order / 10.0)) * 10.0 < LINE for order, _ in found)


def test_bands_of_lash_of_a_known_record():
    times = np.arange(8.0)
    force = np.array([0.0, 0.0, 5.0, 5.0, 0.0, 0.0, 7.0, 0.0])
    assert bands(times, force) == [(0.0, 1.5), (3.5, 5.5), (6.5, 7.0)]
    assert share(times, bands(times, force)) == pytest.approx(4.0 / 7.0)
    assert bands(times, np.ones(8)) == [] and bands(times, np.zeros(8)) == [(0.0, 7.0)]


def test_rattling_teeth_are_in_the_lash_while_no_pair_is_loaded(simulated):
    run = simulated("rattle")
    free = run.series("planet[1].left_pairs") == 0.0
    found = bands(run.time, run.series("planet[1].left_normal_force"))
    inside = np.any([(begin <= run.time) & (run.time <= end) for begin, end in found], axis=0)
    assert np.array_equal(inside, free) and 0.5 < np.mean(free) < 1.0


def test_a_tooth_at_rest_has_the_contact_strip_of_hertz(simulated):
    run = simulated("study_straight")
    pair = pair_of(run)
    contacts = Contacts.of(run, 1.0, pair)
    assert len(np.unique(contacts.tooth)) == 1 and len(Contacts.of(run, -1.0, pair).force) == 0
    # radii of both flanks at the contact, R tan ψ with arcs that add up to the line of action
    planet, side = pair.gears
    mean = 0.5 * (pair.inner_cone + pair.outer_cone)
    arc = planet.arc(planet.pitch + contacts.height[-1] / mean)
    other = planet.arc(planet.pitch) + side.arc(side.pitch) - arc
    radius = mean / (1.0 / math.tan(arc) + 1.0 / math.tan(other))
    modulus = run.value("material.young_modulus") / (2.0 * (1.0 - run.value("material.poisson_ratio") ** 2))
    half = 2.0 * math.sqrt(contacts.force[-1] / pair.face_width * radius / (math.pi * modulus))
    # loads are uniform over the face
    assert contacts.half_width[-1] == pytest.approx(half, rel=1e-3)


def test_the_drawn_teeth_touch_at_the_points_of_the_fmu(simulated):
    run = simulated("study_turning")
    pair, last = pair_of(run), run.record[-1]
    planet, side = pair.gears
    mean = 0.5 * (pair.inner_cone + pair.outer_cone)
    polar = planet.pitch + last["mesh.pair[1].height"] / mean
    tooth = last["mesh.pair[1].tooth"]
    side_turn = last["left.angle"] - last["carrier.angle"]
    flank = []
    for k in range(side.teeth):
        first = math.pi / side.teeth + 2.0 * math.pi * k / side.teeth
        flank += [unrolled(pair, (math.cos(p), math.sin(p) * math.cos(a), math.sin(p) * math.sin(a)))
                  for p, a in outline(side) + (0.0, first + side_turn)]
    corners = np.array(flank)
    begin, piece = corners[:-1], np.diff(corners, axis=0)
    apart = []
    for bend in (-1.0, 1.0):
        # the FMU numbers planet teeth against their azimuth: teeth that come into mesh in forward spin have decreasing numbers
        azimuth = -2.0 * math.pi * tooth / planet.teeth + bend * planet.half_angle(polar) - last["planet[1].spin_angle"]
        point = np.array(unrolled(pair, (math.sin(polar) * math.cos(azimuth), math.cos(polar), -math.sin(polar) * math.sin(azimuth))))
        along = np.clip(np.sum((point - begin) * piece, axis=1) / np.maximum(np.sum(piece**2, axis=1), 1e-12), 0.0, 1.0)
        apart.append(np.min(np.hypot(*(point - begin - along[:, None] * piece).T)))
    # one flank penetrates the other by the deflection, mm at the heel; the other flank has a gap of the backlash and more
    deflection = 1e3 * last["planet[1].left_transmission_error"] * pair.outer_cone / mean
    lash = 1e3 * run.value("geometry.backlash") * math.cos(pair.pressure_angle)
    assert min(apart) == pytest.approx(deflection, rel=0.1) and max(apart) > 0.9 * lash


@pytest.mark.parametrize("wheels", [{}, {"scene.left_drive": "torque", "scene.right_drive": "torque", "left.load_torque": 200.0,
                                         "right.load_torque": 600.0}])
def test_a_scene_with_a_clutch_on_command_runs_up_under_its_loads(fmu_file, wheels):
    """Wheels by speed, or by torques that the clutch holds apart. Its gearing gives an eighth of its torque to the housing."""
    values = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "carrier.torque_command": 850.0,
              "left.speed_command": 43.0, "right.speed_command": 46.0, "carrier.speed_command": 44.5, "effects.clutches": True,
              "clutches.torque": 400.0, "clutches.right_ratio": 1.125, "inertia.left_end": 50.0, "inertia.right_end": 50.0} | wheels
    scene = Scene("vectoring", stop=0.3, step=1e-3, outputs=["left.shaft_torque"], set=values, fmu=fmu_file,
                  tables=[("right.clutch_command", [0.0, 0.1], [1.0, 1.0 - 1e-9], None)])
    run = Simulated.of(scene)
    up = run_up(run)
    # the clutch winds up at the start
    assert run.mean("clutches.housing_torque") == pytest.approx(50.0, rel=0.01)
    assert up.loads == pytest.approx([run.mean(f"{side}.shaft_torque") for side in ("left", "right")], rel=0.02)
    assert "the command of the right clutch is constant at its mean of 1" in up.changed
    given = re.search(r"the gearings of the clutches give ([\d.]+) N·m to the housing", traces.section(run).blocks[-1].caption)
    assert float(given[1]) == pytest.approx(50.0, rel=0.01)
