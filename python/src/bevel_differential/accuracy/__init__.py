"""Finds the cheapest model that gives wanted quantities to an accuracy, proven by runs of the scene."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..answers import Progress, about, ask
from ..panel import CYCLE, FAINT, GREY, INK, RED, Mark, Panel, curve, picture
from ..quantities import QUANTITIES
from ..readable import plain
from ..scene import Scene
from ..values import DifferentialError, FileName, Value

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# prefixes of setting texts and their markers, in the order of the legend; the first match counts
KINDS = [("ideal", "o"), ("lumped", "s"), ("tooth impact", "^"), ("tooth line +", "P"), ("tooth line_weber +", "D"),
         ("tooth line_weber", "X"), ("tooth line", "v"), ("solid", "<")]
# settings with fixed steps: their counts cannot be compared with those of the adaptive method
FIXED = "fixed steps"
# smallest error that is drawn, as a fraction of the accuracy; smaller errors are drawn at this value
FLOOR = 1e-3
LONGEST = 90


@dataclass(frozen=True)
class Run:
    """A run of the scene.

    `tried`: the reason for the run, in words. `error`: the largest error of a wanted quantity, as a fraction; `worst`: the
    quantity with this error. `place`: its role, "chosen", "cheaper", "richer", "reference" or "". `price`: its cost, in
    evaluations of plain teeth. `seconds`: processor time, s."""

    tried: str
    place: str
    setting: str
    error: float
    worst: str
    evaluations: float
    steps: float
    price: float
    seconds: float


@dataclass(frozen=True)
class Choice:
    """A setting of the scene.

    `set`: values by name, as `Scene.set` takes them. `run`: its run. `difference`: its differences from the chosen setting, in
    words."""

    set: dict[str, Value]
    run: Run
    difference: str


@dataclass(frozen=True)
class Accuracy:
    """Result of `accuracy`.

    `wants`: the wanted quantities; `values`: their values in the reference, SI. `use`: the chosen setting, None if nothing is
    accurate enough; `cheaper`: the most expensive of the cheaper settings that are not accurate enough; `richer`: the cheapest of
    the more expensive settings with a smaller error; `reference`: the run with which all others are compared. `needed`, `out`:
    effects that the setting needs, and effects that it leaves out, with the largest change of a wanted quantity by each. `effects`:
    the role of each effect, with the reason. `uncertain`: true if the uncertainty of the reference is above a third of the accuracy.
    `runs`: all runs; `table`: the same as CSV."""

    scene: str
    wants: list[str]
    values: dict[str, float]
    within: float
    use: Choice | None
    cheaper: Choice | None
    richer: Choice | None
    reference: Run
    needed: dict[str, float]
    out: dict[str, float]
    effects: dict[str, dict[str, Any]]
    uncertain: bool
    runs: list[Run]
    table: str = field(repr=False)
    text: str = field(repr=False)
    answer: dict[str, Any] = field(repr=False)

    def __str__(self) -> str:
        return self.text

    def plot(self, file: FileName | None = None) -> "Figure":
        """Draws the error of all runs against their cost."""
        return _drawn(self, file)


def accuracy(scene: FileName | Scene, want: Sequence[str] | str = (), within: float | str = "1%", *, from_: str | float | None = None,
             set: Mapping[str, Value] | None = None, file: FileName | None = None,
             display_units: Sequence[str] = (), progress: Progress | None = None) -> Accuracy:
    """Finds the cheapest level, law, set of effects and tolerance that give the wanted quantities of a scene to an accuracy. A scene
    with `solver.method` = fixed_step keeps this method; the longest fixed steps then replace the tolerance.

    `scene`: a file, the name of a shipped scene, or a `Scene`. `want`: one or several "OUTPUT:STATISTIC", such as
    "left.speed:mean"; the default is all outputs of the scene. `within`: such as "1%" or 0.01. `from_`: outputs count from this
    time on, s or with a unit. `set`: changes of the scene. `display_units`: units of the text. `file`: intended path of a scene
    file with the setting; the file is not written, its text is `answer["file"]`. Ctrl-C stops the work. Raises
    `DifferentialError`."""
    wants = [want] if isinstance(want, str) else list(want)
    for text in wants:
        if (name := text.partition(":")[0].strip()) in QUANTITIES:
            raise DifferentialError(f"--want {text}: {name} is calculated from outputs after a run, and only the accuracy of outputs is examined"
                                    + (f"; name {' or '.join(QUANTITIES[name].loads)}" if QUANTITIES[name].loads else ""))
    question = {"ask": "accuracy", "of": about(scene, set, display_units), "want": wants,
                "within": str(within), "from": None if from_ is None else str(from_), "file": None if file is None else Path(file)}
    found = ask(question, progress=progress)
    runs = [Run(**{**row, "error": float("inf") if row["error"] is None else row["error"]}) for row in found["runs"]]
    places = {run.place: run for run in runs if run.place}

    def choice(key, place):
        answered = found[key]
        return None if answered is None else Choice(answered["set"], places[place], answered["difference"])

    def effects(role):
        return {effect["name"]: effect["by"] for effect in found["effects"] if effect["role"] == role}

    return Accuracy(
        scene=found["scene"], wants=found["wants"], values=dict(zip(found["wants"], found["values"])), within=found["within"], use=choice("use", "chosen"),
        cheaper=choice("cheaper", "cheaper"), richer=choice("richer", "richer"), reference=places["reference"],
        needed=effects("needed"), out=effects("out"), effects={effect["name"]: effect for effect in found["effects"]},
        uncertain=found["uncertain"], runs=runs, table=found["csv"], text=found["text"], answer=found)


def kind(setting):
    return next((number for number, (text, _) in enumerate(KINDS) if setting.startswith(text)), len(KINDS) - 1)


def _drawn(found, file):
    runs, within, wanted = found.runs, found.within, ", ".join(found.wants)

    def points(runs, *look, **options):
        """Marks of runs at their costs and errors, %; none without runs."""
        at = [(100.0 * run.price / found.reference.price, 100.0 * max(run.error, FLOOR * within)) for run in runs]
        return [curve(*zip(*at), *look, **options)] if at else []

    chosen = [run for run in runs if run.place == "chosen"]
    is_fixed = any(FIXED in run.setting for run in chosen)
    tried = [run for run in runs[:-1] if (FIXED in run.setting) == is_fixed]
    marks = []
    for number, (text, marker) in enumerate(KINDS):
        marks += points([run for run in tried if kind(run.setting) == number], text.replace(" +", " + gear bodies"), CYCLE[number % len(CYCLE)],
                        marker, ms=6, alpha=0.75)
    marks += points([run for run in runs[:-1] if run not in tried], "adaptive" if is_fixed else FIXED, FAINT, ".", ms=6)
    marks += points(runs[-1:], "reference (its uncertainty from the tolerance)", INK, "*", ms=13)
    front, best = [], float("inf")
    for run in sorted(tried, key=lambda run: (run.price, run.error)):
        if run.error < best:
            front.append(run)
            best = run.error
    marks += points(front, None, GREY, drawstyle="steps-post", lw=1, zorder=1)
    marks += points(chosen, "chosen", None, "o", mfc="none", mec=RED, mew=2.2, ms=17)
    marks += [Mark("axhline", 100.0 * within, color=RED, lw=1, ls="--"),
              Mark(lambda axes: axes.annotate("wanted", (0.003, 100.0 * within), xycoords=axes.get_yaxis_transform(), xytext=(4, 3),
                                              textcoords="offset points", color=RED))]
    chosen_text = f"chosen is {chosen[0].setting}" if chosen else "nothing is accurate enough"
    tiny = (f" Errors below {plain(100.0 * FLOOR * within)} % are drawn at this value."
            if any(run.error < FLOOR * within for run in runs) else "")
    panel = Panel("cost, % of the reference", "largest error of the wanted quantities, %", marks,
                  f"{found.scene}: {wanted if len(wanted) <= LONGEST else wanted[:LONGEST] + ' …'}", legend="right", xscale="log", yscale="log",
                  ylim=(60.0 * FLOOR * within, None))
    return picture([[panel]], "Each mark is a run of the scene with another level, law, set of effects, tolerance or step, compared with "
                   "the richest model at a fine tolerance. Lower is more accurate, left is cheaper; the grey line joins the "
                   f"cheapest runs for each accuracy. Runs below the dashed line are accurate enough; {chosen_text}.{tiny}", file, 6.2)
