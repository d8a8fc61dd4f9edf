"""Mirror images: a differential that is reflected, with all speeds and torques, does the same; and so it does a tooth later.

Scenes are those of the other tests, the ready ones and random ones. Individual tooth errors, which the FMU draws from a
seed for either flank, are mirrored by the library's tests (tests/model/mirror)."""

import re
import tomllib
from math import pi, radians
from pathlib import Path

import numpy as np
import plausible_scenes
import pytest
import random_scenes
import test_exchange
import test_hard_clutches
import test_hard_stiffness
import test_solid
import test_steps
import theory
from bevel_differential import DifferentialError
from braking import BRAKED, brakes, drive_torque
from driving import BIAS, GIVEN, STEADY_TURN, TURN, UNLOADED
from bevel_differential.scene_file import flat
from symmetry import Image

SCENES = Path(__file__).resolve().parents[2] / "scenes"
# of the scale, the largest of all quantities of a unit; and where dry friction switches. Twins stay within a hundredth of it.
CLOSE, CLOSE_AT_SWITCHES, TWIN = 1e-9, 1e-6, 0.01
DISTURBANCE = 1e-15
SHARED = {"rad/s", "rad/s2", "N", "N.m", "W", "J", "Pa"}
STEPS = [(1e-3, {})] * 15
WHEELS = {"inertia.left_end": 0.5, "inertia.right_end": 0.5}
ICE = {"left.load_torque": 100.0, **WHEELS}
ODD = {"geometry.planet_teeth": 11, "geometry.side_teeth": 15}
NAMED = {
    "steady turn": STEADY_TURN, "turn": TURN, "bias": BIAS, "unloaded": TURN | UNLOADED, "given": GIVEN | ICE,
    "friction": BIAS | {"effects.thrust_friction": True, "effects.tooth_friction": True},
    "locked wheel": {"scene.left_drive": "speed", "left.speed_command": 0.0, "scene.start": "rolling"},
    "odd teeth": ODD, "three planets": {"geometry.planet_teeth": 10, "geometry.side_teeth": 18, "geometry.planet_count": 3},
    "four planets": {"geometry.planet_teeth": 9, "geometry.side_teeth": 14, "geometry.planet_count": 4, **STEADY_TURN},
    "line": {"contact.law": "line", **STEADY_TURN}, "line_weber": {"contact.law": "line_weber", **ICE},
    "broken": {**STEADY_TURN, "effects.tooth_fault": True, "tooth_fault.at_onset": True, "tooth_fault.onset": 1e-9, "tooth_fault.tooth": 1},
    "brakes": BRAKED | brakes(400.0, 100.0) | drive_torque(300.0) | {"carrier.speed_command": 30.0},
    "warm up": BIAS | {"effects.thrust_friction": True, **theory.CLUTCHES, **theory.DRAG, "effects.warm_up": True,
                       "limited_slip.static_ratio": 1.2, "limited_slip.stribeck_speed": 0.1, "limited_slip.hot_factor": 0.5,
                       "thrust_friction.slip_slope": -0.1, "thrust_friction.cold_factor": 1.5, "warm_up.clutch_capacity": 5.0,
                       "bearing_drag.viscosity_from_oil": True},
    "steady heat": BIAS | {"effects.thrust_friction": True, **theory.CLUTCHES, "effects.warm_up": True,
                           "limited_slip.hot_factor": 0.5, "scene.start": "steady_heat", "warm_up.cycle": 0.01},
    "drag": BIAS | {**theory.DRAG, "bearing_drag.churning_from_geometry": True, "bearing_drag.carrier_diameter": 0.4,
                    "oil.temperature": 263.15, "bearing_drag.seal_diameter": 0.05, "bearing_drag.bearing_load": 1e4},
    "above limits of p v": BIAS | {"effects.thrust_friction": True, **theory.CLUTCHES, "thrust_friction.pv_limit": 2e4,
                                   "thrust_friction.beyond_limit": 1.2, "limited_slip.pv_limit": 1e4, "limited_slip.beyond_limit": 0.7},
    "at rest": BRAKED | brakes(100.0, 50.0) | drive_torque(300.0) | {"scene.start": "rest"},
    "clutch": test_hard_clutches.CLUTCH | {"left.load_torque": 900.0, "right.load_torque": 700.0},
    "misaligned solids": test_solid.SOLID | test_solid.MISALIGNED, "solid turn": test_solid.SOLID | test_solid.STEADY,
    **{f"exchange {name}": scene for name, scene in test_exchange.SCENES.items()},
    **{f"steps {name}": scene for name, scene in test_steps.SCENES.items()},
    **{f"{name} turn": TURN | change for name, change in test_hard_stiffness.CHANGES.items()},
}
# stands between two equal wells, of which a start takes that of positive spin: in the swapped image it is the other one
TIED = ["exchange solid"]
RANDOM, SEED = 10, 7


def ready(path):
    """A scene of a file, its first fifteen steps; a step begins with what the file changes then."""
    with open(path, "rb") as file:
        entry = tomllib.load(file)

    steps = [(entry["step"], {}) for _ in STEPS]
    for change in map(flat, entry.get("at", [])):
        k = round(change.pop("time") / entry["step"])
        if k < len(steps):
            steps[k] = (entry["step"], steps[k][1] | change)
    return {"start": flat(entry.get("set", {})), "steps": steps}


def plausible(fmu, index):
    """A random scene without what the FMU cannot mirror."""
    _, scene = next(random_scenes.scenes(fmu, "plausible", RANDOM, SEED, index, index + 1))
    start = scene["start"]
    start |= {"tooth_errors.accuracy_grade": 0, "tooth_errors.runout_by_grade": False,
              "tooth_errors.planet_runout": 0.0, "tooth_errors.side_runout": 0.0}
    if start["scene.carrier_drive"] == plausible_scenes.TORQUE_CARRIER:
        start["effects.final_drive"] = False
    return scene


class Refused(Exception):
    """A scene that does not start."""


class Course:
    """All outputs at all communication points, until a step fails."""

    def __init__(self, instance, scene):
        instance.set(scene["start"])
        try:
            instance.initialise()
        except DifferentialError as refused:
            raise Refused("; ".join(instance.messages)) from refused
        self.names = [name for name, v in instance.fmu.variables.items() if v.causality == "output"]
        self.times, rows = [0.0], [instance.read(self.names)]
        for size, inputs in scene["steps"]:
            instance.set(inputs)
            try:
                instance.do_step(self.times[-1], size)
            except DifferentialError:
                break
            self.times.append(self.times[-1] + size)
            rows.append(instance.read(self.names))
        self.values = {name: np.array(column) for name, column in zip(self.names, zip(*rows))}


def disturbed(image, sign):
    """The scene of `image` with all inputs and the pressure angle disturbed."""
    def by(name, value):
        exact = image.variables[name].kind != "Real" or name != "geometry.pressure_angle" and (
            image.variables[name].causality != "input" or name == "lock.command")
        return value if exact else value * (1.0 + sign * DISTURBANCE)

    start = {name: by(name, value) for name, value in image.start.items()}
    return {"start": start, "steps": [(size, {n: by(n, v) for n, v in inputs.items()}) for size, inputs in image.steps]}


def scales(image, course):
    """By name: the largest magnitude of all outputs of the unit; energies by what is turned over or carried too."""
    largest = {name: np.max(np.abs(values)) for name, values in course.values.items()}
    units = {name: image.variables[name].unit for name in course.names}
    kinds = {name: unit if unit in SHARED else image.entry(name) for name, unit in units.items()}
    turned = sum(np.sum(np.abs(course.values[name][1:]) * np.diff(course.times)) for name in ("power.in", "power.out"))
    carried = 0.5 * image.start["inertia.carrier"] * largest["carrier.speed"] ** 2
    of_kind = {}
    for name, kind in kinds.items():
        of_kind[kind] = max(of_kind.get(kind, turned + carried if kind == "J" else 0.0), largest[name])
    return {name: of_kind[kind] for name, kind in kinds.items()}


def differences(image, base, twins, mirrored):
    """What does not map, and the share of all values that twins let compare."""
    scale, expected = scales(image, base), image.expected(base.values)
    stuck = sum(base.values[name] for name in ("held.sides", "held.planets", "held.wheels"))
    switches = image.start["effects.thrust_friction"] or image.start["effects.limited_slip"] or np.any(stuck != stuck[0])
    close = CLOSE_AT_SWITCHES if switches or image.start["effects.wheel_brake"] else CLOSE
    reached = min(len(course.times) for course in (base, mirrored, *twins))
    wrong, compared, whole, windows = [], 0, 0, {}
    for name in sorted(filter(image.has, base.names), key=lambda name: name != "solver.step_size"):
        room = close * scale[name]
        far = [np.abs(twin.values[name][:reached] - base.values[name][:reached]) > TWIN * room for twin in twins]
        strays = np.flatnonzero(np.logical_or(*far))
        window = strays[0] if len(strays) else reached
        # counts of steps say nothing before they differ; their size does
        windows[name] = window
        if name in ("solver.steps", "solver.rejected", "solver.rhs_calls"):
            window = min(window, windows["solver.step_size"])
        compared, whole = compared + window, whole + len(base.times)
        there = image.name(name)
        off = np.abs(mirrored.values[there][:window] - expected[there][:window])
        if name.endswith("_pairs") or "mesh.pair[" in name:
            # a mesh that carries next to nothing has no certain number of pairs
            load = "planet[1].left_normal_force" if "mesh.pair[" in name else re.sub("_pairs$", "_normal_force", name)
            off = off[base.values[load][:window] > close * scale[load]]
        if len(off) and not np.all(off <= room):
            wrong.append(f"{name}: off by {np.max(off):.2e}, {np.max(off) / max(scale[name], 1e-300):.1e} of its scale")
    if not twins or min(len(twin.times) for twin in twins) == len(base.times) != len(mirrored.times):
        wrong.append(f"ends after {len(mirrored.times)} points, not {len(base.times)}")
    return wrong, compared / whole


@pytest.fixture
def compare(fmu):
    """compare(scene, way): what does not map, and how much was compared; nothing of a scene that is refused."""

    def course(scene):
        with fmu.open() as instance:
            return Course(instance, scene)

    def compared(scene, way):
        image = Image(fmu, scene, way)
        base = course({"start": image.start, "steps": image.steps})
        twins = [course(disturbed(image, sign)) for sign in (1.0, -1.0)]
        return differences(image, base, twins, course(image.scene()))

    return compared


@pytest.mark.parametrize("way", ["reversed", "swapped"])
@pytest.mark.parametrize("name", NAMED)
def test_the_image_of_a_scene_of_these_tests_does_the_same(compare, name, way):
    # with an odd number of planet teeth the sides stand half a pitch apart at the start (tests/model/mirror)
    if way == "swapped" and (NAMED[name].get("geometry.planet_teeth", 10) % 2 or name in TIED):
        pytest.skip("the image starts elsewhere")
    wrong, share = compare({"start": NAMED[name], "steps": STEPS}, way)
    assert not wrong, "\n".join(wrong)
    assert share > 0.2


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_the_reversed_image_of_a_ready_scene_does_the_same(compare, path):
    wrong, share = compare(ready(path), "reversed")
    assert not wrong, "\n".join(wrong)
    assert share > 0.2


def test_the_reversed_images_of_random_scenes_do_the_same(compare, fmu):
    shares, found = [], []
    for index in range(RANDOM):
        try:
            wrong, share = compare(plausible(fmu, index), "reversed")
        except Refused:
            continue
        shares.append(share)
        found += [f"scene {index}: {what}" for what in wrong]
    assert not found, "\n".join(found)
    assert len(shares) > RANDOM / 2 and np.mean(shares) > 0.6


def test_every_output_and_input_has_an_entry_of_its_own(fmu):
    image = Image(fmu, {"start": {}, "steps": []}, "reversed")
    for name, variable in image.variables.items():
        assert image.parity(name) in ("+", "-", "lash", "wave", "teeth")
        assert variable.causality in ("parameter", "calculatedParameter") or not image.entry(name).endswith("*"), name


def test_a_bias_by_friction_is_above_one_and_the_same_in_reverse_at_every_instant(fmu):
    start = BIAS | {"effects.thrust_friction": True, "effects.tooth_friction": True}
    scene = {"start": start, "steps": [(3e-3, {})] * 100}
    image = Image(fmu, scene, "reversed")
    with fmu.open() as one, fmu.open() as other:
        forward, backward = Course(one, scene), Course(other, image.scene())
    for name in ("torque_bias_ratio", "locking_value"):
        assert backward.values[name] == pytest.approx(forward.values[name], abs=1e-9)
    # one mesh cycle lasts 0.157 s
    settled = np.array(forward.times) > 0.17
    assert np.all(forward.values["torque_bias_ratio"][settled] >= 1.0)


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
            # ten tolerances of the speeds, times 7.8 kHz at which meshes ring
            limit = 10.0 * tolerance * (1.0 + 2.0 * STEADY_TURN["carrier.speed_command"] + spin) * 2.0 * pi * 7800.0
        assert np.max(np.abs(other[:, column] - one[:, column])) <= limit, name
