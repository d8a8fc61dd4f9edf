"""Map of losses for users: torques, loss and efficiency at any point within its axes, also from a file."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..csv_table import lines_of
from ..extras import require
from ..output_file import is_parquet
from ..values import DifferentialError, FileName
from .grid import efficiency, figures_of, grid_points, interpolated, torques_of

# number of figures of a slipping point in the map: torques left and right, loss
MAPPED = 3
SIGNS = (1.0, -1.0)
# columns of the file: kind of a row, axes and figures, followed by derived columns
KIND = "kind"
AXES = ("carrier.torque", "carrier.speed", "speed_difference", "oil.temperature")
AXIS_UNITS = ("N.m", "rad/s", "rad/s", "K")
FIGURES = ("left.shaft_torque", "right.shaft_torque", "power.loss", "left.shaft_torque_min", "left.shaft_torque_max")
# kind of the rows that measured the error
UNSEEN = "unseen"
# names of the axes in errors; index of the axis whose two signs share lines
NAMES, DIFFERENCE = ("torque", "speed", "difference", "temperature"), 2
# a point may be outside the end of an axis by this fraction of the value at the end
ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class LossMap:
    """Map of power loss and wheel torques over carrier torque, carrier speed, difference of wheel speeds and oil temperature, in SI.

    `LossMap.load(file)` reads a file of the command `losses --csv`. Between its lines the map interpolates as `losses` does when it
    measures the error.

    `lines`: values of torque, speed, magnitude of the difference of speeds, and temperature. `slipping`: FIGURES with the left wheel
    faster and with the right wheel faster, shape (2, lines of each axis, figures). `stuck`: FIGURES without a difference, so that the
    third axis has length 1; the last two figures are the left torques at which the differential breaks loose. `error`: a sentence
    about the measured error."""

    lines: tuple[np.ndarray, ...]
    slipping: np.ndarray
    stuck: np.ndarray
    error: str

    @classmethod
    def load(cls, file: FileName) -> "LossMap":
        """Reads a map from a file of the command `losses --csv`, CSV or Parquet. Raises `DifferentialError` for other files."""
        file = Path(file)
        columns = _from_parquet(file) if is_parquet(file) else _from_csv(file)
        kinds, points, figures = columns[KIND], *(np.stack([columns[name] for name in names], axis=-1) for names in (AXES, FIGURES))
        slips = kinds == "map"
        lines = tuple(map(np.unique, _unsigned(points[slips]).T))
        slipping = [_filled(file, lines, _unsigned(points[at]), figures[at])
                    for sign in SIGNS for at in [slips & (sign * points[:, DIFFERENCE] > 0.0)]]
        still = kinds == "stuck"
        stuck = _filled(file, _still(lines), points[still], figures[still])
        found = LossMap(lines=lines, slipping=np.stack(slipping), stuck=stuck, error="")
        measured = kinds == UNSEEN
        return replace(found, error=_measured(np.abs(found.at(points[measured]) - figures[measured, :MAPPED])))

    def torques(self, torque: Any, speed: Any, difference: Any, temperature: Any) -> tuple[Any, Any]:
        """Torques of the left and the right half-shaft [N·m].

        `torque` [N·m] and `speed` [rad/s] of the carrier, `difference` [rad/s] of the wheel speeds, left less right, and `temperature`
        of the oil [K] are numbers or arrays that numpy broadcasts; arrays give arrays. Raises `DifferentialError` outside the map."""
        _, figures = self._figures(torque, speed, difference, temperature)
        return figures[..., 0][()], figures[..., 1][()]

    def loss(self, torque: Any, speed: Any, difference: Any, temperature: Any) -> Any:
        """Power loss [W]; arguments as for `torques`."""
        return self._figures(torque, speed, difference, temperature)[1][..., 2][()]

    def efficiency(self, torque: Any, speed: Any, difference: Any, temperature: Any) -> Any:
        """Output power over input power, from 0 to 1; arguments as for `torques`."""
        return efficiency(*self._figures(torque, speed, difference, temperature))[()]

    def at(self, points: np.ndarray) -> np.ndarray:
        """Torques left and right and loss, shape (points, 3). `points`: torque, speed, signed difference and temperature."""
        points = self._within(np.array(points, float))
        unsigned = _unsigned(points)
        sheets = [(_still(self.lines), self.stuck, 0.0), *((self.lines, values, sign) for sign, values in zip(SIGNS, self.slipping))]
        torques = np.zeros((len(points), MAPPED))
        for lines, values, sign in sheets:
            here = np.sign(points[:, DIFFERENCE]) == sign
            if np.any(here):
                grid = torques_of(values[..., :MAPPED], grid_points(lines) * [1.0, 1.0, sign or 1.0, 1.0])
                torques[here] = interpolated(lines, grid, unsigned[here])
        return figures_of(torques, points)

    def _figures(self, *axes):
        """Points and the values of the map at them, both along the last axis."""
        try:
            points = np.stack(np.broadcast_arrays(*(np.asarray(axis, float) for axis in axes)), axis=-1)
        except ValueError as error:
            raise DifferentialError(f"torque, speed, difference and temperature are numbers in SI, or arrays of one shape: {error}") from None
        return points, self.at(points.reshape(-1, len(NAMES))).reshape(*points.shape[:-1], MAPPED)

    def _within(self, points):
        """Points within the map. Points that are outside only by rounding are moved to the end. Raises `DifferentialError` for others."""
        unsigned = _unsigned(points)
        for axis, (name, unit, line) in enumerate(zip(NAMES, AXIS_UNITS, self.lines)):
            near = np.clip(unsigned[:, axis], line[0], line[-1])
            beyond = ~(np.abs(unsigned[:, axis] - near) <= ROUNDING * np.abs(near))
            if axis == DIFFERENCE:
                stands = points[:, axis] == 0.0
                near, beyond = np.where(stands, 0.0, near * np.sign(points[:, axis])), beyond & ~stands
            if np.any(beyond):
                span = f"{line[0]:g} to {line[-1]:g} {unit}" if len(line) > 1 else f"only {line[0]:g} {unit}"
                span = f"0, and {span} in both directions" if axis == DIFFERENCE else span
                others = f" (and {np.sum(beyond) - 1} more)" if np.sum(beyond) > 1 else ""
                raise DifferentialError(f"{name} = {points[beyond, axis][0]:g} {unit} is outside the map{others}: it covers {span}; "
                                        f"measure a map with more by `losses --{name}`")
            points[:, axis] = near
        return points


def _measured(errors):
    """Sentence about the errors at the unseen points of a file, shape (points, 3)."""
    if not len(errors):
        return "no unseen points: the error of the map is not measured"
    left, right, loss = (f"{worst:.2g}" for worst in errors.max(axis=0))
    return f"{len(errors)} unseen points: the largest errors are {left} N.m at the left, {right} N.m at the right, and {loss} W"


def _unsigned(points):
    """Points with the magnitude of their difference."""
    found = points.copy()
    found[..., DIFFERENCE] = np.abs(found[..., DIFFERENCE])
    return found


def _still(lines):
    """Lines of the map at zero difference."""
    return (*lines[:DIFFERENCE], np.zeros(1), *lines[DIFFERENCE + 1:])


def _filled(file, lines, points, figures):
    """Figures at the positions of their points, shape (lines of each axis, figures)."""
    shape = tuple(map(len, lines))
    at = [np.minimum(np.searchsorted(line, points[:, axis]), len(line) - 1) for axis, line in enumerate(lines)]
    on_lines = all(np.array_equal(line[index], points[:, axis]) for axis, (line, index) in enumerate(zip(lines, at)))
    index = np.ravel_multi_index(at, shape)
    if not on_lines or not np.array_equal(np.sort(index), np.arange(np.prod(shape))):
        raise DifferentialError(f"{file}: it has {len(points)} rows for a grid of {' x '.join(map(str, shape))} points; rows of the map are "
                                "missing, changed or doubled: write it again by `losses --csv`")
    found = np.empty((len(points), figures.shape[-1]))
    found[index] = figures
    return found.reshape(*shape, -1)


def _from_parquet(file):
    parquet = require("pyarrow.parquet", "sweep")
    try:
        table = parquet.read_table(file)
    except (OSError, ValueError) as error:
        raise DifferentialError(f"{file}: it cannot be read ({error})") from None
    _need(file, table.column_names)
    rows = table.select([KIND, *AXES, *FIGURES]).to_pydict()
    return _columns(file, rows, range(1, table.num_rows + 1), "row")


def _from_csv(file):
    (_, head), *rows = lines_of(file, texts=[KIND])
    _need(file, head)
    cells = {name: [cells[head.index(name)] for _, cells in rows] for name in (KIND, *AXES, *FIGURES)}
    return _columns(file, cells, [line for line, _ in rows], "line")


def _need(file, names):
    missing = [name for name in (KIND, *AXES, *FIGURES) if name not in names]
    if missing:
        raise DifferentialError(f"{file}: it has no column {missing[0]}, so it is not a map; `losses --csv` writes one")


def _columns(file, cells, lines, what):
    """Columns of the rows, with numbers converted. Rows that measured the error lack some figures, which become NaN."""
    kept = [index for index, kind in enumerate(cells[KIND]) if kind in ("map", "stuck", UNSEEN)]
    blank = {index for index in kept if cells[KIND][index] == UNSEEN}
    found = {KIND: np.array([cells[KIND][index] for index in kept])}
    for name in (*AXES, *FIGURES):
        try:
            found[name] = np.array([_number(cells[name][index], index in blank) for index in kept], float)
        except (TypeError, ValueError):
            index = next(index for index in kept if not _is_number(cells[name][index]))
            raise DifferentialError(f"{file}, {what} {lines[index]}, column {name}, value \"{cells[name][index]}\": it is a number") from None
    if len(kept) == len(blank):
        raise DifferentialError(f"{file}: it has no rows of the kinds map and stuck; `losses --csv` writes them")
    return found


def _number(cell, may_be_blank):
    return np.nan if may_be_blank and cell in (None, "") else float(cell)


def _is_number(cell):
    try:
        float(cell)
    except (TypeError, ValueError):
        return False
    return True
