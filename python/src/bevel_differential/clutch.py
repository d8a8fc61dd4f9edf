"""Start values of the clutch packs, from their drawing or from a measured bias ratio."""

import copy
import math
from dataclasses import dataclass
from typing import Self

from .answers import ask
from .fmu import Fmu
from .values import DifferentialError, FileName, Value

# a ramp is parallel to the axis if its angle differs from 90° by less than this [rad]
PARALLEL = 1e-9
RIGHT_ANGLE = 0.5 * math.pi


@dataclass(frozen=True)
class Clutch:
    """Clutch packs of a limited-slip differential, one on each side gear.

    `values` contains start values of the FMU by name, for `Differential({…} | clutch.values)` or `scene.set(clutch.values)`."""

    values: dict[str, Value]

    @classmethod
    def from_plates(cls, faces: Value, friction: Value, inner: Value, outer: Value, ramp_drive: Value, ramp_coast: Value,
                    ramp_radius: Value, spring_force: Value = 0.0, gear_thrust: bool = False, *, fmu: FileName | Fmu | None = None) -> Self:
        """Clutch packs from the dimensions of their plates and of the ramps that press them.

        `faces`: number n of rubbing faces of each pack. `friction`: their coefficient of friction μ. `inner`, `outer`: radii r_i and r_o
        of the faces [m]. `ramp_drive`, `ramp_coast`: angles β between the ramps and the plane of rotation, above 0 and up to 90° [rad].
        The drive ramps bear while the carrier drives the wheels forward, the coast ramps in overrun and in reverse. A ramp of 90° is
        parallel to the axis and presses nothing. `ramp_radius`: radius r at which the cross-shaft pushes on the ramps [m].
        `spring_force`: axial force of the springs on each pack [N]. `gear_thrust`: true if the side gears press the plates. Numbers are in SI; texts such as "52 mm" and "45 deg" and pairs
        (number, unit) are converted. `fmu`: the FMU whose units and ranges are used.

        With uniform wear, the mean radius is r_m = (r_i + r_o)/2, and the axial force F gives a pack the torque n μ r_m F. The meshes
        transmit the torque T = Q_L + Q_R of the carrier, so the cross-shaft pushes on the ramps with the tangential force T/r. Each of the
        two pressure rings bears half of it. Its ramps convert this half to the axial force T/(2 r tan β). The torque of a pack is
        n μ r_m T/(2 r tan β), which is κ times the mean T/2 of both mesh torques:

            torque_coefficient  κ = n μ r_m/(r tan β_drive)       pressed_by  both_sides
            coast_ratio  tan β_drive/tan β_coast                  preload  n μ r_m × spring_force
            thrust_arm  n μ r_m, with gear_thrust

        While the clutches slip, the torques of the wheels differ by κ T plus twice the preload. Raises `DifferentialError`."""
        of = _Arguments("Clutch.from_plates", Fmu.of(fmu))
        lengths, angles = {"inner": inner, "outer": outer, "ramp_radius": ramp_radius}, {"ramp_drive": ramp_drive, "ramp_coast": ramp_coast}
        dimensions = {
            "faces": of.number("faces", faces, least=1.0),
            "friction": of.like("friction", friction, "limited_slip.plate_coefficient"),
            **{name: of.length(name, radius) for name, radius in lengths.items()},
            **{name: of.angle(name, angle) for name, angle in angles.items()},
            "spring_force": of.number("spring_force", spring_force, "planet[1].thrust_force", least=0.0),
            **({"gear_thrust": True} if gear_thrust else {}),
        }
        try:
            return cls(ask({"ask": "clutch", "of": dimensions})["set"])
        except DifferentialError as error:
            raise DifferentialError(f"{of.call}: {error}", kind=error.kind) from None

    @classmethod
    def from_bias_ratio(cls, tbr: Value, preload: Value = 0.0, *, fmu: FileName | Fmu | None = None) -> Self:
        """Clutch packs from the torque bias ratio TBR = T_slow/T_fast of the wheels, if nothing else is known.

        Without preload, a slipping pack moves κ times the mesh torque Q, so the wheels have (1 ± κ) Q and TBR = (1 + κ)/(1 − κ). This
        gives κ = (TBR − 1)/(TBR + 1). `tbr` must be 1 or more; 1 is an open differential. `preload`: torque of each pack without load
        [N·m], which adds to the bias. Raises `DifferentialError`."""
        of = _Arguments("Clutch.from_bias_ratio", Fmu.of(fmu))
        ratio = of.number("tbr", tbr, least=1.0)
        found: dict[str, Value] = {
            "effects.limited_slip": True,
            "limited_slip.preload": of.like("preload", preload, "limited_slip.preload"),
            "limited_slip.torque_coefficient": (ratio - 1.0) / (ratio + 1.0),
        }
        return cls(found)


class _Arguments:
    """Arguments of a call, which have the units of variables of an FMU."""

    def __init__(self, call: str, fmu: Fmu):
        self.call, self.fmu = call, fmu

    def number(self, name: str, value: Value, like: str = "limited_slip.torque_coefficient", *, least: float | None = None,
               above: float | None = None, most: float | None = None) -> float:
        """SI value of an argument with the unit of the variable `like`. The limits are SI; `above` does not belong to the range."""
        variable = copy.copy(self.fmu.variable(like))
        variable.name = f"{self.call}: {name}"
        found = float(variable.number(value))
        low = -math.inf if least is None else least
        if found < low or (above is not None and found <= above) or (most is not None and found > most):
            ends = (("above {}", above), ("{} or more", least), ("at most {}", most))
            limits = [words.format(_shown(variable, limit)) for words, limit in ends if limit is not None]
            unit = f"; numbers are in {variable.unit}" if variable.unit not in (None, "", "1") and not variable.has_unit(value) else ""
            raise DifferentialError(f"{variable.name} = {_written(value)}: it must be {' and '.join(limits)}{unit}")
        return found

    def like(self, name: str, value: Value, variable: str) -> float:
        """SI value of an argument with the unit and the range of a variable."""
        return self.number(name, value, variable, least=_limit(self.fmu.variable(variable).minimum),
                           most=_limit(self.fmu.variable(variable).maximum))

    def length(self, name: str, value: Value) -> float:
        """Length above 0 [m]."""
        return self.number(name, value, "limited_slip.mean_radius", above=0.0)

    def angle(self, name: str, value: Value) -> float:
        """Angle of a ramp, above 0 and up to 90° [rad]."""
        return min(self.number(name, value, "geometry.pressure_angle", above=0.0, most=RIGHT_ANGLE + PARALLEL), RIGHT_ANGLE)


def _shown(variable, limit):
    unit, size = variable.shown(limit)
    return f"{size:.6g} {unit}".rstrip()


def _limit(value):
    return None if value is None else float(value)


def _written(value):
    return " ".join(map(str, value)) if isinstance(value, tuple) else repr(value)
