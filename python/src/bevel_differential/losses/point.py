"""Point of the map: the scene with a given carrier torque, carrier speed, difference of wheel speeds and oil temperature, run
until its means settle.

The carrier is driven by torque, both wheels by speed. Means are over whole mesh cycles: of torques sampled within a cycle, and of
the heat that a cycle adds. A slow cycle costs no more than a fast one, because steps grow with it. Well damped half-shafts keep
falling friction from juddering, so the means are quasi-static at small differences. Without a difference, the differential is
stuck: it is wound up in both directions, slowly, over a mesh cycle, and its torques range up to breakaway.

With a final drive, torque and speed act on its port. Both are still referred to the carrier, so that the balance of torques and powers
is the same, and the loss includes the heat of final drive and propeller shaft. Dog clutches are closed: their lash changes no mean, so the
bench leaves them out."""

from collections.abc import Callable, Container, Mapping
from math import ceil, lcm, pi
from typing import Any

import numpy as np

from ..drive_port import PORT, port_command, port_value
from ..instance import Instance
from ..scene import Scene
from ..values import UNFELT, Number
from ..want import Want
from ..warned import warn
from ..designs.task import Row

# variables that define a point
AXES = ["carrier.torque_command", "carrier.speed_command", "left.speed_command", "right.speed_command", "oil.temperature"]
TORQUES = ["left.shaft_torque", "right.shaft_torque"]
FIGURES = ["left.shaft_torque:mean", "right.shaft_torque:mean", "power.loss:mean", "left.shaft_torque:min", "left.shaft_torque:max"]
# drives of a bench; without the effect warm_up, all surfaces have the temperature of the oil
BENCH = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "scene.planet_spin": "free",
         "scene.start": "equilibrium", "effects.warm_up": False, "effects.wheel_brake": False, "effects.disconnect": False}
SHAFTS = ["half_shaft.left", "half_shaft.right"]
# inputs that act on a bench, too, and are constant there
COMMANDS = ["left.clutch_command", "right.clutch_command", "lock.command"]
# commands of dog clutches, whose side is open up to this command
DOGS, OPEN = ["left.dog_command", "right.dog_command"], 0.5
# damping over stiffness of the half-shafts, s: the means of the torques do not depend on it
DAMPING_TIME = 0.01
# samples of a mesh cycle; shortest time window over which means are compared, s; maximum number of windows
SAMPLES, SHORTEST, MOST = 48, 0.02, 12
# means have settled if they change by less than this fraction, or by this torque [N·m]
STILL, STILL_TORQUE = 1e-3, 0.01
# difference of speeds at which a stuck differential is wound up [rad/s]; samples and levels of the search for its peak
CREEP, FINER, LEVELS = 0.02, 20, 3


def benched(scene: Scene, given: Container[str] = ()) -> Scene:
    """Copy of the scene on the bench: its parameters, driven by torque and speeds, without its changes over time. Warns of commands that
    change over time in the scene, unless each run has them `given`, and of dog clutches that are not always closed there."""
    changed = {name for name, *_ in scene.tables}.union(*(values for _, values in scene.changes))
    warn(f"{name} changes over time in the scene, but is constant at {scene.value(name):g} here: give the scene a constant value"
         for name in COMMANDS if name in changed and name not in given)
    if scene.value("effects.disconnect"):
        warn(f"{name} opens a dog clutch in the scene, but it is closed here" for name in DOGS if name in changed or scene.value(name) <= OPEN)
    values = {name: value for name, value in scene.values.items() if name not in DOGS and not name.startswith("disconnect.")} | BENCH
    values |= {f"{shaft}_damping": DAMPING_TIME * scene.value(f"{shaft}_stiffness") for shaft in SHAFTS}
    return Scene(scene.name, description=scene.description, stop=scene.stop, step=scene.step, set=values, fmu=scene.fmu)


def pressed(scene: Scene) -> list[str]:
    """Sides whose clutch on command is pressed, with a command above the dead band of its actuator."""
    free = scene.value("clutches.dead_band")
    return [side for side in ("left", "right") if scene.value("effects.clutches") and scene.value(f"{side}.clutch_command") > free]


class PointTask:
    """Task of `designs.Farm` for a point of the map.

    The figures of a row are those of FIGURES in SI. For a slipping differential, smallest and largest torque are those of a mesh
    cycle; for a stuck one, those at breakaway. `feasible`: true if the means settle; otherwise they are those of the last cycles."""

    def __init__(self, scene: Scene):
        self.scene = scene
        self.figures = [Want.parse(scene.fmu, figure) for figure in FIGURES]
        # brake heat is excluded, because it belongs to the power that the wheels receive
        self.heats = [name for name in scene.fmu.variables if name.startswith("heat.") and name != "heat.brake"]
        self._instance: Instance | None = None

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_instance": None}

    def close(self) -> None:
        """Frees the instance."""
        if self._instance is not None:
            self._instance.close()
            self._instance = None

    def evaluate(self, run: int, values: Mapping[str, Number]) -> Row:
        """Evaluates a point. A failed run also returns a row."""
        return Row(run, dict(values)).filled(self._fill)

    def warnings(self, values: Mapping[str, Number]) -> list[str]:
        """Warnings of the FMU in the run of a point, except those about values that the bench sets."""
        return list(self.evaluate(0, values).warnings or ())

    def _fill(self, row):
        figures, row.feasible = self._stuck(row.values) if _difference(row.values) == 0.0 else self._slipping(row.values)
        row.figures, row.warnings = dict(zip(FIGURES, figures)), self._warnings(row.values)

    def _warnings(self, values):
        own = {*AXES[:-1], *PORT.values(), *BENCH, *(f"{shaft}_damping" for shaft in SHAFTS)}
        said = self._instance.messages if self._instance is not None else []
        # values of the scene that act only under its own drives, effects and parameters are no mistakes
        benched = [f" {name} " for name in (*BENCH, *values)]
        return tuple(text for text in said if not (UNFELT in text and (text.partition(": ")[0] in own or any(name in text for name in benched))))

    def _begun(self, values):
        if self._instance is None:
            self._instance = self.scene.fmu.open()
        value = self.scene.value
        at_port = {port_command(value, name): port_value(value, name, float(number)) for name, number in values.items()}
        return self._instance.initialise({**self.scene.values, **at_port})

    def _slipping(self, values):
        instance = self._begun(values)
        cycle, period = _cycles(instance, _difference(values))
        return self._settled(instance, cycle, period)

    def _settled(self, instance, cycle, period):
        """Figures over the first window whose means are nearly equal to those of the window before, and true if there is such a window."""
        window = ceil(SHORTEST / (cycle * period)) * period
        means = []
        while len(means) < MOST:
            samples, heat = self._window(instance, cycle / SAMPLES, window * SAMPLES)
            means.append(np.array([*samples.mean(axis=0), heat / (window * cycle)]))
            if len(means) > 1 and np.all(np.abs(means[-1] - means[-2]) < STILL * np.abs(means[-1]) + STILL_TORQUE):
                return [*means[-1], samples[:, 0].min(), samples[:, 0].max()], True
        return [*np.mean(means[MOST // 2:], axis=0), samples[:, 0].min(), samples[:, 0].max()], False

    def _window(self, instance, size, steps):
        """Torques after each of `steps` steps of `size`, s, shape (steps, 2), and the heat of all of them, J."""
        before = sum(instance.read(self.heats))
        samples = []
        for _ in range(steps):
            instance.step(size)
            samples.append(instance.read(TORQUES))
        return np.array(samples), sum(instance.read(self.heats)) - before

    def _stuck(self, values):
        instance = self._begun(values)
        (*means, _, _), still = self._settled(instance, SHORTEST, 1)
        ends = []
        for sign in (1.0, -1.0):
            # friction holds at the start, before the wheels begin to turn apart
            instance = self._begun(values)
            instance.set({"left.speed_command": values["left.speed_command"] + sign * CREEP / 2.0,
                          "right.speed_command": values["right.speed_command"] - sign * CREEP / 2.0})
            cycle, _ = _cycles(instance, CREEP)
            # the faster wheel has the smaller torque
            ends.append(-sign * peak(instance, lambda of: -sign * of.get(TORQUES[0]), cycle / SAMPLES, SAMPLES))
        return [*means, *sorted(ends)], still


def peak(instance: Instance, read: Callable[[Instance], Number], size: float, steps: int, level: int = 0) -> float:
    """Largest value of `read` over `steps` steps of `size`, s. Steps are refined where its growth first falls below half, which happens
    when friction breaks loose."""
    kept = [instance.save()] * 2
    seen = [float(read(instance))]
    greatest, is_first = -np.inf, True
    for _ in range(steps):
        kept = [kept[1], instance.save()] if is_first else kept
        instance.step(size)
        seen.append(float(read(instance)))
        if is_first and level < LEVELS and len(seen) > 2 and seen[-1] - seen[-2] < 0.5 * (seen[-2] - seen[-3]):
            here = instance.save()
            greatest = peak(instance.restore(kept[0]), read, size / FINER, 2 * FINER, level + 1)
            instance.restore(here)
            is_first = False
    return max(greatest, *seen)


def _difference(values):
    return values["left.speed_command"] - values["right.speed_command"]


def _cycles(instance, difference):
    """Duration of a mesh cycle, s, and mesh cycles until the same teeth meet again; 1 if all teeth are equal."""
    planet, side = instance.read(["geometry.planet_teeth", "geometry.side_teeth"])
    differ = any(instance.read(["effects.tooth_errors", "effects.tooth_fault"]))
    return 4.0 * pi / (side * abs(difference)), lcm(int(planet), int(side)) if differ else 1
