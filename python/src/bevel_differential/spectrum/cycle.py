"""Duty cycle from a CSV file: a line for each event.

Speed, torque and turn of the vehicle determine the inputs of the differential. With a speed-driven carrier and torque-driven sides:

```text
carrier.speed_command = v/r                      v speed, r radius of the wheels
ω_left − ω_right      = −(v/r) w/R               w track, R radius of the turn, positive to the left
spin.command   = (ω_left − ω_right)/2 · z_side/z_planet
load torques          = T/2 on each side         T torque of the ring gear; an open differential halves it
```

A torque-driven carrier has the command T and starts at v/r. Speed-driven sides have the speeds v/r ± (ω_left − ω_right)/2, and the
planets' spin is free. With a final drive, speed and torque of the carrier become those of its port, times i and over i.

In a turn to the left, the left wheel is the inner one, on the radius R − w/2. No wheel slips (Ackermann). The torque is positive if
the engine drives forward, the speed is positive if the vehicle goes forward."""

from collections.abc import Container, Mapping
from math import nan, pi
from typing import Any

import numpy as np

from ..csv_table import CsvTable, Text
from ..drive_port import SPEED, TORQUE, drive_ratio, port_command, port_value
from ..fmu import Fmu
from ..values import DifferentialError, FileName, Quantity, Variable, suggestion
from .damage import Event
from .driven import ALL_LOADS, drives_of, missing, wanted

# quantities of the vehicle, with their SI units
QUANTITIES = {name: Quantity(name, unit) for name, unit in {
    "speed": "m/s", "torque": "N.m", "turn_radius": "m", "speed_difference": "rad/s", "wheel_radius": "m", "tyre_circumference": "m",
    "track": "m"}.items()}
SPIN = "scene.planet_spin"
# sign of half the speed difference on each side
SIDES = {"left": 1.0, "right": -1.0}
_COLUMNS: list[Quantity | Text] = [
    Text("name"), Text("history"), Quantity("count", "1"), Quantity("duration", "s"), Quantity("distance", "m")]
OWN = {column.name: column for column in _COLUMNS}
# prefixes of parameters that cannot be columns, because the gears are the same in all events
WHOLE = ("geometry.", "strength.", "material.", "effects.strength")
# quantities for the turn of the vehicle; an event has at most one of them
TURNS = {"turn_radius", "speed_difference"}
# longest and shortest communication step [s]
LONGEST, SHORTEST = 0.01, 1e-4


def read_cycle(file: FileName, fmu: Fmu, vehicle: Mapping[str, float], teeth: tuple[int, int],
               drives: Mapping[str, Any], given: Container[str] = ()) -> list[Event]:
    """Events of the duty cycle in `file`. `vehicle`: quantities for all events, {name: number}, SI; `teeth` of planet and side gear;
    `drives`: values for `driven.drives_of` that events do not set; `given`: names of variables that the scene or the parameters
    set. Raises `DifferentialError` with file, line, column and value."""
    def known(name: str) -> Variable | Text:
        return OWN.get(name) or _variable(name, fmu, ("input", "parameter"), OWN)

    table = CsvTable(file, known, ["name", "count"], [name for name, column in OWN.items() if isinstance(column, Text)])
    return [_event(table, line, row, fmu, vehicle, (teeth, drives_of(row, drives, fmu)), given) for line, row in table.rows]


def _event(table, line, row, fmu, vehicle, gears, given):
    for name in ("name", "count"):
        if name not in row:
            raise table.problem_at(line, name, "write a value", "")
    if row["count"] < 0.0:
        raise table.problem_at(line, "count", "an event occurs 0 times or more", f"{row['count']:g}")
    history = _history(table, line, row, fmu) if "history" in row else {}
    known = {**vehicle, **{name: value for name, value in row.items() if name in QUANTITIES}, **history}
    if TURNS & table.columns.keys() and not TURNS & known.keys() and "spin.command" not in row:
        # empty cells mean straight ahead, even if the scene imposes a spin
        known["speed_difference"] = 0.0
    try:
        driven = _driven(known, {**row, **history}, gears)
        duration, distance = _length(table, line, row, known, gears[1])
    except DifferentialError as failure:
        if str(failure).startswith(str(table.file)):
            raise
        raise table.problem(line, text=str(failure)) from None
    known_elsewhere = {*OWN, *QUANTITIES, *row, *driven}
    blank = [name for name in table.columns if name not in known_elsewhere and name not in ALL_LOADS]
    if blank:
        raise table.problem_at(line, blank[0], "write a value", "")
    for command, column in missing(driven, gears[1], given).items():
        if command in table.columns or column in table.columns:
            raise table.problem_at(line, command if command in table.columns else column, wanted(command), "")
        raise table.problem(line, text=f"{column}: there is no such column; {wanted(command)}")
    values = {name: value for name, value in driven.items() if np.ndim(value) == 0}
    signals = {name: (history["time"], value) for name, value in driven.items() if np.ndim(value) == 1}
    return Event(row["name"], row["count"], duration, distance, values, signals, _step(history))


def _step(history):
    """Communication step [s]: the shortest interval of the history, within limits; the longest step without a history."""
    gaps = np.diff(history.get("time", ()))
    return float(np.clip(np.min(gaps[gaps > 0.0], initial=LONGEST), SHORTEST, LONGEST))


def _driven(vehicle, given, gears):
    """Values of the FMU that are `given`, and values that follow from the quantities of the vehicle."""
    values = {name: value for name, value in given.items() if name not in OWN and name not in QUANTITIES and name != "time"}
    for name, value in inputs_of(vehicle, *gears).items():
        if name in values:
            raise DifferentialError(f"{name}: it also follows from speed, torque or turn of the vehicle; remove one of both")
        values[name] = value
    return values


def _length(table, line, row, known, drives):
    """Duration [s] and distance [m] of one occurrence."""
    for name in ("duration", "distance"):
        if name in row and row[name] <= 0.0:
            raise table.problem_at(line, name, "it must be more than 0, or empty", f"{row[name]:g}")
    speed = np.abs(_speed(known, row, drives))
    if "time" in known:
        if "duration" in row:
            raise table.problem_at(line, "duration", "leave it empty: the history has its own", f"{row['duration']:g}")
        times = known["time"]
        return float(times[-1]), row.get("distance", float(np.trapezoid(np.broadcast_to(speed, times.shape), times)))
    if "duration" in row:
        return row["duration"], row.get("distance", float(speed * row["duration"]))
    if "distance" not in row:
        raise table.problem(line, text="an event needs a duration, or a distance and a speed; fill in one of these columns")
    if not speed > 0.0:
        text = "it needs a speed other than 0; fill in speed, or duration"
        raise table.problem_at(line, "distance", text, f"{row['distance']:g}")
    return float(row["distance"] / speed), row["distance"]


def _speed(known, row, drives):
    """Speed of the vehicle [m/s], NaN if not known."""
    command = port_command(drives.__getitem__, SPEED)
    port = known.get(command, row.get(command))
    if "speed" in known or port is None or not known.keys() & {"wheel_radius", "tyre_circumference"}:
        return known.get("speed", nan)
    return port / drive_ratio(drives.__getitem__) * wheel_radius(known, "distance")


def _history(table, line, row, fmu):
    """Columns of a time history by name, SI, arrays of shape (points,); "time" starts at 0."""
    file = table.file.parent / row["history"]

    def known(name):
        return Quantity(name, "s") if name == "time" else _variable(name, fmu, ("input",), ["time"])

    found = CsvTable(file, known, needed=["time"])
    for at, values in found.rows:
        for name in found.columns:
            if name not in values:
                raise found.problem_at(at, name, "write a value", "")
    times = np.array([values["time"] for _, values in found.rows])
    falls = np.nonzero(np.diff(times) < 0.0)[0]
    if len(falls):
        raise found.problem_at(found.rows[falls[0] + 1][0], "time", "times must not fall", f"{times[falls[0] + 1]:g}")
    if len(times) < 2 or times[-1] == times[0]:
        raise DifferentialError(f"{found.file}: a time history needs two times or more")
    columns = {name: np.array([values[name] for _, values in found.rows]) for name in found.columns}
    return {**columns, "time": times - times[0]}


def _variable(name, fmu, causalities, own):
    if name in QUANTITIES:
        return QUANTITIES[name]
    if name not in fmu.variables:
        settable = [each.name for each in fmu.variables.values() if each.causality in causalities]
        raise DifferentialError(f"{name}: there is no such column{suggestion(name, [*OWN, *QUANTITIES, *settable])}; columns are "
                                f"{', '.join(dict.fromkeys([*own, *QUANTITIES]))}, and each {' or '.join(causalities)} of the FMU")
    variable = fmu.variables[name]
    if variable.causality not in causalities:
        raise DifferentialError(f"{name}: it is not an {' or '.join(causalities)} of the FMU")
    if name.startswith(WHOLE):
        raise DifferentialError(f"{name}: it is the same in the whole cycle; give it as a parameter, not as a column")
    return variable


def inputs_of(vehicle: Mapping[str, float | np.ndarray], teeth: tuple[int, int],
              drives: Mapping[str, Any]) -> dict[str, float | str | np.ndarray]:
    """Inputs and parameters of the FMU in SI. `vehicle`: quantities in SI, {name: number or array of shape (points,)}; `teeth`:
    numbers of teeth of planet and side gear; `drives`: see `driven.drives_of`. Raises `DifferentialError` if a quantity is missing."""
    found: dict[str, float | str | np.ndarray] = {}
    by_speed = [side for side in SIDES if drives[f"scene.{side}_drive"] == "speed"]
    if "torque" in vehicle:
        found.update({f"{side}.load_torque": vehicle["torque"] / 2.0 for side in SIDES if side not in by_speed})
        if drives["scene.carrier_drive"] == "torque":
            found[TORQUE] = vehicle["torque"]
    speed = vehicle["speed"] / wheel_radius(vehicle, "speed") if "speed" in vehicle else None
    # with two speed-driven sides the carrier's speed follows from both
    if speed is not None and len(by_speed) < len(SIDES):
        # a torque-driven carrier only starts at this speed
        found[SPEED] = speed if drives["scene.carrier_drive"] == "speed" else np.ravel(speed)[0].item()
    difference = _difference(vehicle)
    if by_speed and speed is not None:
        found.update({f"{side}.speed_command": speed + 0.5 * SIDES[side] * (0.0 if difference is None else difference)
                      for side in by_speed})
    elif by_speed and difference is not None and np.any(difference):
        raise DifferentialError(f"speed_difference: it needs speed where scene.{by_speed[0]}_drive = speed; give it as a column or "
                                "a parameter")
    elif difference is not None and not by_speed:
        found["spin.command"] = difference / 2.0 * teeth[1] / teeth[0]
        found[SPIN] = "imposed"
    port = drives.__getitem__
    return {port_command(port, name): port_value(port, name, value) for name, value in found.items()}


def wheel_radius(vehicle: Mapping[str, float | np.ndarray], needed_by: str) -> float | np.ndarray:
    """Radius of the wheels [m], either given or from the circumference of the tyres."""
    if "wheel_radius" not in vehicle and "tyre_circumference" not in vehicle:
        raise DifferentialError(f"{needed_by}: it needs wheel_radius or tyre_circumference; give one as a column or a parameter")
    if "wheel_radius" in vehicle:
        return _positive(vehicle, "wheel_radius")
    return _positive(vehicle, "tyre_circumference") / (2.0 * pi)


def _difference(vehicle):
    """Speed of the left side gear minus that of the right one [rad/s], or None if not given."""
    if "turn_radius" in vehicle and "speed_difference" in vehicle:
        raise DifferentialError("turn_radius: speed_difference gives the same turn; leave one of them empty")
    if "speed_difference" in vehicle:
        return vehicle["speed_difference"]
    if "turn_radius" not in vehicle:
        return None
    for name in ("speed", "track"):
        if name not in vehicle:
            raise DifferentialError(f"turn_radius: it needs {name}; give it as a column or a parameter")
    if not np.all(np.abs(vehicle["turn_radius"]) > _positive(vehicle, "track") / 2.0):
        raise DifferentialError("turn_radius: it must be more than half the track, of either sign; leave it empty straight ahead")
    return -vehicle["speed"] / wheel_radius(vehicle, "speed") * vehicle["track"] / vehicle["turn_radius"]


def _positive(vehicle, name):
    if not np.all(np.asarray(vehicle[name]) > 0.0):
        raise DifferentialError(f"{name}: it must be more than 0 m")
    return vehicle[name]
