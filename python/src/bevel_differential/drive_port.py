"""Port of the drive: the carrier, or with effects.final_drive the pinion, or the propeller shaft in front of it.

Commands of the carrier have no influence there: the port has commands of its own, which are faster by the ratio i of the final drive
and have smaller torques. Outputs `propeller.*` are those of the port in all scenes. `value` returns the value of a parameter."""

from collections.abc import Callable

from .values import Number

TORQUE, SPEED = "carrier.torque_command", "carrier.speed_command"
PORT = {TORQUE: "pinion.torque_command", SPEED: "pinion.speed_command"}
# motion and torque of the port
PORT_SPEED, PORT_TORQUE = "propeller.speed", "propeller.torque"

Parameters = Callable[[str], Number]


def drive_ratio(value: Parameters) -> float:
    """Speed of the port over that of the carrier; 1 without a final drive."""
    if not value("effects.final_drive"):
        return 1.0
    return float(value("final_drive.ring_teeth")) / float(value("final_drive.pinion_teeth"))


def port_command(value: Parameters, name: str) -> str:
    """Input of the port for the carrier's command `name`. Other names are returned unchanged."""
    return PORT.get(name, name) if value("effects.final_drive") else name


def port_value(value: Parameters, name: str, of_carrier: float) -> float:
    """Value of the port's input for the value `of_carrier` of the carrier's command `name`. Other inputs keep their values."""
    ratio = drive_ratio(value)
    return of_carrier * ratio if name == SPEED else of_carrier / ratio if name == TORQUE else of_carrier


def port_inertia(value: Parameters) -> str:
    """Inertia of the body that the drive turns."""
    if not value("effects.final_drive"):
        return "inertia.carrier"
    return "inertia.propeller_end" if value("effects.propeller_shaft") else "inertia.pinion"
