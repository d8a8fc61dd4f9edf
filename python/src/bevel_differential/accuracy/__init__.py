"""Which model is accurate enough: the cheapest that gives wanted quantities to an accuracy, proven in runs of the scene."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..answers import Progress, about, ask
from ..scene import Scene
from ..values import FileName, Value

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Run:
    """A run of the scene that was tried.

    `error`: the largest of the wanted quantities, as a part of 100 %, and `worst`, the quantity that has it. `place`: "chosen",
    "cheaper", "richer", "reference" or "". `price`: in evaluations of plain teeth. `seconds`: time on the processor, s."""

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

    `set`: values by name, as `Scene.set` takes them. `run`: how it did. `difference`: what it has otherwise than the chosen one, in
    words."""

    set: dict[str, Value]
    run: Run
    difference: str


@dataclass(frozen=True)
class Accuracy:
    """The answer.

    `wants`: what was wanted; `values`: by it what the reference gives, SI. `use`: the chosen setting, None if nothing is accurate enough; `cheaper`: the dearest one below it, which fails; `richer`: the
    next one nearer to the reference; `reference`: what all were compared with. `needed`, `out`: effects that are in the setting, and
    that are not, by how much each changes a wanted quantity. `effects`: what became of each effect, and why. `uncertain`: the
    reference itself is not sure to a third of the accuracy. `runs`: all that was tried; `table`: the same as CSV."""

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
        """Draws error against cost of all that was tried."""
        from .picture import picture

        return picture(self, file)


def accuracy(scene: FileName | Scene, want: Sequence[str] | str = (), within: float | str = "1%", *, from_: str | float | None = None,
             set: Mapping[str, Value] | None = None, timed: bool = True, file: FileName | None = None,
             progress: Progress | None = None) -> Accuracy:
    """The cheapest level, law, set of effects and tolerance that give the wanted quantities of a scene to an accuracy.

    `scene`: a file, the name of a shipped scene, or a `Scene`. `want`: "OUTPUT:STATISTIC" each, such as "left.speed:mean"; none =
    all outputs of the scene. `within`: such as "1%" or 0.01. `from_`: outputs count from this time on, s or with a unit. `set`: changes
    of the scene. `timed`: measure times on the processor, too. `file`: where a scene file with the setting will be; its text is
    `answer["file"]`. Ctrl-C stops the work. Raises `DifferentialError`."""
    question = {"ask": "accuracy", "of": about(scene, set), "want": [want] if isinstance(want, str) else list(want),
                "within": str(within), "from": None if from_ is None else str(from_), "timed": timed,
                "file": None if file is None else Path(file)}
    found = ask(question, progress=progress)
    runs = [Run(**{**row, "error": float("inf") if row["error"] is None else row["error"]}) for row in found["runs"]]
    places = {run.place: run for run in runs if run.place}

    def choice(key, place):
        told = found[key]
        return None if told is None else Choice(told["set"], places[place], told["difference"])

    def effects(role):
        return {effect["name"]: effect["by"] for effect in found["effects"] if effect["role"] == role}

    return Accuracy(
        scene=found["scene"], wants=found["wants"], values=dict(zip(found["wants"], found["values"])), within=found["within"], use=choice("use", "chosen"),
        cheaper=choice("cheaper", "cheaper"), richer=choice("richer", "richer"), reference=places["reference"],
        needed=effects("needed"), out=effects("out"), effects={effect["name"]: effect for effect in found["effects"]},
        uncertain=found["uncertain"], runs=runs, table=found["csv"], text=found["text"], answer=found)
