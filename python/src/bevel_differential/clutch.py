"""Start values of the clutch packs, from their drawing or from a measured bias ratio."""

import copy
from dataclasses import dataclass
from typing import Self

from .answers import ask, written
from .fmu import Fmu
from .values import DifferentialError, FileName, Quantity, Value


@dataclass(frozen=True)
class Clutch:
    """Clutch packs of a limited-slip differential, one on each side gear.

    `values` contains start values of the FMU by name, for `Differential({…} | clutch.values)` or `scene.set(clutch.values)`."""

    values: dict[str, Value]

    @classmethod
    def from_plates(cls, faces: Value, friction: Value, inner: Value, outer: Value, ramp_drive: Value, ramp_coast: Value,
                    ramp_radius: Value, spring_force: Value = 0.0, gear_thrust: bool = False) -> Self:
        """Clutch packs from the dimensions of their plates and of the ramps that press them.

        `faces`: number n of rubbing faces of each pack. `friction`: their coefficient of friction μ. `inner`, `outer`: radii r_i and r_o
        of the faces [m]. `ramp_drive`, `ramp_coast`: angles β between the ramps and the plane of rotation, above 0 and up to 90° [rad].
        The drive ramps bear while the carrier drives the wheels forward, the coast ramps in overrun and in reverse. A ramp of 90° is
        parallel to the axis and presses nothing. `ramp_radius`: radius r at which the cross-shaft pushes on the ramps [m].
        `spring_force`: axial force of the springs on each pack [N]. `gear_thrust`: true if the side gears press the plates. Numbers are in SI; texts such as "52 mm" and "45 deg" and pairs
        (number, unit) are converted.

        With uniform wear, the mean radius is r_m = (r_i + r_o)/2, and the axial force F gives a pack the torque n μ r_m F. The meshes
        transmit the torque T = Q_L + Q_R of the carrier, so the cross-shaft pushes on the ramps with the tangential force T/r. Each of the
        two pressure rings bears half of it. Its ramps convert this half to the axial force T/(2 r tan β). The torque of a pack is
        n μ r_m T/(2 r tan β), which is κ times the mean T/2 of both mesh torques:

            torque_coefficient  κ = n μ r_m/(r tan β_drive)       pressed_by  both_sides
            coast_ratio  tan β_drive/tan β_coast                  preload  n μ r_m × spring_force
            thrust_arm  n μ r_m, with gear_thrust

        While the clutches slip, the torques of the wheels differ by κ T plus twice the preload. Raises `DifferentialError`."""
        given = {"faces": faces, "friction": friction, "inner": inner, "outer": outer, "ramp_drive": ramp_drive, "ramp_coast": ramp_coast,
                 "ramp_radius": ramp_radius, "spring_force": spring_force}
        dimensions = {name: _readable(f"Clutch.from_plates: {name}", value) for name, value in given.items()}
        try:
            return cls(ask({"ask": "clutch", "of": {**dimensions, "gear_thrust": bool(gear_thrust)}})["set"])
        except DifferentialError as error:
            raise DifferentialError(f"Clutch.from_plates: {error}", kind=error.kind) from None

    @classmethod
    def from_bias_ratio(cls, tbr: Value, preload: Value = 0.0, *, fmu: FileName | Fmu | None = None) -> Self:
        """Clutch packs from the torque bias ratio TBR = T_slow/T_fast of the wheels, if nothing else is known.

        Without preload, a slipping pack moves κ times the mesh torque Q, so the wheels have (1 ± κ) Q and TBR = (1 + κ)/(1 − κ). This
        gives κ = (TBR − 1)/(TBR + 1). `tbr` must be 1 or more; 1 is an open differential. `preload`: torque of each pack without load
        [N·m], which adds to the bias. Raises `DifferentialError`."""
        call = "Clutch.from_bias_ratio"
        ratio = float(Quantity(f"{call}: tbr", "1").number(tbr))
        if ratio < 1.0:
            raise DifferentialError(f"{call}: tbr = {tbr!r}: it must be 1 or more")
        variable = copy.copy(Fmu.of(fmu).variable("limited_slip.preload"))
        variable.name = f"{call}: preload"
        torque = variable.number(preload)
        variable.check_range(torque, preload)
        return cls({"effects.limited_slip": True, "limited_slip.preload": torque,
                    "limited_slip.torque_coefficient": (ratio - 1.0) / (ratio + 1.0)})


def _readable(name, value):
    """Value for the library of answers, which checks dimensions: a text with a unit, or a number in SI."""
    quantity = Quantity(name, "1")
    return written(value) if quantity.has_unit(value) else quantity.number(value)
