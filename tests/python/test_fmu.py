"""The packaged FMU in a host: theory, spectra, messages. Names of tests are sentences."""

import re

import numpy as np
import pytest
import theory
from fmpy.validation import validate_fmu

STRAIGHT = {"scene.start": "rolling"}
CARRIER, SPIN = 954.0, 200.0
TURN = {"scene.start": "rolling", "scene.planet_spin": "imposed", "carrier.speed_command": (CARRIER, "deg/s"),
        "spin.command": (SPIN, "deg/s")}
SIDES = ["left", "right"]


def settled(record, begin=0.14):
    """Record from `begin` to the end, without the last sample: two whole mesh periods in a turn of 0.5 s."""
    return record[(record["time"] > begin - 1e-9)][:-1]


@pytest.fixture(scope="module")
def straight(run):
    return run(STRAIGHT)


@pytest.fixture(scope="module")
def turn(run):
    return run(TURN)


def test_fmpy_finds_no_problem_in_the_fmu(fmu_file):
    assert validate_fmu(fmu_file) == []


def test_a_host_that_sets_nothing_gets_the_study_at_once(run):
    record = run(stop=0.01)
    for side in SIDES:
        np.testing.assert_allclose(np.degrees(record[f"{side}.speed"]), 2861.0, rtol=1e-6)
        np.testing.assert_allclose(record[f"{side}.tangential_force"], theory.TANGENTIAL_FORCE, rtol=1e-6)


def test_straight_ahead_both_sides_turn_with_the_carrier(straight):
    part = settled(straight)
    for side in SIDES:
        np.testing.assert_allclose(np.degrees(part[f"{side}.speed"]), 2861.0, rtol=1e-4)
    assert willis(part) < 1e-6


@pytest.mark.parametrize("scene", ["straight", "turn"])
def test_the_teeth_carry_the_load_of_theory(request, scene):
    part = settled(request.getfixturevalue(scene))
    for side in SIDES:
        assert np.mean(part[f"{side}.tangential_force"]) == pytest.approx(theory.TANGENTIAL_FORCE, rel=5e-3)
        for planet in [1, 2]:
            force = np.mean(part[f"planet[{planet}].{side}_normal_force"])
            assert force == pytest.approx(theory.normal_force(), rel=5e-3)


def test_in_the_turn_the_speeds_follow_willis(turn):
    part = settled(turn)
    for side, expected in zip(SIDES, theory.side_speeds(CARRIER, SPIN)):
        assert np.degrees(np.mean(part[f"{side}.speed"])) == pytest.approx(expected, rel=1e-3)
    # the stiffness of teeth returns its energy within a mesh period; the remainder is the sampling error of the mean
    assert willis(part) < 2e-6


def willis(part):
    """|ω_L + ω_R − 2 ω_c| of the means, over 2 ω_c."""
    carrier = 2.0 * np.mean(part["carrier.speed"])
    return abs(np.mean(part["left.speed"]) + np.mean(part["right.speed"]) - carrier) / carrier


def test_the_first_line_of_the_force_is_the_mesh_frequency(run):
    amplitude, frequency = spectrum(run(TURN, stop=2.0)["left.normal_force"])
    lines = frequency[1:][amplitude[1:] > 0.02 * np.max(amplitude[1:])]
    assert lines[0] == pytest.approx(theory.mesh_frequency(SPIN), rel=1e-6)
    # all other lines are multiples of it
    np.testing.assert_allclose(lines / lines[0], np.round(lines / lines[0]), atol=1e-6)


def test_straight_ahead_the_force_has_no_line(run):
    amplitude, _ = spectrum(run(STRAIGHT, stop=2.0)["left.normal_force"])
    assert np.max(amplitude[1:]) < 1e-6 * amplitude[0]


def spectrum(force, step=0.001, window=1.8):
    """Amplitudes over the last ten mesh periods of the turn, and their frequencies."""
    count = round(window / step)
    amplitude = np.abs(np.fft.rfft(force[-count - 1:-1])) / count
    amplitude[1:] *= 2.0
    return amplitude, np.fft.rfftfreq(count, step)


def test_no_tooth_slips(turn):
    ratio = theory.PLANET_TEETH / theory.SIDE_TEETH
    part = settled(turn, 0.005)
    for side, sign in zip(SIDES, [1.0, -1.0]):
        spin = part["planet[1].spin_angle"]
        lag = part["carrier.angle"] + sign * ratio * spin - part[f"{side}.angle"]
        # at least half the backlash, and at most the deflection of one pair more
        assert np.all(lag > theory.half_play())
        assert np.all(lag < theory.half_play() + 1.05 * theory.largest_wind_up())
        # several teeth have passed, so a slip of one would be visible
    assert part["planet[1].spin_angle"][-1] > 4.0 * np.pi / theory.PLANET_TEETH
    assert theory.half_play() + theory.largest_wind_up() < 0.1 * 2.0 * np.pi / theory.SIDE_TEETH


def test_planets_that_do_not_exist_give_zero(straight):
    for name in straight.dtype.names:
        if name.startswith(("planet[3]", "planet[4]")):
            assert np.all(straight[name] == 0.0), name


def test_the_start_values_give_no_message(started):
    opened = started()
    opened.step(1e-3)
    assert opened.messages == []


def acted_on(opened, inputs, outputs):
    """Pairs (output, input) in which the input acts immediately."""
    acts = set()
    for name in inputs:
        before, value = opened.read(outputs), opened.get(name)
        most = opened.fmu.variable(name).maximum
        opened.set({name: 1.1 * value + 0.1 if most is None or value < most else 0.9 * value})
        acts |= {(output, name) for output, was, now in zip(outputs, before, opened.read(outputs)) if now != was}
        opened.set({name: value})
    return acts


def test_an_input_acts_at_once_on_the_outputs_that_declare_it_and_on_no_other(fmu, description, outputs):
    """The dependencies of the model structure are the union over all scenes and both kinds: none is missing, none is
    superfluous."""
    inputs = [v.name for v in fmu.variables.values() if v.causality == "input"]
    declared = {(unknown.variable.name, known.name)
                for unknown in description.outputs for known in unknown.dependencies if known.causality == "input"}
    observed = set()
    ends = {"inertia.left_end": 1.0, "inertia.right_end": 2.0}
    shafts = {**ends, "effects.half_shaft": True}
    scenes = [ends, {"effects.half_shaft": True}, {**shafts, "effects.strength": True, "effects.tooth_friction": True},
              {**ends, **theory.CLUTCHES, "limited_slip.torque_coefficient": 0.0}, {**ends, "effects.thrust_friction": True}]
    brakes = {"effects.wheel_brake": True, "left.brake_torque": 100.0, "right.brake_torque": 50.0}
    swapped = {**brakes, "left.brake_torque": 50.0, "right.brake_torque": 100.0}
    clutches = {"effects.clutches": True, "left.clutch_command": 0.1, "right.clutch_command": 0.05, "clutches.left_ratio": 1.2,
                "clutches.right_ratio": 0.7, "clutches.stribeck_speed": 1.0, "clutches.static_ratio": 1.2}
    scenes += [{**ends, **clutches}, {**shafts, **clutches}, {**ends, **brakes}, {"effects.half_shaft": True, **brakes}, {"effects.half_shaft": True, **swapped}]
    # one wheel is at rest while planets spin at 1 rad/s
    scenes += [{"effects.half_shaft": True, **brakes, "carrier.speed_command": speed} for speed in [-0.625, 0.625]]
    left, right = {"scene.left_drive": "speed"}, {"scene.right_drive": "speed"}
    elastic, propeller = {"final_drive.elastic_mesh": True, "final_drive.error_1": 1e-6}, {"effects.propeller_shaft": True}
    ways = [(carrier, spin) for carrier in ["speed", "torque"] for spin in ["free", "imposed"]]
    drives = [(scene, *way) for scene in scenes for way in ways]
    # at most two speeds can be imposed
    drives += [({**shafts, **side}, *way) for side in [left, right] for way in ways[:1] + ways[2:]]
    drives += [({**ends, **side}, *way) for side in [left, right] for way in ways[:1] + ways[2:]]
    # brakes that slide on wheels with a given speed
    drives += [({**shafts, **values, **side, f"{name}.speed_command": 50.0}, "speed", "free")
               for name, values, side in (("left", brakes, left), ("right", swapped, right))]
    drives += [({**shafts, **left, **right, "effects.strength": True, "effects.tooth_friction": True}, "torque", "free"),
               *(({**ends, "effects.final_drive": True, **values}, carrier, spin)
                 for values in ({}, elastic, {**elastic, **propeller}, propeller, brakes, swapped, clutches,
                                {"effects.strength": True, "effects.tooth_friction": True}) for carrier, spin in ways)]
    for contact in ["tooth", "lumped", "ideal"]:
        for scene, carrier, spin in drives:
            if contact != "tooth":
                scene = {**scene, "effects.tooth_friction": False,
                         "effects.thrust_friction": contact == "lumped" and scene.get("effects.thrust_friction", False),
                         "effects.strength": contact == "lumped" and scene.get("effects.strength", False)}
            for kind in ["CoSimulation", "ModelExchange"]:
                with fmu.open(kind) as opened:
                    opened.initialise(scene | {"geometry.planet_count": 4, "scene.gear_contact": contact,
                                               "scene.carrier_drive": carrier, "scene.planet_spin": spin,
                                               "spin.command": 1.0})
                    if kind == "CoSimulation":
                        opened.step(1e-3)
                    observed |= acted_on(opened, inputs, outputs)
    assert observed - declared == set()
    # numbers of pairs, phases and the position of a pair jump when a load passes through zero or a clutch switches; efficiency is 1 if nothing is lost; and these
    # meshes have one pair
    quiet = re.compile(r"_pairs$|dog_phase$|efficiency$|mesh\.pair\[1\]\.(tooth|height)$|mesh\.pair\[[23]\]")
    # the command of the pinion acts as that of the carrier; forces of ring gear and bearings follow from the carrier's torque
    front = re.compile(r"^(ring_gear|left_bearing|right_bearing)\.")
    known = {(output, name.replace("carrier.", "pinion.")) for output, name in observed}
    known |= {(output, name) for output, name in declared if front.search(output) and ("carrier.torque", name) in observed | known}
    assert {(output, name) for output, name in declared - observed - known if not quiet.search(output)} == set()
