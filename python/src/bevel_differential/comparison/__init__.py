"""Compares several scenes: their outputs over the same time, the differences, and the values in which the scenes differ."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..extras import matplotlib
from ..fmu import Fmu
from ..points import TimeValue, duration
from ..records import write
from ..scene import Scene
from ..scene_file import find
from ..text import aligned
from ..values import DifferentialError, FileName, Value
from ..want import mean_over_time
from ..warned import warn
from .differing import differing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# statistics of a series: its mean over time, its value farthest from 0, its value at the end
FIGURES = ("mean", "peak", "end")
# a value below this fraction of the largest one is 0 except for rounding, so percentages of it make no sense
NOTHING = 1e-9
# smaller percentages are not printed as numbers
LEAST = 1e-3


@dataclass(frozen=True)
class Comparison:
    """Records of several scenes over the same time; the others are compared with the first one.

    `scenes`: scenes by unique names; `records`: structured arrays in SI by these names, with a field "time" and a field for each
    output; `end`: end of the time that all scenes have, s; `notes`: sentences about durations and outputs; `differing`: head and rows
    of the values in which the scenes differ. `fmu` shows values in the preferred units."""

    scenes: Mapping[str, Scene]
    records: Mapping[str, np.ndarray]
    end: float
    notes: tuple[str, ...]
    differing: list[tuple[str, ...]]
    fmu: Fmu

    @property
    def names(self) -> list[str]:
        """Names of the scenes."""
        return list(self.scenes)

    @property
    def outputs(self) -> list[str]:
        """Names of the outputs."""
        return list(next(iter(self.records.values())).dtype.names or ())[1:]

    def shown(self, output: str) -> tuple[str, dict[str, np.ndarray]]:
        """Unit of an output, and its values in this unit by scene."""
        variable = self.fmu.variable(output)
        unit, _ = variable.shown(0.0)
        return unit, {name: variable.shown(record[output].astype(float))[1] for name, record in self.records.items()}

    def table(self) -> np.ndarray:
        """A row for each output and figure (mean, peak, end), in display units: a structured array that pandas can read.


        Fields: output, unit, figure, one for each scene, then for each other scene "NAME - FIRST" and "NAME - FIRST, %". A percentage
        that makes no sense is NaN. The peak is the value farthest from 0."""
        first, *others = self.names
        rows = []
        for output in self.outputs:
            unit, _ = self.shown(output)
            figures = {name: self._figures(output, name) for name in self.names}
            largest = max(float(np.max(np.abs(record[output].astype(float)))) for record in self.records.values())
            for index, figure in enumerate(FIGURES):
                values = {name: figures[name][index] for name in self.names}
                differences = [part for name in others for part in self._difference(output, values[first], values[name], largest)]
                shown = [float(self.fmu.variable(output).shown(value)[1]) for value in values.values()]
                rows.append((output, unit, figure, *shown, *differences))
        widths = (max(1, *(len(str(row[index])) for row in rows)) for index in range(3))
        fields = [(name, f"U{width}") for name, width in zip(("output", "unit", "figure"), widths)]
        fields += [(name, "f8") for name in self.names]
        fields += [(f"{name} - {first}{end}", "f8") for name in others for end in ("", ", %")]
        return np.array(rows, fields)

    def _figures(self, output, name):
        """Mean, peak and end of an output in a scene, SI."""
        record = self.records[name]
        values, time = record[output].astype(float), record["time"]
        return mean_over_time(values, time), float(values[np.argmax(np.abs(values))]), float(values[-1])

    def _difference(self, output, first, other, largest):
        """Difference of two values in SI: in the display unit, and in per cent of the first value."""
        variable = self.fmu.variable(output)
        shown = float(variable.differences().shown(other - first)[1])
        # a percentage of a temperature in degC would depend on the zero of the scale
        sensible = abs(first) > NOTHING * largest and float(variable.shown(0.0)[1]) == 0.0
        return shown, 100.0 * (other - first) / abs(first) if sensible else np.nan

    def __str__(self) -> str:
        """The notes, the table of differences, and the values in which the scenes differ."""
        return "\n".join([*self.notes, "", *self._lines(), "", *self._differing_lines()])

    def _lines(self):
        first, *others = self.names
        # two scenes have only one difference, which needs no names
        heads = ["difference", "in %"] if len(others) == 1 else [part for name in others for part in (f"{name} − {first}", "in %")]
        lines: list[tuple[str, ...]] = [("output", "unit", "figure", *self.names, *heads)]
        for row in self.table().tolist():
            output, unit, figure, *numbers = row
            count = len(self.names)
            size = max(map(abs, numbers[:count]))
            # small remainders of large numbers are rounding errors
            values, differences = ([0.0 if abs(value) < NOTHING * size else value for value in part]
                                   for part in (numbers[:count], numbers[count::2]))
            pairs = [text for difference, part in zip(differences, numbers[count + 1::2])
                     for text in (f"{difference:+.4g}" if difference else "0", _percent(difference, part))]
            heading = (output, unit) if figure == FIGURES[0] else ("", "")
            lines.append((*heading, figure, *(f"{value:.6g}" for value in values), *pairs))
        return [*aligned(lines, 3), f"mean over time; peak: the value farthest from 0; end: at {self.end:g} s"]

    def _differing_lines(self):
        if len(self.differing) == 1:
            return ["The scenes set the same values: they differ only by rounding."]
        return ["The scenes differ in:", *aligned(self.differing, 1 + len(self.names))]

    def plot(self, file: FileName | None = None) -> "Figure":
        """Draws the curves of all scenes, in a panel for each output. If `file` is given, it is written as PNG, SVG or PDF."""
        matplotlib("plot")
        from .picture import draw

        return draw(self, file)

    def to_csv(self, file: FileName) -> Path:
        """Writes all records below each other, as CSV or Parquet by the file's ending. The columns are "scene" and those of
        `Scene.to_csv`, in the units of this comparison."""
        rows: list[tuple[Any, ...]] = []
        for name, scene in self.scenes.items():
            head, _, columns = scene.columns(self.records[name], list(self.fmu.display_units.values()))
            rows += zip([name] * len(columns[0]), *(column.tolist() for column in columns))
        return write(file, ("scene", *head), rows, f"scenes {', '.join(self.names)}")


def _percent(difference: float, part: float) -> str:
    """Short text of a percentage."""
    if np.isnan(part):
        return "–"
    if difference == 0.0:
        return "0"
    return f"{part:+.3g}" if abs(part) >= LEAST else f"< {LEAST:g}"


def compare(*scenes: FileName | Scene, outputs: Sequence[str] | None = None, values: Mapping[str, Value] | None = None,
            stop: TimeValue | None = None, display_units: Sequence[str] = (), fmu: FileName | Fmu | None = None) -> Comparison:
    """Runs two or more scenes over the same time and compares their outputs.

    `scenes`: files, names of shipped scenes, or `Scene`s. `outputs`: by default those that all scenes record. `values`: changes of
    all scenes. `stop`: end of all runs, by default that of the shortest scene. `display_units` take precedence over the units of the
    scenes, and the first scene takes precedence over the others. Warnings name their scene. Raises `DifferentialError`."""
    if len(scenes) < 2:
        raise DifferentialError("a comparison needs two scenes or more", kind="use")
    files = [None if isinstance(scene, Scene) else find(scene) for scene in scenes]
    opened = [scene if isinstance(scene, Scene) else Scene.load(scene, fmu) for scene in scenes]
    named = dict(zip(_names(opened, files), opened))
    outputs, notes = _common(named, outputs)
    end = min(scene.stop for scene in opened) if stop is None else duration("stop", stop)
    records = {}
    for (name, scene), file in zip(named.items(), files):
        try:
            records[name] = scene._record(outputs, values, end)
            warn(f"{name}: {text}" for text in (*scene.warnings, *scene.off_outputs(outputs, values).texts))
        except DifferentialError as error:
            raise DifferentialError(f"{name}: {error}", error.status, error.kind, error.problems) from None
        finally:
            if file is not None:
                scene.close()
    shown = opened[0].fmu
    for preferred in [*(list(scene.fmu.display_units.values()) for scene in reversed(opened)), display_units]:
        shown = shown.displaying(preferred)
    lengths = ""
    if stop is None and len({scene.stop for scene in opened}) > 1:
        lengths = f", the time that all scenes have: {', '.join(f'{name} ends at {scene.stop:g} s' for name, scene in named.items())}"
    notes = (f"compared from 0 to {end:g} s{lengths}", *notes)
    return Comparison(named, records, end, notes, differing(named, values or {}, shown), shown)


def _names(scenes: Sequence[Scene], files: Sequence[Path | None]) -> list[str]:
    """Unique names of the scenes. Files with the same name get as many folders as needed; other scenes get a number."""
    paths = [None if file is None else file.resolve().with_suffix("").parts for file in files]
    names = [scene.name for scene in scenes]
    for index, path in enumerate(paths):
        alike = [other for k, other in enumerate(paths) if k != index and other is not None and scenes[k].name == scenes[index].name]
        if path is None or not alike:
            continue
        if path in alike:
            raise DifferentialError(f"{names[index]}: it is named twice; name different scenes", kind="use")
        depth = next(depth for depth in range(1, len(path) + 1) if all(path[-depth:] != other[-depth:] for other in alike))
        names[index] = "/".join(path[-depth:])
    return [f"{name} ({names[:k].count(name) + 1})" if names.count(name) > 1 else name for k, name in enumerate(names)]


def _common(scenes: Mapping[str, Scene], outputs: Sequence[str] | None) -> tuple[list[str], tuple[str, ...]]:
    """Outputs to compare, and a note about the outputs that are left out."""
    if outputs is not None:
        return list(outputs), ()
    recorded = [scene.outputs for scene in scenes.values()]
    common = [name for name in recorded[0] if all(name in others for others in recorded[1:])]
    if not common:
        raise DifferentialError(f"no output is recorded by all of {', '.join(scenes)}: name outputs, such as left.speed (--output)", kind="use")
    rest = [name for name in dict.fromkeys(name for names in recorded for name in names) if name not in common]
    return common, ((f"not recorded by all scenes, and left out (--output names others): {', '.join(rest)}",) if rest else ())
