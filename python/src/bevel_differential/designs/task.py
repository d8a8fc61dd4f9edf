"""Task for each design: a run of the scene, reduced to the wanted figures."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Self

from ..instance import Closing
from ..off_outputs import OffInDesigns
from ..points import from_time
from ..scene import Scene
from ..values import DifferentialError, Number
from ..want import Condition, Want
from ..warned import warn
from .space import Dimension


@dataclass
class Row:
    """A design and its results.

    `figures`: by want, SI; empty if the design failed, and `message` and `kind` of the error then give the reason. If only some figures
    cannot be formed, the others are there, and `message` has the reason. `feasible`: true if all conditions are met. `seconds`: duration of the run, s. `warnings` of the FMU; None if the FMU did not
    run to the end."""

    run: int
    values: dict[str, Number]
    figures: dict[str, float] = field(default_factory=dict)
    feasible: bool = False
    message: str = ""
    seconds: float = 0.0
    warnings: tuple[str, ...] | None = None
    kind: str = "failed"

    def filled(self, fill: Callable[[Self], None]) -> Self:
        """The row after `fill(row)`, with its duration. A failure is noted in the row."""
        begun = time.perf_counter()
        try:
            fill(self)
        except DifferentialError as error:
            self.message, self.kind = str(error), error.kind
        self.seconds = time.perf_counter() - begun
        return self


class Task(Closing):
    """Scene with the figures and conditions of its designs. It can be sent to other processes.

    `wants` and `conditions` are text ("left.speed:mean", "safety.root_min >= 1.2") or parsed. Figures count from
    `start` (s) on. `figures` are those of wants and conditions, in this order. If all of them are final values, the scene takes
    one long step."""

    def __init__(self, scene: Scene, wants: Sequence[str | Want], conditions: Sequence[str | Condition] = (),
                 start: float = 0.0):
        self.scene, self.start = scene, start
        fmu = scene.fmu
        self.wants = [want if isinstance(want, Want) else Want.parse(fmu, want) for want in wants]
        self.conditions = [one if isinstance(one, Condition) else Condition.parse(fmu, one) for one in conditions]
        self.figures = list(dict.fromkeys([*self.wants, *(condition.want for condition in self.conditions)]))
        # reasons for figures of the last run that cannot be formed
        self.undefined: list[str] = []
        # outputs of conditions that some designs do not compute, see `check_computed`
        self.unsure: list[str] = []
        if not self.figures:
            raise DifferentialError("nothing is wanted: name an output and a statistic, such as left.speed:mean")
        if not 0.0 <= start <= scene.stop:
            raise DifferentialError(f"from = {start:g} s is outside the scene's 0 to {scene.stop:g} s")
        # fewer than two points have no mean and no peak-to-peak value
        if not self._only_final() and scene.stop - start < 2.0 * scene.step * (1.0 - 1e-9):
            raise DifferentialError(f"from = {start:g} s leaves less than two steps of {scene.step:g} s to the end at "
                                    f"{scene.stop:g} s; start earlier, or use a smaller step in the scene")

    def check_computed(self, dimensions: Iterable[Dimension]) -> None:
        """Refuses conditions on outputs that no effect computes in any design, and warns of such wants. A design fails if it does not
        compute the output of a condition."""
        all_values, dimensions = self.scene.all_values(), list(dimensions)
        limited = OffInDesigns.of(self.scene.fmu, [one.want.name for one in self.conditions], all_values, dimensions)
        if limited.always.texts:
            raise DifferentialError("\n".join(f"condition: {text}" for text in limited.always.texts))
        self.unsure = list(limited.sometimes.names)
        warn(OffInDesigns.of(self.scene.fmu, [want.name for want in self.wants], all_values, dimensions).sometimes.texts)

    def evaluate(self, run: int, values: Mapping[str, Number]) -> Row:
        """Evaluates a design. A failed run also returns a row."""
        return Row(run, dict(values)).filled(self._fill)

    def close(self) -> None:
        """Frees the scene's instances."""
        self.scene.close()

    def _fill(self, row):
        if off := self.unsure and self.scene.off_outputs(self.unsure, row.values).texts:
            raise DifferentialError(f"condition: {off[0]}")
        row.figures, row.warnings = self._figures(row.values), tuple(self.scene.warnings)
        row.message = "; ".join(self.undefined)
        row.feasible = bool(row.figures) and all(str(one.want) in row.figures and one.holds(row.figures[str(one.want)])
                                                 for one in self.conditions)

    def _only_final(self):
        return all(want.statistic.word == "final" for want in self.figures)

    def _figures(self, values):
        self.undefined = []
        if self._only_final():
            last = self.scene._final([want.name for want in self.figures], values)
            return {str(want): float(last[want.name]) for want in self.figures}
        return self._statistics(self.scene._record(self._recorded(), values))

    def _recorded(self):
        """Outputs that the figures need."""
        angles = {want.statistic.angle for want in self.figures} - {None}
        return list(dict.fromkeys([*(want.name for want in self.figures), *sorted(angles), "geometry.planet_teeth"]))

    def _statistics(self, record):
        """Figures of a record, by want. A figure that cannot be formed is left out, and `undefined` gets the reason."""
        teeth = int(record["geometry.planet_teeth"][0])
        record = from_time(record, self.start, self.scene.step)
        figures, self.undefined = {}, []
        for want in self.figures:
            try:
                figures[str(want)] = want.of(record, teeth)
            except DifferentialError as reason:
                self.undefined.append(f"{want.name}:{reason}")
        return figures
