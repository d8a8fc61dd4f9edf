"""Final drive with a rigid or elastic mesh: the same motion as a heavier carrier, its ratio at all outputs, and its mirror image."""

from math import pi

import numpy as np
import pytest
from final_drive_scenes import RATIO
from refusals import refused_start

# relative to the largest value of each output
SAME = 1e-9
PINION, CARRIER = 0.004, 0.006
# outputs that only a final drive has, and those that describe the effort of the solver instead of the motion
OWN = ("pinion.", "propeller.", "ring_gear.", "left_bearing.", "right_bearing.")
EFFORT = ["solver.step_size"]
CAR = {"left.load_torque": 700.0, "right.load_torque": 640.0, "inertia.left_end": 0.2, "inertia.right_end": 0.3, "contact.law": "line"}
STOP = 0.05


@pytest.fixture
def with_and_without(run):
    """with_and_without(values, drive, course): records with a final drive, and of the equivalent carrier; `course`: command of the
    carrier at the start and at the end."""
    def simulate(values, drive, course):
        base, speed = values | {"scene.carrier_drive": drive}, course[0] if drive == "speed" else 20.0
        driven = base | {"effects.final_drive": True, "inertia.carrier": CARRIER, "inertia.pinion": PINION,
                         "pinion.speed_command": RATIO * speed}
        plain = base | {"inertia.carrier": CARRIER + RATIO**2 * PINION, "carrier.speed_command": speed}
        records, times = [], np.array([0.0, STOP])
        for scene, port, factor in ((driven, "pinion", RATIO if drive == "speed" else 1.0 / RATIO), (plain, "carrier", 1.0)):
            records.append(run(scene, STOP, inputs={f"{port}.{drive}_command": (times, factor * np.array(course))}))
        return records

    return simulate


def differs(a, b, scale=None):
    """True if two courses differ by more than rounding."""
    return np.abs(a - b).max() > SAME * (np.abs(b).max() if scale is None else scale)


# commands of the carrier at the start and the end, and a factor on the loads. The flanks of real teeth stay in contact: where they part,
# the steps of the solver depend on the last digits
COURSES = [("torque", [1300.0, 1500.0], 1.0), ("torque", [-1200.0, -1400.0], -1.0), ("speed", [20.0, 24.0], 1.0),
           ("speed", [5.0, -15.0], 1.0)]


@pytest.mark.parametrize("contact, drive, course, load", [(contact, *case) for contact in ("ideal", "lumped", "tooth") for case in COURSES]
                         + [("ideal", "torque", [-900.0, 300.0], 1.0)])
def test_a_rigid_final_drive_is_a_heavier_carrier(with_and_without, outputs, contact, drive, course, load):
    turned = {name: load * CAR[name] for name in ("left.load_torque", "right.load_torque")}
    driven, plain = with_and_without(CAR | turned | {"scene.gear_contact": contact}, drive, course)
    names = [name for name in outputs if not name.startswith(OWN) and name not in [*EFFORT, "carrier.torque", "solver.energy_residual"]]
    assert [name for name in names if differs(driven[name], plain[name])] == []
    # the residual is a small difference of the energies turned over
    turned_over = np.abs(plain["power.in"]).max() * STOP
    assert not differs(driven["solver.energy_residual"], plain["solver.energy_residual"], turned_over)
    ring = plain["carrier.torque"] - RATIO**2 * PINION * plain["carrier.acceleration"]
    assert not differs(driven["carrier.torque"], ring)
    for port in ("pinion", "propeller"):
        assert not differs(driven[f"{port}.torque"], plain["carrier.torque"] / RATIO)
        assert not differs(driven[f"{port}.speed"], RATIO * plain["carrier.speed"])
        assert not differs(driven[f"{port}.angle"], RATIO * plain["carrier.angle"])


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("elastic", [False, True])
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_commands_of_the_carrier_have_no_influence(run, outputs, contact, elastic, drive):
    values = CAR | {"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "scene.gear_contact": contact,
                    "scene.carrier_drive": drive, "pinion.speed_command": 80.0, "pinion.torque_command": 350.0}
    one, other = (run(values | {"carrier.speed_command": speed, "carrier.torque_command": torque}, 0.01)
                  for speed, torque in ((1.0, 2.0), (-300.0, 4000.0)))
    assert [name for name in outputs if not np.array_equal(one[name], other[name])] == []


@pytest.mark.parametrize("pinion, ring", [(10, 41), (41, 10), (7, 7), (250, 1000)])
@pytest.mark.parametrize("elastic", [False, True])
def test_the_ratio_is_that_of_the_teeth(run, pinion, ring, elastic):
    record = run({"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "final_drive.pinion_teeth": pinion,
                  "final_drive.ring_teeth": ring, "pinion.speed_command": 30.0})
    last = record[-1]
    assert last["carrier.speed"] == pytest.approx(30.0 * pinion / ring, rel=SAME)
    assert last["pinion.torque"] == pytest.approx(1670.0 * pinion / ring, rel=SAME)
    assert last["power.in"] == pytest.approx(1670.0 * 30.0 * pinion / ring, rel=SAME)
    assert last["carrier.torque"] == pytest.approx(1670.0, rel=SAME)


# signs of outputs after all rotations have changed theirs, by the end of the name; other outputs keep their values
ODD = ("carrier.angle", ".speed", ".acceleration", ".torque", ".shaft_torque", ".tangential_force", "pinion.angle", "propeller.angle",
       ".vertical_force", ".wheel_speed")
EVEN = (".axial_force", ".radial_force", ".longitudinal_force", ".normal_force", ".thrust_force", "power.in", "power.out", "power.loss",
        "efficiency", "heat.final_drive", "heat.contact", "heat.half_shaft", "heat.propeller_shaft")
LOSSES = {"final_drive.friction_torque": 3.0, "final_drive.drive_loss": 0.03, "final_drive.coast_loss": 0.03, "final_drive.viscous": 0.01}


def noisy(sign):
    """Errors of all orders. Their image has the phases of the opposite error at the opposite angle."""
    phases = {"error_phase_1": 0.3, "error_phase_2": 1.1, "error_phase_3": -0.7, "pinion_runout_phase": 2.0, "ring_runout_phase": -1.3}
    sizes = {"error_1": 8e-6, "error_2": 3e-6, "error_3": 1e-6, "pinion_runout": 2e-5, "ring_runout": 3e-5}
    return ({f"final_drive.{name}": phase if sign > 0.0 else pi - phase for name, phase in phases.items()}
            | {f"final_drive.{name}": size for name, size in sizes.items()})


def view(sign, drive, elastic, load, more):
    """Scene with this load on the carrier [N.m], or its image in the horizontal plane."""
    values = {"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "scene.carrier_drive": drive,
              "final_drive.spiral_angle": 0.6, "final_drive.hand": "right" if sign > 0.0 else "left", "final_drive.azimuth": 0.2 * sign,
              "inertia.left_end": 0.1, "inertia.right_end": 0.15, "left.load_torque": 0.55 * load * sign,
              "right.load_torque": 0.45 * load * sign}
    return values | LOSSES | (noisy(sign) if elastic else {}) | more


@pytest.fixture
def images(run, outputs):
    """images(drive, elastic, load, course, more): records of a scene and of its image; `course`: command of the pinion, by time."""
    def simulate(drive, elastic, load, course, more):
        names, records = [name for name in outputs if name.endswith(ODD + EVEN)], []
        times, commands = np.array(course).T
        for sign in (1.0, -1.0):
            values = view(sign, drive, elastic, load, more | {"pinion.speed_command": 40.0 * sign})
            records.append(run(values, times[-1], output=names, inputs={f"pinion.{drive}_command": (times, sign * commands)}))
        return records

    return simulate


def mirrored(here, there):
    """Names of outputs that are not those of the mirror image."""
    return [name for name in here.dtype.names[1:]
            if np.abs(there[name] - (-1.0 if name.endswith(ODD) else 1.0) * here[name]).max() > SAME * np.abs(here[name]).max()]


WITH_SHAFT = {"effects.propeller_shaft": True, "propeller_shaft.joint_angle": 0.3}
VIEWS = pytest.mark.parametrize("more", [{}, WITH_SHAFT], ids=["pinion", "shaft"])
CONTACTS = pytest.mark.parametrize("contact", ["ideal", "lumped"])


@CONTACTS
@VIEWS
@pytest.mark.parametrize("elastic", [False, True])
@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_all_inputs_reversed_give_the_mirror_image_of_loaded_flanks(images, contact, elastic, drive, way, more):
    course = [(0.0, 170.0), (0.02, 190.0), (0.05, 150.0)] if drive == "torque" else [(0.0, 40.0), (0.02, 45.0), (0.05, 30.0)]
    if way < 0.0:
        course = [(time, -value if drive == "torque" else value) for time, value in course]
    here, there = images(drive, elastic, 600.0 * way, course, more | {"scene.gear_contact": contact})
    assert np.ptp(here["pinion.speed"]) > 1.0 and np.abs(here["carrier.torque"]).min() > 100.0
    assert mirrored(here, there) == []


TURNING = {"torque": [(0.0, 0.0), (0.02, 90.0), (0.04, -80.0), (0.05, 10.0)],
           "speed": [(0.0, 0.0), (0.02, 30.0), (0.04, -20.0), (0.05, 5.0)]}


@VIEWS
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_all_inputs_reversed_give_the_mirror_image_through_rest(images, drive, more):
    here, there = images(drive, False, 60.0, TURNING[drive], more | {"scene.gear_contact": "ideal", "scene.start": "rest"})
    assert here["pinion.speed"].min() < -1.0 and here["pinion.speed"].max() > 1.0
    assert mirrored(here, there) == []


@VIEWS
@pytest.mark.parametrize("drive", ["torque", "speed"])
def test_all_inputs_reversed_give_the_mirror_image_through_the_lash(images, drive, more):
    """Rounding decides on the steps of the solver where flanks touch, so the images agree only as well as the solution is exact."""
    here, there = images(drive, True, 60.0, TURNING[drive], more | {
        "scene.gear_contact": "ideal", "scene.start": "rest", "solver.relative_tolerance": 1e-10})
    assert here["carrier.torque"].min() < -50.0 and here["carrier.torque"].max() > 50.0
    assert np.abs(there["carrier.speed"] + here["carrier.speed"]).max() < 1e-6 * np.abs(here["carrier.speed"]).max()


def test_a_backlash_beyond_the_pitch_is_refused(fmu):
    values = {"effects.final_drive": True, "final_drive.elastic_mesh": True, "inertia.pinion": 0.01, "final_drive.mean_radius": 0.06}
    refused_start(fmu, values | {"final_drive.backlash": 0.0095},
                  "final_drive.backlash: 9.5 mm is not below the pitch of final_drive.ring_teeth = 41 at final_drive.mean_radius, 9.194905 mm")


def test_a_command_of_the_carrier_names_the_command_that_acts_instead(started):
    instance = started({"effects.final_drive": True, "scene.carrier_drive": "torque", "carrier.torque_command": 100.0})
    assert any("Here, pinion.torque_command acts instead" in text for text in instance.messages), instance.messages


def test_the_initial_speed_of_the_pinion_has_no_influence_at_rest(started):
    values = {"effects.final_drive": True, "scene.carrier_drive": "torque", "scene.start": "rest", "pinion.speed_command": 300.0}
    instance = started(values)
    assert any(text.startswith("pinion.speed_command: ") and "changes nothing" in text for text in instance.messages), instance.messages
