"""Report of a map: one HTML file with the map, its error, and the meaning of the columns of its tables."""

import itertools
from pathlib import Path

import numpy as np

from ..readable import printed
from ..report import head, words
from ..report.blocks import Section, Table, Text
from ..report.write import need, page
from ..values import FileName
from ..writing import write_whole
from . import MeasuredMap, figures, inputs
from .axes import axes as axes_of
from .figures import largest, warmth_text
from .grid import GOAL, share_beyond
from .loss_map import MAPPED, SIGNS
from .point import AXES as DRIVEN, PointTask
from .tables import BETWEEN, MEANINGS, bias

# number of unseen points that are listed
WORST = 10
AXES = ("carrier torque", "carrier speed", "difference of the wheels' speeds", "temperature of oil and surfaces")


def write(result: MeasuredMap, file: FileName) -> Path:
    """Writes the report of a map completely, or not at all; returns its path. Runs the corners of the map again for the FMU's warnings."""
    need()
    sections = [_head(result), _loss(result), _bias(result), _error(result), _setup(result), _columns()]
    write_whole(file, page(f"Loss map of {result.scene.name}", result.scene.description, sections))
    return Path(file)


def accuracy(result: MeasuredMap) -> str:
    """Measured error as a sentence of the report."""
    return f"{printed(result.error)}."


def _head(result):
    found = Section("head", "The map and its error")
    verdict = accuracy(result)
    if len(result.unseen):
        share = words.percent(share_beyond(len(result.unseen), result.beyond), 2)
        verdict += (f" In words: had all points between the ends of the axes been run, at most {share} of them would miss the map by "
                    "more than the bound; such a sentence is true in 95 of 100 cases.")
    found.add(Text(verdict, "verdict", result.beyond == 0 if len(result.unseen) else None))
    found.say(f"The bound is {words.percent(result.bound.part)} of the value and {words.quantity(result.bound.torque, 'N.m')} on top, "
              "for the torque of each wheel. For the loss this torque acts at the speed of the carrier and half the difference.")
    if result.estimate > GOAL:
        found.add(Text(f"The map stops at its maximum number of points. Leaving lines out shows errors of "
                       f"{words.number(result.estimate, 2)} times the bound. Allow more by --most.", "warning"))
    if result.restless:
        found.add(Text(f"{result.restless} points do not settle: they have the means of their last cycles.", "warning"))
    found.add(*(Text(f"The FMU warns: {text}", "warning") for text in _warnings(result)))
    size = result.slipping[0, ..., 0].size
    runs = f"{result.new} new runs in {words.quantity(result.seconds, 's', 3)}" if result.new else "no new runs: all were kept from before"
    found.add(Table(("", ""), [
        *head.program(result.scene.fmu),
        ("model", f"{result.model}: chosen by accuracy in the middle of the map" if result.model else "the scene's own"),
        ("points", f"{words.number(size)} in each direction of the difference, {result.stuck[..., 0].size} without one, "
                   f"{len(result.unseen)} unseen"),
        ("took", runs)], "Program, model and work. Times were measured on the machine that made the map."))
    rows = [(name, *(_shown(result, axis, end, 5) for end in (line[0], line[-1])), str(len(line)),
             ", ".join(words.number(_value(result, axis, at), 5) for at in line)) for axis, (name, line) in enumerate(zip(AXES, result.lines))]
    found.add(Table(("axis", "from", "to", "lines", "at"), rows,
                    "Axes of the map. Each difference runs with the left and with the right wheel faster. Lines are closer where the map "
                    "has more curvature.",
                    left=5))
    return found


def _value(result, axis, at):
    return float(axes_of(result.scene)[axis].values(at))


def _shown(result, axis, at, digits=4):
    return axes_of(result.scene)[axis].text(at, digits)


def _warnings(result):
    """Warnings of the FMU at the corners of the map, where torques, speeds and temperatures are extreme: the first of each variable."""
    corners = list(itertools.product(*({line[0], line[-1]} for line in result.lines)))
    task, found, count = PointTask(result.scene), {}, {}
    for torque, speed, difference, temperature in corners:
        for sign in SIGNS:
            told = {text.partition(": ")[0]: text for text in task.warnings(inputs((torque, speed, sign * difference, temperature)))}
            for name, text in told.items():
                found.setdefault(name, text)
                count[name] = count.get(name, 0) + 1
    task.close()
    total = len(corners) * len(SIGNS)
    return [f"{text} (at {'all' if count[name] == total else count[name]} of the {total} corners of the map)"
            for name, text in found.items()]


def _loss(result):
    found = Section("loss", "Power loss")
    if figures.alike(result) and len(result.lines[3]) > 1:
        found.say("Temperature changes nothing: the scene has no friction and no drag that depend on it. Pictures show one temperature "
                  "for all.")
    picture = figures.loss_map(result)
    if picture is None:
        found.say("Torque or speed has a single value, so that there is no map over both.")
    else:
        found.add(picture)
    found.add(figures.over_difference(result), _loss_table(result))
    return found


def _loss_table(result):
    at, where = _far_end(result)
    rows = []
    for temperature, left, right, stuck in at:
        # a small remainder is rounding
        rest = stuck[2] if abs(stuck[2]) > figures.NOTHING * abs(left[2]) else 0.0
        rows.append((warmth_text(result, temperature), *(words.number(loss) for loss in (left[2], right[2], rest))))
    return Table(("oil", "left wheel faster, W", "right wheel faster, W", "no difference, W"), rows, f"Power loss at {where}.")


def _bias_table(result):
    unit = axes_of(result.scene)[0].unit
    at, where = _far_end(result)
    rows = []
    for temperature, left, right, stuck in at:
        total = stuck[0] + stuck[1]
        rows.append((warmth_text(result, temperature), *(_ratio(*each[:2]) for each in (left, right)),
                     *(_ratio(end, total - end) for end in stuck[3:5]), *(words.number(_value(result, 0, end)) for end in stuck[3:5])))
    return Table(("oil", "TBR, left faster", "right faster", "left breaks loose", "right breaks loose", f"stuck from T_left, {unit}",
                  f"to, {unit}"), rows,
                 f"Torque bias ratios at {where}; ratios at which the stuck differential breaks loose at the same torque and speed, and "
                 "the left torques between which it stays stuck.")


def _far_end(result):
    """Rows of the map, by temperature, at the largest torque, speed and difference, and the text of this point."""
    torque, speed = (largest(result.lines[axis]) for axis in (0, 1))
    where = ", ".join(_shown(result, axis, result.lines[axis][index]) for axis, index in ((0, torque), (1, speed), (2, -1)))
    return [(temperature, *(values[torque, speed, -1, warmth] for values in result.slipping), result.stuck[torque, speed, 0, warmth])
            for warmth, temperature in enumerate(result.lines[3])], f"{where} of difference (rows of the map's table)"


def _ratio(left, right):
    found = bias(left, right)[0]
    return "none" if found is None else words.number(found)


def _bias(result):
    found = Section("bias", "Torque bias")
    found.add(figures.ratio(result), figures.stuck(result), _bias_table(result))
    return found


def _error(result):
    found = Section("error", "Measured error")
    found.say(accuracy(result))
    if not len(result.unseen):
        return found
    found.add(figures.error(result))
    at, rows = result.at(result.unseen), []
    for index in np.argsort(-result.errors.max(axis=1), kind="stable")[:WORST]:
        point, errors = result.unseen[index], result.errors[index]
        # two torques and a loss, which is always in W
        pairs = [" / ".join(words.number(_value(result, 0, found[index, k]) if k < 2 else found[index, k]) for found in (result.found, at))
                 for k in range(MAPPED)]
        rows.append((figures.ERRED[int(np.argmax(errors))], words.number(errors.max(), 3),
                     *(words.number(_value(result, axis, value)) for axis, value in enumerate(point)), *pairs))
    torque, speed, slip, warmth = (axis.unit for axis in axes_of(result.scene))
    found.add(Table(("worst in", "error", f"torque, {torque}", f"speed, {speed}", f"difference, {slip}", f"oil, {warmth}",
                     f"T_left, {torque}", f"T_right, {torque}", "loss, W"), rows,
                    f"The {len(rows)} worst of {len(result.unseen)} unseen points: the largest error over the bound, the point, and what "
                    "its run gave / what the map says. "
                    "A positive difference: the left wheel is faster.", left=1))
    return found


def _setup(result):
    found = Section("setup", "Scene on the bench")
    middle = inputs([line[len(line) // 2] for line in result.lines])
    found.say("The bench drives the carrier by torque and both wheels by speed, without the scene's changes over time; half-shafts are "
              "damped, which leaves their mean torques as they are, and all surfaces have the temperature of the oil. A point runs until "
              "its means over whole mesh cycles settle.")
    found.say(f"The FMU says that it simulates: {result.scene.plan_text(middle)}.")
    found.add(head.values(result.scene, DRIVEN))
    return found


def _columns():
    found = Section("columns", "Columns of the table")
    found.add(Table(("column", "meaning"), list(MEANINGS.items()), "Columns that --csv writes, as CSV or Parquet, in SI.", left=2))
    found.say(f"Tables are linear in torques, not in powers: {BETWEEN}.")
    return found
