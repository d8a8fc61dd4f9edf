"""A duty cycle from a CSV file: a line for each event."""

from math import nan

import numpy as np

from ..values import DifferentialError, Variable
from .columns import Quantity, Table, Text, unknown
from .event import Event
from .vehicle import LENGTH, QUANTITIES, inputs_of, wheel_radius

TIME = {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0}
OWN = {column.name: column for column in [
    Text("name"), Text("history"), Quantity("count", {"1": 1.0}), Quantity("duration", TIME), Quantity("distance", LENGTH)]}
# they hold for the whole cycle: gears do not change from event to event
WHOLE = ("geometry.", "strength.", "material.", "effects.strength", "scene.gear_contact", "scene.planets")
# steps of a time history: the longest, and the shortest [s]
LONGEST, SHORTEST = 0.01, 1e-4


def read_cycle(file, fmu, vehicle, teeth):
    """The events of the duty cycle in `file`, a list of `Event`. `vehicle`: quantities that hold for all events, {name: number, SI};
    `teeth` of planet and side gear. Raises `DifferentialError` with file, line, column and value."""
    table = Table(file, lambda name: OWN.get(name) or _variable(name, fmu, causalities=("input", "parameter")))
    if "name" not in table.columns or "count" not in table.columns:
        raise DifferentialError(f"{table.file}: the header needs the columns name and count")
    return [_event(table, line, row, fmu, vehicle, teeth) for line, row in table.rows]


def _event(table, line, row, fmu, vehicle, teeth):
    for name in ("name", "count"):
        if name not in row:
            raise table.problem_at(line, name, "write a value", "")
    if row["count"] < 0.0:
        raise table.problem_at(line, "count", "an event occurs 0 times or more", f"{row['count']:g}")
    history = _history(table, line, row, fmu) if "history" in row else {}
    own = {name: value for name, value in row.items() if name in QUANTITIES}
    try:
        known = {**vehicle, **own}
        values = _driven(known, row, teeth)
        signals = _driven({**known, **history}, history, teeth) if history else {}
        if history:
            # what does not change, and no input, as the way the planets are driven
            values.update({name: value for name, value in signals.items() if np.ndim(value) == 0})
            signals = {name: (history["time"], value) for name, value in signals.items() if np.ndim(value) == 1}
        duration, distance = _length(table, line, row, known, history)
        step = float(np.clip(np.diff(history["time"])[np.diff(history["time"]) > 0.0].min(), SHORTEST, LONGEST)) if history else LONGEST
        missing = [name for name in table.columns if name not in row and name not in OWN and name not in QUANTITIES
                   and name not in signals]
        if missing:
            raise table.problem_at(line, missing[0], "write a value", "")
        return Event(row["name"], row["count"], duration, distance, values, signals, step)
    except DifferentialError as failure:
        if str(failure).startswith(str(table.file)):
            raise
        raise table.problem(line, text=str(failure)) from None


def _driven(vehicle, given, teeth):
    """Values of the FMU that are `given`, and those that follow from the quantities of the vehicle."""
    values = {name: value for name, value in given.items() if name not in OWN and name not in QUANTITIES and name != "time"}
    for name, value in inputs_of(vehicle, teeth).items():
        if name in values:
            raise DifferentialError(f"{name}: speed, torque or turn of the vehicle give it as well; remove one of both")
        values[name] = value
    return values


def _length(table, line, row, vehicle, history):
    """Duration [s] and distance [m] of one occurrence."""
    speed = np.abs({**vehicle, **history}.get("speed", nan))
    if history:
        if "duration" in row:
            raise table.problem_at(line, "duration", "leave it empty: the history has its own", f"{row['duration']:g}")
        return float(history["time"][-1]), row.get("distance", float(np.trapezoid(speed * np.ones_like(history["time"]), history["time"])))
    if "distance" in row and row["distance"] <= 0.0:
        raise table.problem_at(line, "distance", "it must be more than 0, or empty", f"{row['distance']:g}")
    if "duration" in row:
        if row["duration"] <= 0.0:
            raise table.problem_at(line, "duration", "it must be more than 0", f"{row['duration']:g}")
        if np.isnan(speed) and "carrier.speed_command" in row and ("wheel_radius" in vehicle or "tyre_circumference" in vehicle):
            speed = abs(row["carrier.speed_command"]) * wheel_radius(vehicle, "distance")
        return row["duration"], row.get("distance", float(speed * row["duration"]))
    if "distance" not in row:
        raise table.problem(line, text="an event needs a duration, or a distance and a speed; fill in one of these columns")
    if not speed > 0.0:
        raise table.problem_at(line, "distance", "it needs a speed; fill in speed, or duration", f"{row['distance']:g}")
    return float(row["distance"] / speed), row["distance"]


def _history(table, line, row, fmu):
    """Columns of a time history by name, SI, arrays of shape (points,); "time" begins at 0."""
    time = Quantity("time", TIME)
    file = table.file.parent / row["history"]
    found = Table(file, lambda name: time if name == "time" else _variable(name, fmu, causalities=("input",)))
    if "time" not in found.columns:
        raise DifferentialError(f"{found.file}: the header needs the column time")
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


def _variable(name, fmu, causalities) -> Variable:
    if name in QUANTITIES:
        return QUANTITIES[name]
    if name not in fmu.variables:
        raise unknown(name, [*OWN, *QUANTITIES, *fmu.variables])
    variable = fmu.variables[name]
    if variable.causality not in causalities:
        raise DifferentialError(f"{name}: it is none of the {' and '.join(each + 's' for each in causalities)} of the FMU")
    if name.startswith(WHOLE):
        raise DifferentialError(f"{name}: it holds for the whole cycle; give it as a parameter, not as a column")
    return variable
