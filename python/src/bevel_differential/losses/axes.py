"""Axes of a map in pictures, tables and sentences: in N·m, rpm and °C, unless the scene prefers other units."""

from typing import TypeVar

import numpy as np

from ..fmu import Fmu
from ..panel import Axis as PanelAxis
from ..report import words
from ..scene import Scene
from . import VARIABLES

TORQUE_AXIS, SPEED_AXIS, SLIP_AXIS, TEMPERATURE_AXIS = range(4)
NAMES = ("carrier torque", "carrier speed", "difference of speeds (left − right)", "temperature of oil and surfaces")

_Values = TypeVar("_Values", float, np.ndarray)


class Axis:
    """Axis of a map: `unit` as text, and `label`, a name with the unit. All torques have the unit of the first axis."""

    def __init__(self, fmu: Fmu, axis: int):
        if "rad/s" not in fmu.display_units:
            fmu = fmu.displaying(["rpm"])
        variable = fmu.variable(VARIABLES[axis])
        self._variable = variable.differences() if axis == SLIP_AXIS else variable
        # temperatures are in °C, although other quantities may be in SI
        self._preferred = {self._variable.unit or "": ""} if axis == TEMPERATURE_AXIS else fmu.display_units
        unit, _ = self._variable.in_files(0.0, self._preferred)
        self.unit = words.unit_text(unit).replace("degC", "°C")
        self.label = f"{NAMES[axis]}, {self.unit}"

    def named(self, name: str) -> PanelAxis:
        """Axis of another quantity in the same unit."""
        return PanelAxis(f"{name}, {self.unit}", self.values)

    def values(self, values: _Values) -> _Values:
        """SI `values`, converted to the unit of the axis."""
        return self._variable.in_files(values, self._preferred)[1]

    def text(self, value: float, digits: int = 4) -> str:
        """Text of an SI value with its unit."""
        return words.quantity(float(self.values(value)), self.unit, digits)


def axes(scene: Scene) -> tuple[Axis, Axis, Axis, Axis]:
    """Axes of torque, speed, difference of speeds and temperature, in the preferred units of a scene."""
    torque, speed, slip, temperature = (Axis(scene.fmu, axis) for axis in (TORQUE_AXIS, SPEED_AXIS, SLIP_AXIS, TEMPERATURE_AXIS))
    return torque, speed, slip, temperature
