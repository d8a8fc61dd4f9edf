"""Survey of the answers of the command `accuracy`: random scenes with three quantities each, at 1 and 5 %. The chosen setting runs in the
packaged FMU, started from the parameter set of the answer. It is compared with a reference that is independent of the search: the
richest model with another method (Radau) at a tenth of the tolerance.

usage: survey.py FMU FOLDER SCENES SEED [--shipped]

Prints the verdict, and writes it to FOLDER/survey.md next to FOLDER/cases.csv. With --shipped, answers for the shipped scenes instead, and
writes the times to FOLDER/shipped.md."""

import csv
import os
import shutil
import statistics
import sys
import textwrap
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy.ssp.ssd import read_ssv

from bevel_differential import Differential, DifferentialError, DifferentialWarning, accuracy, shipped_scenes
from bevel_differential.points import from_time
from bevel_differential.scene_file import find, read_scene
from bevel_differential.text import aligned, markdown
from bevel_differential.want import Want
from survey_scenes import drawn
from tools import percent, say, significant, tell

WITHIN = (0.01, 0.05)
# maximum duration of a scene in seconds
LONGEST = 60.0
# tolerance of the independent reference relative to that of the search's reference
FINER = 0.1
# outputs that are also recorded, for orders
ANGLES = ["planet[1].spin_angle", "carrier.angle"]
# fraction of a run in which the teeth meet, which is ignored
START = 0.15
# fraction of the accuracy above which the error of an answer's reference makes it uncertain
THIRD = 1.0 / 3.0
# maximum length of a line
WIDTH = 118


@dataclass(frozen=True)
class Case:
    """A question with its answer and the results of the FMU.

    `error`: of the chosen setting in the FMU compared with the independent reference; `promised`: error stated by the answer; `stray`:
    uncertainty of its reference; `apart`: difference of both references; `gain`: price of the reference divided by that of the chosen
    setting; `spent`: price of the search divided by that of a reference run."""

    case: str
    want: str
    within: float
    error: float
    promised: float
    stray: float
    apart: float
    uncertain: bool
    gain: float
    spent: float

    @property
    def is_within(self):
        return self.error <= self.within

    @property
    def is_silent(self):
        """True if the reference of the answer was wrong by more than a third of the accuracy, and the answer did not say so."""
        return self.apart > THIRD * self.within and not self.uncertain


def error(value, wanted, scale):
    """Error as a fraction of `scale`; any change from zero is an error of 100 %."""
    by = abs(value - wanted)
    return float(by if by == 0.0 else np.inf if not np.isfinite(by) else by / scale if scale else 1.0)


class Runs:
    """Runs of the FMU in a drawn scene, with their statistics."""

    def __init__(self, fmu, scene):
        self.fmu, self.scene = fmu, scene
        self.outputs = list(dict.fromkeys([*scene.contents()["outputs"], *ANGLES]))

    def record(self, values):
        """Record of a run with these start values, without its start."""
        with Differential(values, fmu=self.fmu) as differential:
            record = differential.run(outputs=self.outputs, stop=self.scene.stop, step=self.scene.step)
        return from_time(record, START * self.scene.stop, self.scene.step)

    def figure(self, want, record):
        with Differential(fmu=self.fmu) as differential:
            return Want.parse(differential.fmu, want).of(record, self.scene.values["geometry.planet_teeth"])


def cases_of(fmu, folder, seed, index):
    """Answers to all questions about a scene."""
    scene = drawn(seed, index)
    runs, independent, found = Runs(fmu, scene), None, []
    for place, want in enumerate(scene.wants):
        for within in WITHIN:
            answer = accuracy(scene, want, within, from_=START * scene.stop)
            if answer.use is None:
                raise DifferentialError("no run finishes")
            reference = answer.answer["reference"]
            if independent is None:
                # one run for all quantities of a scene, based on the finest of the references
                tolerance = FINER * reference["set"].get("solver.relative_tolerance", 1e-6)
                variable = Differential(fmu=fmu).fmu.variable("solver.relative_tolerance")
                independent = runs.record({**reference["set"], "solver.method": "radau",
                                           "solver.relative_tolerance": max(tolerance, variable.minimum)})
            name = f"{index:03}_{place}_{100.0 * within:.0f}"
            file = folder / f"{name}.ssv"
            file.write_text(answer.answer["ssv"], encoding="utf-8")
            chosen = runs.record({parameter.name: parameter.value for parameter in read_ssv(str(file)).parameters})
            value, wanted = runs.figure(want, chosen), runs.figure(want, independent)
            scale = reference["scales"][0]
            found.append(Case(name, want, within, error(value, wanted, scale), answer.use.run.error, answer.reference.error,
                              error(reference["values"][0], wanted, scale), answer.uncertain,
                              answer.reference.price / answer.use.run.price, answer.answer["spent"]))
    return found


def surveyed(fmu, folder, scenes, seed):
    """All cases, and scenes without an answer."""
    failed, cases, done = [], [], iter(range(1, scenes + 1))

    def work(index):
        try:
            return cases_of(fmu, folder, seed, index)
        except DifferentialError as why:
            failed.append(f"scene {index}: {why}")
            return []
        finally:
            number = next(done)
            say(number / scenes, f"scene {number} of {scenes}")

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(work, range(scenes)):
            cases += found
    return cases, sorted(failed)


def verdict(cases, failed):
    """Counts in sentences, and tables of wrong and of uncertain answers."""
    certain = [one for one in cases if not one.uncertain]
    good = sum(one.is_within for one in certain)
    gain, spent = [one.gain for one in cases], [one.spent for one in cases]
    middle = [significant(statistics.median(values) if values else np.nan, 2) for values in (gain, spent)]
    lines = wrapped(f"{len(cases)} questions. {len(certain)} answers are certain, and {good} of them "
                    f"({100.0 * good / max(len(certain), 1):.1f} %) are within the accuracy. In the median, the "
                    f"chosen setting is {middle[0]} times cheaper than the reference. In the median, a search costs as much as {middle[1]} "
                    f"reference runs; the most expensive one as much as {significant(max(spent, default=0.0), 2)}.")
    for title, some in [
            ("Wrong: in the FMU, the error of the chosen setting exceeds the accuracy", [one for one in cases if not one.is_within]),
            ("Silent: the error of the reference exceeds a third of the accuracy, and the answer does not say so",
             [one for one in cases if one.is_silent]),
            ("Uncertain: the answer says NOT CERTAIN", [one for one in cases if one.uncertain])]:
        lines += ["", f"{title}: {len(some)}"]
        if some:
            rows = [["case", "quantity", "within", "error in the FMU", "error of the answer", "uncertainty", "references apart"]]
            rows += [[one.case, one.want, *map(percent, (one.within, one.error, one.promised, one.stray, one.apart))] for one in some]
            lines += ["", *aligned(rows)]
    if failed:
        lines += ["", f"Scenes without an answer: {len(failed)}", *(line for text in failed for line in wrapped(text))]
    return "\n".join(["", "```text", *lines, "```", ""])


def wrapped(text):
    return textwrap.wrap(text, WIDTH, break_on_hyphens=False)


def shipped():
    """Times of the answers for the shipped scenes: all outputs of each to 1 %, for a long scene only of its first part."""
    rows = [["scene", "one reference run, s", "search, reference runs", "answer, s", "setting"]]
    scenes = shipped_scenes()
    for place, scene in enumerate(scenes):
        begin = time.perf_counter()
        is_long = read_scene(find(scene))["stop"] > LONGEST
        answer = accuracy(scene, set={"stop_time": LONGEST} if is_long else None, progress=lambda done, what, place=place, scene=scene:
                          say((place + min(done, 1.0)) / len(scenes), f"{scene}: {what}"))
        took = time.perf_counter() - begin
        if answer.use is None:
            setting = "none but the reference"
        else:
            setting = "not certain: runs of the reference diverge" if answer.uncertain else counted(answer.use.run.setting)
        name = f"`{scene}`, {LONGEST:g} s" if is_long else f"`{scene}`"
        rows.append([name, significant(answer.reference.seconds, 2), significant(answer.answer["spent"], 2),
                     significant(took, 2), setting])
    return markdown(rows, left=(0, 4))


def counted(setting):
    """A setting with the number of its effects instead of their names."""
    gears, _, rest = setting.partition(" with ")
    effects, _, solver = rest.partition("; ")
    number = 0 if effects == "no effect" else effects.count(",") + 1
    return f"{gears}, {number} effects; {solver}"


def main():
    fmu, folder, scenes, seed = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    if "--shipped" in sys.argv:
        tell(f"{shipped()}\n", folder / "shipped.md")
        return
    # remove the results of an earlier survey
    shutil.rmtree(folder)
    folder.mkdir()
    # the richest model has effects that do not act in a drawn scene
    warnings.simplefilter("ignore", DifferentialWarning)
    cases, failed = surveyed(fmu, folder, scenes, seed)
    with open(folder / "cases.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Case.__annotations__)
        writer.writerows([str(value).lower() if isinstance(value, bool) else value for value in vars(one).values()] for one in cases)
    tell(f"{verdict(cases, failed)}\n", folder / "survey.md")


if __name__ == "__main__":
    main()
