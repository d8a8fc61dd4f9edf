"""Loads and speeds that an event needs for the drives of its shafts, and their sources.

Start values of the FMU are not used, because nobody has chosen them. A command that is neither in the event nor in the scene nor in
the parameters is therefore an error. A load from the scene or the parameters is named in the result, because the duty cycle does not
show it."""

from collections.abc import Container, Iterable, Mapping
from typing import Any

from ..differential import Differential
from ..drive_port import PARAMETERS, PORT, SPEED, TORQUE, port_command
from ..fmu import Fmu
from ..values import DifferentialError
from .damage import Event

# parameters for the drive of each shaft
DRIVES = ("scene.carrier_drive", "scene.left_drive", "scene.right_drive")
# load of each torque-driven shaft, and speed of each speed-driven shaft; with a final drive, those of the carrier act at its port
LOADS = dict(zip(DRIVES, (TORQUE, "left.load_torque", "right.load_torque")))
SPEEDS = dict(zip(DRIVES, (SPEED, "left.speed_command", "right.speed_command")))
ALL_LOADS = {*LOADS.values(), PORT[TORQUE]}


def drives_of(values: Mapping[str, Any], usual: Mapping[str, Any], fmu: Fmu) -> dict[str, Any]:
    """Literals of `DRIVES` and numbers of `drive_port.PARAMETERS` for an event with these `values`, by name; `usual`: values that it does
    not set."""
    numbers = {name: fmu.variable(name).number(values.get(name, usual[name])) for name in (*DRIVES, *PARAMETERS)}
    return numbers | {name: fmu.variable(name).written(numbers[name]) for name in DRIVES}


def needed(drives: Mapping[str, Any]) -> dict[str, str]:
    """Commands that take effect with these `drives`, and the column of a duty cycle from which each follows."""
    by_speed = [name for name in DRIVES[1:] if drives[name] == "speed"]
    found = {LOADS[name]: "torque" for name in DRIVES if drives[name] == "torque"}
    # with two speed-driven sides the carrier's speed follows from both
    speed_driven = [name for name in DRIVES if drives[name] == "speed" and (name in by_speed or len(by_speed) < 2)]
    found |= {SPEEDS[name]: "speed" for name in speed_driven}
    return {port_command(drives.__getitem__, command): column for command, column in found.items()}


def missing(values: Container[str], drives: Mapping[str, Any], given: Container[str]) -> dict[str, str]:
    """Commands in `needed` that are neither in `values` of an event nor `given` for all events."""
    return {command: column for command, column in needed(drives).items() if command not in values and command not in given}


def wanted(command: str) -> str:
    """Advice on a missing command."""
    what = "a load" if command in ALL_LOADS else "a speed"
    return f"write a value, or set {command} in the scene or by --set; {what} that nobody gives is not taken from the start values"


def check_commands(event: Event, drives: Mapping[str, Any], given: Container[str]) -> None:
    """Refuses an event that lacks a command."""
    for command in missing({*event.values, *event.signals}, drives, given):
        raise DifferentialError(f"{command}: event {event.name!r} does not give it; {wanted(command)}")


def open_loads(events: Iterable[Event], usual: Mapping[str, Any], differential: Differential, sources: Mapping[str, str]) -> tuple[str, ...]:
    """Lines about loads that events take from elsewhere: value, source and names of the events."""
    fmu, found = differential.fmu, dict[str, list[str]]()
    events = list(events)
    for event in events:
        for command, column in missing({*event.values, *event.signals}, drives_of(event.values, usual, fmu), ()).items():
            if column == "torque":
                found.setdefault(command, []).append(event.name)
    lines = []
    for command, names in found.items():
        if len(names) == len(events):
            where = "all events"
        else:
            where = f"{len(names)} {'event' if len(names) == 1 else 'events'} ({', '.join(names)})"
        lines.append(f"load not in the duty cycle: {command} = {float(differential.values[command]):g} N·m from {sources[command]}, in {where}")
    return tuple(lines)
