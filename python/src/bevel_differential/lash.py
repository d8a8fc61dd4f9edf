"""Lash at the port of the drive: angle through which the port turns freely while both wheels are held.

The gears of the differential have the backlash j_t at the outer pitch radius m z_s/2 of the side gears, in both meshes of each planet.
With both side gears held, planets do not spin, so that the carrier turns by j_t over this radius. A ring gear with the lash j_t at its mean
radius r turns by j_t/r. If a closed dog clutch has the lash b between
a side gear and its held wheel, this side gear turns by b, and the carrier by b/2. All angles are multiplied by the ratio at the port."""

from collections.abc import Callable
from dataclasses import dataclass

from .drive_port import drive_ratio
from .values import Number

# choices of disconnect.sides with one clutch, and command above which a dog clutch closes
LEFT, RIGHT, CLOSES = 1, 2, 0.5


@dataclass(frozen=True)
class Lash:
    """Lash of one source: `length`, j_t [m], at the `radius` [m], and its `angle` at the port [rad]. A dog clutch has the radius 0, because
    its lash is an angle."""

    source: str
    length: float
    radius: float
    angle: float


def closed_dogs(value: Callable[[str], Number]) -> list[str]:
    """Sides with a dog clutch that is closed by its command."""
    if not value("effects.disconnect"):
        return []
    return [side for side, others in (("left", RIGHT), ("right", LEFT))
            if value("disconnect.sides") != others and float(value(f"{side}.dog_command")) > CLOSES]


def lash_by_source(value: Callable[[str], Number], has_teeth: bool) -> list[Lash]:
    """Lash of the final drive, if it is on, of the differential's gears, and of closed dog clutches. Rigid meshes and gears without teeth
    have none. `value` returns the value of a parameter or an input, SI."""
    length = float(value("geometry.backlash")) if has_teeth and value("effects.backlash") else 0.0
    radius = 0.5 * float(value("geometry.module")) * float(value("geometry.side_teeth"))
    found = [("gears of the differential", length, radius)]
    if value("effects.final_drive"):
        length = float(value("final_drive.backlash")) if value("final_drive.elastic_mesh") else 0.0
        found.insert(0, ("final drive", length, float(value("final_drive.mean_radius"))))
    ratio = drive_ratio(value)
    dogs = [Lash(f"{side} dog clutch", 0.0, 0.0, 0.5 * ratio * float(value("disconnect.lash"))) for side in closed_dogs(value)]
    return [*(Lash(source, length, radius, ratio * length / radius) for source, length, radius in found), *dogs]
