"""Start values of the clutch packs, from their drawing or from a measured bias ratio."""

import copy
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

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
                    ramp_radius: Value, spring_force: Value = 0.0, *, fmu: FileName | Fmu | None = None) -> Self:
        """Clutch packs from the dimensions of their plates and of the ramps that press them.

        `faces`: number n of rubbing faces of each pack. `friction`: their coefficient of friction μ. `inner`, `outer`: radii r_i and r_o
        of the faces [m]. `ramp_drive`, `ramp_coast`: angles β between the ramps and the plane of rotation, above 0 and up to 90° [rad].
        The drive ramps bear while the carrier drives the wheels forward, the coast ramps in overrun and in reverse. A ramp of 90° is
        parallel to the axis and presses nothing. `ramp_radius`: radius r at which the cross-shaft pushes on the ramps [m].
        `spring_force`: axial force of the springs on each pack [N]. Numbers are in SI; texts such as "52 mm" and "45 deg" and pairs
        (number, unit) are converted. `fmu`: the FMU whose units and ranges are used.

        With uniform wear, the mean radius is r_m = (r_i + r_o)/2, and the axial force F gives a pack the torque n μ r_m F. The meshes
        transmit the torque T = Q_L + Q_R of the carrier, so the cross-shaft pushes on the ramps with the tangential force T/r. Each of the
        two pressure rings bears half of it. Its ramps convert this half to the axial force T/(2 r tan β). The torque of a pack is
        n μ r_m T/(2 r tan β), which is κ times the mean T/2 of both mesh torques:

            torque_coefficient  κ = n μ r_m/(r tan β_drive)       pressed_by  both_sides
            coast_ratio  tan β_drive/tan β_coast                  preload  n μ r_m × spring_force

        While the clutches slip, the torques of the wheels differ by κ T plus twice the preload. Raises `DifferentialError`."""
        of = _Arguments("Clutch.from_plates", Fmu.of(fmu))
        count = of.number("faces", faces, least=1.0)
        if count != int(count):
            raise DifferentialError(f"{of.call}: faces = {faces!r}: it is a whole number of 1 or more")
        share = of.like("friction", friction, "limited_slip.plate_coefficient")
        smaller, larger = (of.length(name, radius) for name, radius in (("inner", inner), ("outer", outer)))
        if not smaller < larger:
            raise DifferentialError(f"{of.call}: inner = {inner!r} is not below outer = {outer!r}; both are radii of the faces, in m if "
                                    "they are numbers")
        drive, coast = (_cotangent(of.angle(name, angle)) for name, angle in (("ramp_drive", ramp_drive), ("ramp_coast", ramp_coast)))
        lever = of.length("ramp_radius", ramp_radius)
        force = of.number("spring_force", spring_force, "planet[1].thrust_force", least=0.0)
        if drive == 0.0 and coast > 0.0:
            raise DifferentialError(
                f"{of.call}: ramp_drive = {ramp_drive!r} presses nothing, but ramp_coast = {ramp_coast!r} presses the packs: the FMU "
                "refers the coast ramps to the drive ramps, so these must press; turn the signs of all torques and speeds of the scene, "
                "and exchange ramp_drive and ramp_coast")
        mean = 0.5 * (smaller + larger)
        per_force = count * share * mean
        found: dict[str, Value] = {
            "effects.limited_slip": True,
            "limited_slip.preload": per_force * force,
            "limited_slip.torque_coefficient": per_force / lever * drive,
            # without any ramp that presses, the start values of both are right
            "limited_slip.pressed_by": "both_sides" if drive else "own_side",
            "limited_slip.coast_ratio": coast / drive if drive else 1.0,
            "limited_slip.mean_radius": mean,
            "limited_slip.friction_area": count * math.pi * (larger * larger - smaller * smaller),
            "limited_slip.plate_coefficient": share,
        }
        of.check(found, {
            "preload": "faces, friction, inner, outer and spring_force",
            "torque_coefficient": "faces, friction, inner, outer, ramp_drive and ramp_radius",
            "coast_ratio": "ramp_drive and ramp_coast",
            "mean_radius": "inner and outer",
            "friction_area": "faces, inner and outer",
        })
        return cls(found)

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

    def check(self, values: Mapping[str, Any], causes: Mapping[str, str]) -> None:
        """Checks that values of `limited_slip`, which follow from the arguments in `causes`, are in the ranges of the FMU."""
        for name, arguments in causes.items():
            variable = self.fmu.variable(f"limited_slip.{name}")
            number, low, high = values[variable.name], _limit(variable.minimum), _limit(variable.maximum)
            if not (low is None or low <= number) or not (high is None or number <= high):
                unit = "" if variable.unit in (None, "1") else f" {variable.unit}"
                raise DifferentialError(f"{self.call}: {variable.name} = {number:.6g}{unit}, calculated from {arguments}, is outside "
                                        f"[{low:g}, {high:g}]{unit}")


def _shown(variable, limit):
    unit, size = variable.shown(limit)
    return f"{size:.6g} {unit}".rstrip()


def _limit(value):
    return None if value is None else float(value)


def _written(value):
    return " ".join(map(str, value)) if isinstance(value, tuple) else repr(value)


def _cotangent(angle):
    """1/tan of the angle of a ramp; exactly 0 at 90°."""
    return 0.0 if RIGHT_ANGLE - angle < PARALLEL else 1.0 / math.tan(angle)
