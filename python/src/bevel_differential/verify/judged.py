"""Records compared with the results of the evidence."""

from dataclasses import dataclass

import numpy as np

from .experiment import Experiment
from .files import Broken

# of the largest magnitude of a variable in the result, where the evidence states no tolerance
ASSUMED = 1e-3
# times that differ by less than this part of the last time are the same
SLACK = 1e-9


@dataclass(frozen=True)
class Deviation:
    """The largest deviation of a variable by its tolerance, with the time, s, at which it occurs."""

    variable: str
    unit: str
    time: float
    value: float
    expected: float
    tolerance: float

    @property
    def size(self) -> float:
        """How far the value is from the expected one."""
        return abs(self.value - self.expected)

    @property
    def ratio(self) -> float:
        """The same by the tolerance; a value that is not a number is infinitely far."""
        return self.size / self.tolerance if np.isfinite(self.size) else np.inf


@dataclass(frozen=True)
class Judged:
    """An experiment with the verdict "passed", "failed" or "broken"; `deviations` by variable, or the `problem` instead."""

    name: str
    kind: str
    verdict: str
    deviations: tuple[Deviation, ...] = ()
    problem: str = ""
    assumed: bool = False

    @property
    def worst(self) -> Deviation | None:
        """The largest deviation by its tolerance."""
        return max(self.deviations, key=lambda each: each.ratio, default=None)


def broken(experiment: Experiment, problem: str) -> Judged:
    """An experiment that cannot be judged."""
    return Judged(experiment.name, experiment.kind, "broken", problem=problem)


def judged(experiment: Experiment, record: np.ndarray) -> Judged:
    """Compares a record with the result of an experiment. Without a result it passes where the run comes to its end."""
    end, expected = record["time"][-1], experiment.expected
    last = experiment.stop if expected is None else expected["time"][-1]
    slack = SLACK * max(abs(last or 0.0), abs(end))
    if last is not None and end < last - slack:
        missed = "its stop time" if expected is None else "the last time of the result"
        return broken(experiment, f"the run ends at {end:g} s, before {missed}, {last:g} s")
    deviations = tuple(each for name in experiment.columns for each in _deviations(experiment, name, record, slack))
    passed = all(each.ratio <= 1.0 for each in deviations)
    assumed = bool(deviations) and not experiment.allowed
    return Judged(experiment.name, experiment.kind, "passed" if passed else "failed", deviations, assumed=assumed)


def _deviations(experiment, name, record, slack):
    """The deviation of each element of a variable."""
    expected, times = experiment.expected[name], experiment.expected["time"]
    wanted, recorded = (values.reshape(len(values), -1).astype(float).T for values in (expected, record[name]))
    if len(wanted) != len(recorded):
        raise Broken(f"{name}: it has {len(recorded)} elements, {len(wanted)} in the result")
    # where the largest magnitude is 0 any other value is a deviation
    tolerance = experiment.allowed.get(name) or ASSUMED * np.abs(wanted).max() or np.finfo(float).tiny
    for place, (of_result, of_record) in enumerate(zip(wanted, recorded), 1):
        values = _nearest(times, of_result, record["time"], of_record, slack)
        distance = np.abs(values - of_result)
        worst = int(np.argmax(np.where(np.isfinite(distance), distance, np.inf)))
        shown = f"{name}[{place}]" if len(wanted) > 1 else name
        yield Deviation(shown, experiment.units[name], times[worst], values[worst], of_result[worst], tolerance)


def _nearest(times, wanted, recorded, values, slack):
    """Values at times. At an event a record has values before and after it: the one that is nearer to the wanted one counts."""
    before, after = (np.searchsorted(recorded, times + sign * slack, side) for sign, side in ((-1.0, "left"), (1.0, "right")))
    found = np.interp(times, recorded, values)
    for place in np.flatnonzero(after > before):
        at = values[before[place]:after[place]]
        found[place] = at[np.argmin(np.abs(at - wanted[place]))]
    return found
