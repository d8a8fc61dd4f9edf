"""Cost of facets in accuracy and time: solid teeth in the study's turn, compared with exact teeth.

usage: solids.py FMU FOLDER [--quick]

Simulates exact teeth, and solids of 4 to 128 facets per flank with two smoothings: almost only the deepest point, and the patch. Writes
CSV files, study.md and pictures, and prints the section of docs/inside/cost.md. Fails if the mean force of solids differs too much from that
of exact teeth."""

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bevel_differential import Differential, Fmu
from calls import Calls, in_turn, quartiles
from solids_errors import QUANTITIES, errors, look, order, path_ripple
from tools import WORKSPACE, Finding, say, write_measured

sys.path.append(str(WORKSPACE / "benches" / "peers"))
import gears  # noqa: E402

STEP = 1e-3
# records per communication step in the mesh cycle with dense records
CLOSE = 10
# smoothing with almost only the deepest point, as in a general multibody program, and with the patch, the default
SMOOTHINGS = (0.02, 1.0)
# tolerance whose integration error is far below the error of facets, and the default tolerance
TIGHT, USUAL = 1e-9, 1e-6
RUNS = 5
SPEED, SPIN, LOAD = 954.0, 200.0, 835.0
TURN = {"scene.planet_spin": "imposed", "spin.command": (SPIN, "deg/s"), "carrier.speed_command": (SPEED, "deg/s")}
WILLIS = [SPEED + sign * SPIN * gears.PLANET_TEETH / gears.SIDE_TEETH for sign in (1.0, -1.0)]
# by facets: maximum relative deviation of the mean force from that of exact teeth
BOUNDS = {32: 1e-2, 128: 1e-3}
COLUMNS = {"speed": "{}.speed", "force": "{}.normal_force", "tangential": "{}.tangential_force",
           "error": "planet[1].{}_transmission_error", "pairs": "planet[1].{}_pairs"}


@dataclass(frozen=True)
class Plan:
    """Numbers of facets; times at which runs have settled, dense records begin, and runs end [s]."""

    facets: tuple[int, ...]
    settled: float
    close: float
    end: float


# two mesh cycles of 0.18 s each remain after 0.14 s
FULL = Plan((4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128), 0.14, 0.32, 0.5)
QUICK = Plan((4, 8, 16, 32), 0.02, 0.05, 0.1)


@dataclass
class Row:
    """Results of one kind of teeth; exact teeth have 0 facets.

    `errors`: at the tight and at the default tolerance; for exact teeth those of the integration. `seconds`: median and quartiles of the
    processor time at the default tolerance; `counts`: steps and evaluations of that run."""

    facets: int
    smoothing: float
    arc: float
    errors: list[dict[str, float]]
    look: dict[str, float]
    path_ripple: float
    counts: tuple[int, int]
    close: dict[str, np.ndarray]
    seconds: list[float]
    real_time: float = math.nan

    @property
    def taken(self):
        """Median of the processor time [s]."""
        return self.seconds[0]


class Found:
    """All results. `rows`: exact teeth first; `overlap`: d of K d^e = F if one pair transmits the whole force F of a mesh [m]."""

    def __init__(self, plan, rows, overlap):
        self.plan, self.rows, self.tooth, self.overlap = plan, rows, rows[0], overlap
        self.of = {(row.facets, row.smoothing): row for row in rows}

    def solid(self, facets, which):
        """Row with `facets` at SMOOTHINGS[which], or None."""
        return self.of.get((facets, SMOOTHINGS[which]))

    def series(self, quantity, which):
        """Pairs (facets, error at the tight tolerance)."""
        return [(facets, self.solid(facets, which).errors[0][quantity]) for facets in self.plan.facets]


def arc_height(facets):
    """Largest height of an arc over its facet at the mean cone distance, as the sum of planet and side gear [m]."""
    height, radius = 0.0, gears.ROOT_FILLET / gears.OUTER_CONE
    for gear in (gears.PLANET, gears.SIDE):
        start = max(gears.arc(gear.base, max(gear.root + radius, gear.base)) - radius, 0.0)
        arcs = np.linspace(start, gears.arc(gear.base, gear.tip), 2 * facets + 1)
        polar = np.arccos(np.cos(gear.base) * np.cos(arcs))
        points = gears.direction(polar, gear.half_angle(polar))
        normals = np.cross(points[:-2:2], points[2::2])
        height += np.abs(np.sum(points[1::2] * normals, axis=1) / np.linalg.norm(normals, axis=1)).max()
    return gears.MEAN_CONE * height


def settings(facets, smoothing, tolerance):
    """Start values of the turn with these teeth."""
    solid = {"scene.gear_contact": "solid", "solid.facets": facets, "solid.smoothing": smoothing} if facets else {}
    return {**TURN, **solid, "solver.relative_tolerance": tolerance}


def record(fmu, plan, values, closely):
    """Record after the settled state, and the numbers of steps and evaluations of the whole run."""
    names = {key: [name.format(side) for side in ("left", "right")] for key, name in COLUMNS.items()}
    counts = ["solver.steps", "solver.rhs_calls"]
    every = CLOSE if closely else 1
    with Differential(values, fmu=fmu) as turn:
        run = turn.run(outputs=[*sum(names.values(), []), *counts], stop=plan.end, step=STEP / every)
    communicates = np.arange(len(run)) % every == 0
    time = run["time"]
    kept = (time > plan.settled + 0.5 * STEP / CLOSE) & (communicates | (time > plan.close + 0.5 * STEP / CLOSE))
    points = {key: np.column_stack([run[name][kept] for name in both]).astype(float) for key, both in names.items()}
    points["speed"] = np.degrees(points["speed"])
    return {"time": time[kept], "communicates": communicates[kept], **points}, tuple(int(run[name][-1]) for name in counts)


def measured(fmu, plan, folder):
    """Records, errors and times of all kinds of teeth."""
    kinds = [(0, math.nan), *((facets, smoothing) for smoothing in SMOOTHINGS for facets in plan.facets)]
    rows, exact, close = [], None, plan.close + 0.5 * STEP / CLOSE
    for done, (facets, smoothing) in enumerate(kinds):
        say(0.5 * done / len(kinds), f"solid, {facets} facets, smoothing {smoothing}" if facets else "tooth")
        tight, _ = record(fmu, plan, settings(facets, smoothing, TIGHT), True)
        usual, counts = record(fmu, plan, settings(facets, smoothing, USUAL), False)
        exact = exact or tight
        at_points = {name: values[exact["communicates"]] for name, values in exact.items()}
        own = {name: values[tight["time"] > close] for name, values in tight.items()}
        rows.append(Row(facets, smoothing, arc_height(facets) if facets else math.nan,
                        [errors(tight, exact, close, WILLIS), errors(usual, at_points, close, WILLIS)], look(tight, close),
                        path_ripple(tight, exact, close, WILLIS), counts, own, []))
    calls = Calls(folder)

    def take(kind, _):
        return [own for _, own in calls.seconds(fmu, settings(*kind, USUAL), [], [(plan.end, STEP)])]

    for row, taken in zip(rows, in_turn(kinds, RUNS, take, (0.5, 0.95), "times")):
        row.seconds = quartiles(taken)
        row.real_time = plan.end / row.taken
    return Found(plan, rows, overlap(fmu))


def overlap(fmu):
    """Overlap of one pair under the whole force of a mesh, with the study's K and e [m]."""
    force = LOAD / (gears.PLANETS * gears.MEAN_CONE * math.sin(gears.SIDE.base))
    stiffness, exponent = (fmu.variable(f"contact.{name}").start for name in ("stiffness", "exponent"))
    return (force / stiffness) ** (1.0 / exponent)


def write(found, folder):
    """Writes errors and cost by facets, and one mesh cycle."""
    head = ["teeth", "facets", "smoothing", "arc_height_um", "steps", "evaluations", "cpu_s", "cpu_s_low", "cpu_s_high", "real_time",
            "cost", "mean_force_N", "peak_force_N", "ripple_N", "tangential_ripple_N", "mean_te_um"]
    for name, (unit, _) in QUANTITIES.items():
        unit = unit.replace("/", "_")
        head += [f"{name}_{unit}", f"{name}_usual_{unit}", f"{name}_order"]
    lines, cycle = [head], [["teeth", "facets", "smoothing", "time_s", "force_N", "speed_deg_s", "te_um", "tangential_N", "pairs"]]
    for place, row in enumerate(found.rows):
        teeth, before = "solid" if row.facets else "tooth", found.rows[place - 1] if place else found.tooth
        line = [teeth, row.facets or "-", row.smoothing, 1e6 * row.arc, *row.counts, *row.seconds, row.real_time,
                row.taken / found.tooth.taken, *(row.look[name] for name in ("mean", "peak", "ripple", "tangential")),
                1e6 * row.look["deflection"]]
        for name in QUANTITIES:
            pairs = [(one.facets, one.errors[0][name]) for one in (before, row)]
            line += [row.errors[0][name], row.errors[1][name], order(*pairs) if 0 < before.facets < row.facets else math.nan]
        lines.append(line)
        if row.facets <= 32:
            own = row.close
            columns = zip(own["time"], own["force"][:, 0], own["speed"][:, 0], 1e6 * own["error"][:, 0], own["tangential"][:, 0],
                          own["pairs"][:, 0])
            cycle += [[teeth, row.facets, f"{row.smoothing if row.facets else 0:g}", f"{time:.4f}", f"{force:.3f}", f"{speed:.5f}",
                       f"{error:.4f}", f"{tangential:.4f}", int(pairs)] for time, force, speed, error, tangential, pairs in columns]
    write_measured(folder / "solids.csv", [
        "the study's turn; errors against exact teeth at a tolerance of 1e-9, and (usual) at 1e-6; order: from the row before",
        "force: normal forces of all planets on a side gear; te: transmission error; path: where exact teeth keep force and speed constant",
        "real_time: simulated over processor time at 1e-6; cost: processor time over that of exact teeth"], lines)
    write_measured(folder / "solids_cycle.csv", ["left side gear, all planets; one mesh cycle at a tolerance of 1e-9"], cycle)


def verdict(found):
    """Fails if the mean force of solids misses its bound. Their speed is only reported, because machines differ."""
    for facets, bound in BOUNDS.items():
        row = found.solid(facets, 1)
        off = abs(row.look["mean"] / found.tooth.look["mean"] - 1.0) if row else 0.0
        if not off <= bound:
            raise Finding(f"{facets} facets miss the mean force by {100.0 * off:.3g} %, more than {100.0 * bound:g} %")


def main():
    import solids_figures
    import solids_page

    fmu, folder = Fmu.of(sys.argv[1]), Path(sys.argv[2])
    found = measured(fmu, QUICK if "--quick" in sys.argv else FULL, folder)
    write(found, folder)
    say(0.95, "drawing")
    solids_figures.draw(folder)
    (folder / "study.md").write_text(solids_page.study(found), encoding="utf-8")
    verdict(found)
    print(solids_page.page(found))


if __name__ == "__main__":
    main()
