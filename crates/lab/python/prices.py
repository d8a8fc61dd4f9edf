"""What levels, laws and effects cost in time, or how the times of two builds compare: steps of the study's turn by a loop in C.

usage: prices.py [--against OTHER_FMU] FMU FOLDER [--quick]

Runs of what is compared alternate, so that what else the machine does weighs on both. Prints tables; with one build alone it
also writes FOLDER/prices.csv, and all columns and pairs to FOLDER/alone.csv and pairs.csv."""

import argparse
import csv
import statistics
from pathlib import Path

from bevel_differential import Differential, Fmu
from bevel_differential.text import markdown

from calls import TEN, Calls, Sine
from effects_list import effects
from tools import machine, say, significant

STEP = 1e-3
COUNTED = 0.5
# ratio of a pair's cost to the sum of both effects from which the pair is listed
DEAR = 1.3
# runs of each, and for a quick look
RUNS, FEW = 9, 3
# seconds of the processor that a timed run is to take, and its steps
LONG, FEWEST, MOST = 0.1, 100, 20_000
TURN = {"scene.planet_spin": "imposed", "spin.command": "200 deg/s", "carrier.speed_command": "954 deg/s"}
LEVELS = {"ideal": {"scene.gear_contact": "ideal"}, "lumped": {"scene.gear_contact": "lumped"}, "line": {"contact.law": "line"},
          "line_weber": {"contact.law": "line_weber"}, "solid": {"scene.gear_contact": "solid", "solid.facets": 32}}
# a coupled host moves this load: amplitude [N·m] and frequency [Hz]
LOAD, AMPLITUDE, FREQUENCY = "left.load_torque", 100.0, 2.0
# what the richest scene of gears in service has on
ALL = ["line", "tooth_friction", "thrust_friction", "limited_slip", "half_shaft", "pin_compliance", "bearing_drag", "strength",
       "tooth_errors"]
OF_ALL = {"tooth_errors.accuracy_grade": 6, "tooth_errors.planet_tip_relief": 0.0}


class Bench:
    """Timed runs."""

    def __init__(self, folder, runs):
        self.calls, self.runs = Calls(folder), runs

    def _per_step(self, steps, fmu, values, outputs, moving=None):
        [(_, seconds)] = self.calls.seconds(fmu, TURN | values, outputs, [(steps * STEP, STEP)], moving=moving)
        return seconds / steps

    def _steps(self, *one):
        return round(min(max(LONG / self._per_step(FEWEST, *one), FEWEST), MOST))

    def compare(self, first, second):
        """Seconds of a communication step of both, (FMU, values, outputs[, Sine]) each, and the quartiles of their ratio."""
        pairs = [(*one, self._steps(*one)) for one in (first, second)]
        taken = [[], []]
        for run in range(self.runs):
            for place in (0, 1) if run % 2 == 0 else (1, 0):
                *one, steps = pairs[place]
                taken[place].append(self._per_step(steps, *one))
        ratios = [b / a for a, b in zip(*taken)]
        quartiles = statistics.quantiles(ratios, n=4) if len(ratios) > 1 else 3 * ratios
        return [statistics.median(one) for one in taken], quartiles


def counts(fmu, values):
    """Steps, rejected ones and evaluations of 0.5 s."""
    names = ["solver.steps", "solver.rejected", "solver.rhs_calls"]
    with Differential(TURN | values, fmu=fmu.file) as turn:
        record = turn.run(outputs=names, stop=COUNTED, step=STEP)
    return [float(record[name][-1]) for name in names]


def within(quartiles):
    low, middle, high = quartiles
    return f"{middle:.2f} ({low:.2f} – {high:.2f})"


class Prices:
    """Prices of settings in time."""

    def __init__(self, bench, fmu, ideal=0.0):
        self.bench, self.fmu = bench, fmu
        self.evaluations = counts(fmu, {})[2]
        self.without_teeth = ideal

    def of(self, values):
        """Counts, seconds of a communication step, and quartiles of its price in that of plain teeth."""
        counted = counts(self.fmu, values)
        (_, taken), over = self.bench.compare((self.fmu, {}, []), (self.fmu, values, []))
        # an evaluation's price in that of plain teeth
        of_one = over[1] * self.evaluations / counted[2] if counted[2] else 0.0
        return counted, taken, over, of_one

    def moving(self, values):
        """× real time while a load moves: held within each step, and with slopes."""
        sines = [Sine(how, LOAD, float(self.fmu.variable(LOAD).start), AMPLITUDE, FREQUENCY) for how in ("held", "lines")]
        taken, _ = self.bench.compare(*((self.fmu, values, [], sine) for sine in sines))
        return [significant(STEP / each, 2) for each in taken]

    def row(self, name, values):
        (steps, rejected, evaluations), taken, over, of_one = self.of(values)
        return [name, f"{steps:.0f}", f"{rejected:.0f}", f"{evaluations:.0f}", significant(1e6 * taken, 3), within(over),
                f"{of_one:.2f}", significant(STEP / taken, 2)], of_one, over[1]


def short(row):
    """The columns of a row that the document has."""
    return [row[0], row[1], row[3], row[5].split(" (")[0], *row[6:]]


def prices(bench, fmu, switches, with_pairs, folder):
    """The tables of one build."""
    singles = {**LEVELS, **switches}
    pairs = [(a, b) for k, a in enumerate(["line", *switches]) for b in ["line", *switches][k + 1:]] if with_pairs else []
    stages = 2 + len(singles) + len(pairs)
    priced = Prices(bench, fmu)
    rows = [["on", "steps", "rejected", "evaluations", "µs per 1 ms", "over plain (quartiles)", "of an evaluation", "× real time",
             "load held", "with slopes"]]
    known, data = {}, []
    for done, (name, values) in enumerate({"nothing": {}, **singles}.items()):
        say(done / stages, f"timing {name}")
        row, of_one, over = priced.row("nothing" if name == "nothing" else f"`{name}`", values)
        rows.append([*row, *priced.moving(values)])
        known[name] = of_one
        data.append([name, significant(of_one, 4), significant(over * priced.evaluations / (COUNTED / STEP), 4)])
    every = OF_ALL.copy()
    for name in ALL:
        every = singles[name] | every
    say((1 + len(singles)) / stages, "timing all together")
    row, of_all, _ = priced.row("all together", every)
    rows.append([*row, *priced.moving(every)])
    write(folder, "prices.csv", [["on", "evaluation", "communication_step"], *data])
    write(folder, "alone.csv", rows)
    added = 1.0 + sum(known[name] - 1.0 for name in ALL)
    text = (f"Each row has one level, law or effect on. \"All together\" is {', '.join(f'`{name}`' for name in ALL)} of grade 6.\n\n"
            f"{markdown([short(row) for row in rows])}\nWith all together, an evaluation costs {of_all:.1f} times that of plain teeth; "
            f"adding up the single effects would give {added:.1f}.\n")
    if pairs:
        rows = [["on", "steps", "evaluations", "µs per 1 ms", "over plain (quartiles)", "of an evaluation", "over the sum"]]
        for done, (a, b) in enumerate(pairs):
            say((2 + len(singles) + done) / stages, f"timing {a}, {b}")
            row, of_one, _ = priced.row(f"`{a}`, `{b}`", singles[a] | singles[b])
            rows.append([*row[:2], *row[3:7], f"{of_one / (known[a] + known[b] - 1.0):.2f}"])
        write(folder, "pairs.csv", rows)
        text += pairs_text(rows[1:])
    return text


def pairs_text(rows):
    """Pairs that cost far more than the sum of both effects, and the range of the others."""
    dear = sorted((row for row in rows if float(row[-1]) >= DEAR), key=lambda row: -float(row[-1]))
    others = [float(row[-1]) for row in rows if float(row[-1]) < DEAR]
    most_pairs = f"\nOf {len(rows)} pairs, {len(others)} cost {min(others):.2f} to {max(others):.2f} times the sum of both effects"
    table = [["on", "over plain", "over the sum"], *([row[0], row[4].split(" ")[0], row[-1]] for row in dear)]
    return f"{most_pairs}. The others:\n\n{markdown(table)}"


def write(folder, name, rows):
    with (Path(folder) / name).open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def builds(bench, fmu, other, switches):
    """The table of two builds."""
    every = OF_ALL.copy()
    for name in ALL:
        every = {**LEVELS, **switches}[name] | every
    settings = {"nothing": {}, **LEVELS, **switches, "tooth_friction, thrust_friction": {
        **switches["tooth_friction"], **switches["thrust_friction"]}, "all together": every}
    rows = [["on", "µs per 1 ms", "other, µs", "ratio to the other (quartiles)"]]
    cases = [(name, values, []) for name, values in settings.items()] + [("nothing, ten outputs read", {}, TEN)]
    for done, (name, values, outputs) in enumerate(cases):
        say(done / len(cases), f"timing {name}")
        if any(each not in other.variables for each in [*values, *outputs]):
            rows.append([name, "", "", "unknown to the other"])
            continue
        (before, now), over = bench.compare((other, values, outputs), (fmu, values, outputs))
        rows.append([name, significant(1e6 * now, 3), significant(1e6 * before, 3), within(over)])
    return markdown(rows)


def main():
    parser = argparse.ArgumentParser()
    for name in ("--against", "fmu", "folder"):
        parser.add_argument(name)
    parser.add_argument("--quick", action="store_true")
    given = parser.parse_args()
    runs = FEW if given.quick else RUNS
    bench, fmu = Bench(given.folder, runs), Fmu.of(given.fmu)
    switches = {effect.name: effect.on for effect in effects(given.fmu)}
    if given.against:
        text = builds(bench, fmu, Fmu.of(given.against), switches)
    else:
        text = prices(bench, fmu, switches, not given.quick, given.folder)
    print(f"{text}\nMedians of {runs} alternating runs. {machine()}.")


if __name__ == "__main__":
    main()
