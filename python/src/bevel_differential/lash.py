"""Lash at the port of the drive: angle through which the port turns freely while both side gears are held.

The gears of the differential have the backlash j_t at the outer pitch radius m z_s/2 of the side gears, in both meshes of each planet.
With both side gears held, planets do not spin, so that the carrier turns by j_t over this radius. A ring gear with the lash j_t at its mean
radius r turns by j_t/r. Both angles are multiplied by the ratio at the port."""

from collections.abc import Callable
from dataclasses import dataclass

from .drive_port import drive_ratio
from .values import Number


@dataclass(frozen=True)
class Lash:
    """Lash of one source: `length`, j_t [m], at the `radius` [m], and its `angle` at the port [rad]."""

    source: str
    length: float
    radius: float
    angle: float


def lash_by_source(value: Callable[[str], Number], has_teeth: bool) -> list[Lash]:
    """Lash of the final drive, if it is on, and of the differential's gears. Rigid meshes and gears without teeth have none. `value`
    returns the value of a parameter, SI."""
    length = float(value("geometry.backlash")) if has_teeth and value("effects.backlash") else 0.0
    radius = 0.5 * float(value("geometry.module")) * float(value("geometry.side_teeth"))
    found = [("gears of the differential", length, radius)]
    if value("effects.final_drive"):
        length = float(value("final_drive.backlash")) if value("final_drive.elastic_mesh") else 0.0
        found.insert(0, ("final drive", length, float(value("final_drive.mean_radius"))))
    return [Lash(source, length, radius, drive_ratio(value) * length / radius) for source, length, radius in found]
