"""Port of the drive: the carrier, or with effects.final_drive the pinion, or the propeller shaft in front of it.

Commands of the carrier have no influence there: the port has commands of its own, which are faster by the ratio i of the final drive
and have smaller torques. Outputs `propeller.*` are those of the port in all scenes."""

from typing import TYPE_CHECKING

from .values import Number, Value

if TYPE_CHECKING:
    from .scene import Scene

TORQUE, SPEED = "carrier.torque_command", "carrier.speed_command"
PORT = {TORQUE: "pinion.torque_command", SPEED: "pinion.speed_command"}
# motion and torque of the port
PORT_SPEED, PORT_ANGLE, PORT_TORQUE = "propeller.speed", "propeller.angle", "propeller.torque"


def drive_ratio(scene: "Scene") -> float | None:
    """Ratio of the speeds of pinion and carrier; None without a final drive."""
    if not scene.value("effects.final_drive"):
        return None
    return float(scene.value("final_drive.ring_teeth")) / float(scene.value("final_drive.pinion_teeth"))


def port_command(scene: "Scene", name: str) -> str:
    """Input of the port for the carrier's command `name`. Other names are returned unchanged."""
    return PORT.get(name, name) if scene.value("effects.final_drive") else name


def port_value(scene: "Scene", name: str, value: float) -> float:
    """Value of the port's input that corresponds to the `value` of the carrier's command `name`."""
    ratio = drive_ratio(scene)
    if ratio is None or name not in PORT:
        return value
    return value * ratio if name == SPEED else value / ratio
