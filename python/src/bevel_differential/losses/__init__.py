"""Map of power loss and torque bias over carrier torque, carrier speed, difference of wheel speeds and oil temperature, with
measured errors."""

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..accuracy import accuracy
from ..designs import Dimension, Farm, Row, Space
from ..output_file import checked
from ..scene import Scene
from ..values import DifferentialError, FileName, Number
from ..warned import silenced
from ..writing import locked
from .grid import Bound, estimates, grid_points, refined, share_beyond, starting, torques_of
from .loss_map import MAPPED, SIGNS, LossMap
from .point import AXES, FIGURES, PointTask, benched, pressed

# variables with the units of the axes: torque, speed, difference of speeds, temperature
VARIABLES = ["carrier.torque_command", "carrier.speed_command", "left.speed_command", "oil.temperature"]
ZERO_CELSIUS = 273.15
# switch of corner contact, and level of gear contact
CORNERS, LEVEL = "effects.corner_contact", "scene.gear_contact"


@dataclass(frozen=True, kw_only=True)
class MeasuredMap(LossMap):
    """Map with all results of its measurement, in SI.

    `unseen`: random points that measure the error, with signed difference, shape (points, 4). `found`: T_left, T_right and loss of the
    runs at these points, shape (points, 3). `errors`: error of the map at these points over the bound, same shape. `estimate`: error
    over the bound, estimated by leaving lines out. `restless`: number of points whose means do not settle. `new`, `seconds`: number
    and duration of the runs of this call, including the start of workers. `model`: the choice of `accuracy` in words; empty if the
    scene's own model is used."""

    scene: Scene
    unseen: np.ndarray
    found: np.ndarray
    errors: np.ndarray
    bound: Bound
    estimate: float
    restless: int
    seconds: float
    new: int
    model: str = ""

    @property
    def beyond(self) -> int:
        """Number of unseen points whose error is beyond the bound."""
        return _beyond(self.errors)


def losses(scene: Scene | FileName, levels: Mapping[str, Sequence[float]], *, within: str | None = None, bound: Bound = Bound(),
           unseen: int = 300, seed: int = 1, most: int = 4000, out: FileName | None = None, resume: bool = False, force: bool = False,
           tell: Callable[[str], object] = lambda text: None, **farm: Any) -> MeasuredMap:
    """Measures the map of a scene; changes of the scene over time are ignored.

    `levels`: first values of each axis, by VARIABLES, SI; differences are above 0, and each runs in both directions. `within`:
    accuracy for which `accuracy` chooses the cheapest model, such as "1%"; without it, the scene's model is used. `unseen`: number of
    random points that measure the error, drawn by `seed`. Temperatures share their runs if nothing depends on them; `tell` receives
    this and other messages. `most`: maximum number of slipping points of the map in one direction. `out`: a Parquet file of all runs;
    see `designs.store.Store`. `farm`: arguments of `Farm`. An interrupt keeps the finished runs and raises `Stopped`."""
    # imported here, because printing the options or reading a map does not need it
    from ..designs.store import Columns, Store
    from ..designs.sweep import going_on_later, hashed

    scene = benched(scene if isinstance(scene, Scene) else Scene.load(scene))
    lines, model = [starting(levels[name]) for name in VARIABLES], ""
    if lines[2][0] <= 0.0:
        raise DifferentialError(f"difference = {lines[2][0]:g} rad/s: it must be above 0; both directions and zero difference are run "
                                "anyway")
    if within is not None:
        chosen = _chosen(scene, lines, within)
        model, corners = chosen.run.setting, scene.value(CORNERS)
        scene.set(chosen.set)
        # without corner contact tooth forces jump: tolerable in the middle of the map, but slow gears at its edge stall
        if corners and not scene.value(CORNERS) and scene.value(LEVEL) == scene.fmu.variable(LEVEL).literals["tooth"]:
            scene.set({CORNERS: True})
            model += ", corner contact"
        tell(f"model: {model}")
    for text in _reversals(scene, lines):
        tell(text)
    task, begin, temperatures = PointTask(scene), time.perf_counter(), lines[3]
    if len(temperatures) > 1 and not _depends_on_oil(scene, temperatures):
        lines[3] = temperatures[len(temperatures) // 2:][:1]
        tell(f"oil.temperature has no effect here, because no friction and no drag depends on it: {len(temperatures)} temperatures share "
             f"the runs at {lines[3][0] - ZERO_CELSIUS:.3g} degC")
    with ExitStack() as opened:
        store = None
        if out is not None:
            space = Space(tuple(Dimension(name, "list", ()) for name in AXES))
            about = hashed(scene, {"losses": {name: levels[name] for name in VARIABLES}, "bound": str(bound), "unseen": unseen,
                                   "seed": seed, "most": most, "runs": 2 * most + unseen, "figures": FIGURES, "conditions": []})
            opened.enter_context(locked(checked(out)))
            store = opened.enter_context(Store(out, Columns(task, space), about, resume, force))
            opened.enter_context(going_on_later(store))
        runs = _Runs(task, store, opened.enter_context(Farm(**farm)))
        while True:
            at = np.stack([grid_points(lines) * [1.0, 1.0, sign, 1.0] for sign in SIGNS])
            slipping = runs.at(at)
            figures = slipping[..., :MAPPED]
            errors = estimates(lines, torques_of(figures, at), bound.of_torques(figures, at))
            estimate = sum(worst.max(initial=0.0) for worst in errors)
            tell(f"{' x '.join(str(len(line)) for line in lines)} lines: estimated error {estimate:.2g} of the bound")
            finer = refined(lines, errors, most)
            if finer is None:
                break
            lines = finer
        stuck = runs.at(grid_points([*lines[:2], np.zeros(1), lines[3]]))
        if len(lines[3]) < len(temperatures):
            lines = [*lines[:3], temperatures]
            slipping, stuck = (np.repeat(values, len(temperatures), axis=-2) for values in (slipping, stuck))
        drawn = _drawn(lines, unseen, seed)
        found = runs.at(drawn)[..., :MAPPED]
        if store is not None and store.finished is None:
            store.finish()
    grid: dict[str, Any] = {"lines": tuple(lines), "slipping": slipping, "stuck": stuck}
    errors = np.abs(LossMap(**grid, error="").at(drawn) - found) / bound.of_figures(found, drawn)
    return MeasuredMap(**grid, error=_measured(errors, bound), scene=scene, unseen=drawn, found=found, errors=errors, bound=bound,
                       estimate=estimate, restless=runs.restless, seconds=time.perf_counter() - begin, new=runs.new, model=model)


def _beyond(errors):
    return int(np.sum(np.any(errors > 1.0, axis=1)))


def _measured(errors, bound):
    """Sentence about the measured error."""
    count, beyond = len(errors), _beyond(errors)
    if not count:
        return "no unseen points: the error of the map is not measured"
    return (f"{count} unseen points, {beyond or 'none'} beyond {bound}: at most {100.0 * share_beyond(count, beyond):.2g} % are, at 95 %; "
            f"the largest error is {errors.max():.2g} of it")


class _Runs:
    """Runs of points, each once. The order of the requests, and so the number of each run, is always the same."""

    def __init__(self, task, store, farm):
        self.task, self.store, self.farm = task, store, farm
        # rows of an earlier command; failed runs are repeated
        self.kept = {row["run"]: row for row in store.kept.to_pylist() if not row["message"]} if store is not None else {}
        self.found, self.restless, self.new = {}, 0, 0

    def at(self, points):
        """Figures at points of shape (…, 4); shape (…, figures)."""
        keys = [tuple(point) for point in points.reshape(-1, 4).tolist()]
        asked = [(len(self.found) + number, key) for number, key in enumerate(key for key in dict.fromkeys(keys) if key not in self.found)]
        key_of = dict(asked)
        self.found.update({key: None for _, key in asked})
        missing = []
        for run, key in asked:
            values, row = inputs(key), self.kept.get(run, {})
            if all(row.get(name) == value for name, value in values.items()):
                self._take(key, Row(run, values, {name: row[name] for name in FIGURES}, row["feasible"]))
            else:
                missing.append((run, values))
        if missing:
            with closing(self.farm.rows(self.task, missing)) as rows:
                for row in rows:
                    if self.store is not None:
                        self.store.add(row)
                    self._take(key_of[row.run], row)
                    self.new += 1
        return np.array([self.found[key] for key in keys]).reshape(*points.shape[:-1], len(FIGURES))

    def _take(self, key, row):
        if row.message:
            torque, speed, difference, temperature = key
            raise DifferentialError(f"at {torque:g} N.m, {speed:g} rad/s, a difference of {difference:g} rad/s and {temperature:g} K: "
                                    f"{row.message}", kind=row.kind)
        self.restless += not row.feasible
        self.found[key] = [row.figures[name] for name in FIGURES]


def inputs(point: Sequence[float]) -> dict[str, Number]:
    """Values of the FMU for a point (torque, speed, difference of speeds, temperature)."""
    torque, speed, difference, temperature = point
    return dict(zip(AXES, (torque, speed, speed + 0.5 * difference, speed - 0.5 * difference, temperature)))


def _drawn(lines, count, seed):
    """Random points between the lines, in both directions of the difference."""
    draws = np.random.default_rng(seed).random((count, len(lines) + 1))
    low, high = (np.array([line[end] for line in lines]) for end in (0, -1))
    points = low + draws[:, :-1] * (high - low)
    points[:, 2] *= np.where(draws[:, -1] < 0.5, *SIGNS)
    return points


def _depends_on_oil(scene, temperatures):
    """Returns true if torques and losses depend on the oil temperature. Tooth rating is ignored, because it does not act on motion."""
    start = scene.fmu.variable(VARIABLES[3]).start
    other = next(float(temperature) for temperature in temperatures if temperature != start)
    try:
        return VARIABLES[3] not in scene.unfelt_of({VARIABLES[3]: other, "effects.strength": False})
    except DifferentialError:
        # the run itself will report the point that is refused
        return True


def _reversals(scene, lines):
    """Sentence about each clutch on command whose torque reverses between the lines, where the map has a discontinuity."""
    _, speeds, differences, _ = lines
    for side in pressed(scene):
        per_speed = 2.0 * abs(float(scene.value(f"clutches.{side}_ratio")) - 1.0)
        if per_speed * np.abs(speeds).max() > differences[0] and per_speed * np.abs(speeds).min() < differences[-1]:
            yield (f"the torque of the {side} clutch reverses at a difference of {per_speed:g} times the carrier speed: the map needs many "
                   "points there; choose --speed and --difference on one side of it")


def _chosen(scene, lines, within):
    """Cheapest model that is accurate in the middle of the map."""
    middle = Scene(scene.name, stop=scene.stop, step=scene.step, set={**scene.values, **inputs([np.median(line) for line in lines])},
                   fmu=scene.fmu)
    # the runs of the map pass on the warnings of the FMU
    with silenced():
        found = accuracy(middle, ["left.shaft_torque:mean", "right.shaft_torque:mean"], within, from_=0.5 * scene.stop)
    if found.use is None:
        raise DifferentialError(f"within = {within}: no model is accurate enough; leave it out, or allow more")
    return found.use
