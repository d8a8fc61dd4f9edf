"""Port of the drive: the carrier, or with effects.final_drive the pinion, or the propeller shaft in front of it.

Commands of the carrier have no influence there: the port has commands of its own, which are faster by the ratio i of the final drive
and have smaller torques. Outputs `propeller.*` are those of the port in all scenes. `value` returns the value of a parameter."""

from collections.abc import Callable
from typing import Any

from .scene import Scene
from .values import Number

TORQUE, SPEED = "carrier.torque_command", "carrier.speed_command"
PORT = {TORQUE: "pinion.torque_command", SPEED: "pinion.speed_command"}
# motion and torque of the port
PORT_SPEED, PORT_TORQUE = "propeller.speed", "propeller.torque"

Parameters = Callable[[str], Number]
# parameters on which the port depends
PARAMETERS = ("effects.final_drive", "final_drive.ring_teeth", "final_drive.pinion_teeth")


def drive_ratio(value: Parameters) -> float:
    """Speed of the port over that of the carrier; 1 without a final drive."""
    if not value("effects.final_drive"):
        return 1.0
    return float(value("final_drive.ring_teeth")) / float(value("final_drive.pinion_teeth"))


def port_name(value: Parameters) -> str:
    """Body that the drive turns."""
    if not value("effects.final_drive"):
        return "carrier"
    return "propeller shaft" if value("effects.propeller_shaft") else "pinion"


def port_command(value: Parameters, name: str) -> str:
    """Input of the port for the carrier's command `name`. Other names are returned unchanged."""
    return PORT.get(name, name) if value("effects.final_drive") else name


def port_value(value: Parameters, name: str, of_carrier: Any) -> Any:
    """Value of the port's input for the value `of_carrier` of the carrier's command `name`, a number or an array. Other inputs keep their
    values."""
    ratio = drive_ratio(value)
    return of_carrier * ratio if name == SPEED else of_carrier / ratio if name == TORQUE else of_carrier


def port_inertia(value: Parameters) -> str:
    """Inertia of the body that the drive turns."""
    if not value("effects.final_drive"):
        return "inertia.carrier"
    return "inertia.propeller_end" if value("effects.propeller_shaft") else "inertia.pinion"


def at_port(scene: Scene) -> Scene:
    """Scene whose commands of the carrier act at its port instead, unless the scene commands the port itself."""
    value, contents = scene.value, scene.__getstate__()
    driven = {name for name, *_ in scene.tables} | {name for _, changed in scene.changes for name in changed} | scene.values.keys()
    moved = {name for name in PORT if name in driven and port_command(value, name) not in driven}
    if not value("effects.final_drive") or not moved:
        return scene

    def moved_to(name, given):
        """Name and value at the port."""
        return (PORT[name], port_value(value, name, scene.fmu.variable(name).number(given))) if name in moved else (name, given)

    def at(values):
        return dict(moved_to(name, given) for name, given in values.items())

    tables = [(moved_to(name, values[0])[0], times, [moved_to(name, each)[1] for each in values], period)
              for name, times, values, period in scene.tables]
    return Scene(**contents | {"set": at(scene.values), "changes": [(time, at(values)) for time, values in scene.changes], "tables": tables})
