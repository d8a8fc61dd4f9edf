"""Compares the most expensive communication step of the fixed-step method with the median one, in instructions, and measures the steps
of each level of gear contact and law. Instructions do not depend on the load of the machine. Times are the shortest of many runs.

usage: real_time.py FOLDER BUILD [--quick]    FOLDER is emptied; the program is built in BUILD; quick leaves out the shortest steps and
the levels"""

import shutil
import statistics
import sys
from pathlib import Path

from bevel_differential.text import markdown
import real_time_sources
from counting import callgrind, counts, stepping
from tools import Finding, completed, machine, say

# scenes with options, as named by the stepping program
SCENES = (("straight",), ("turn", "rolling", "reversal"))
# step sizes of the method [s], and the number of communication steps of 1 ms
SIZES, STEPS = ("1e-3", "1e-4", "1e-5"), "300"
# levels of gear contact and laws, in the last scene, and the step sizes [s] for them
LEVELS = (("`ideal`", "scene.gear_contact=1"), ("`lumped`", "scene.gear_contact=2"), ("`tooth`, `impact`",), ("`tooth`, `line`", "line"),
          ("`tooth`, `line_weber`", "line_weber"))
LEVEL_SIZES = ("1e-3", "1e-4")
# steps of a run whose time is measured, and number of such runs: short ones, so that some of them are not interrupted
TIMED, RUNS = "20", 40
# maximum ratio of the most expensive step to the median one
MOST = 2.0


def counted(program, folder, size, scene, *options):
    """Median and largest number of instructions of a communication step."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    callgrind(program, [scene, STEPS, "unread", f"fixed_step={size}", *options], ["--dump-after=*one_communication_step*"], folder / "count")
    found = counts(folder)
    return statistics.median(found), max(found)


def microseconds(program, size, scene, *options):
    """Shortest mean time of a communication step, in µs."""
    words = [program, scene, TIMED, "unread", "counts", f"fixed_step={size}", *options]
    return min(1e6 * float(completed(words).stdout.split()[3]) / int(TIMED) for _ in range(RUNS))


def levels(program, folder):
    """Table of the steps of each level and law, and the largest ratio of the most expensive step to the median one."""
    scene, *options = SCENES[-1]
    rows, worst = [["gears", *(f"{what}, {size} s" for size in LEVEL_SIZES for what in ("µs", "instructions")), "costliest / median"]], 0.0
    for place, (name, *level) in enumerate(LEVELS):
        say(place / len(LEVELS), f"counting {name}")
        found = [(microseconds(program, size, scene, *options, *level), *counted(program, folder, size, scene, *options, *level))
                 for size in LEVEL_SIZES]
        ratio = max(most / median for _, median, most in found)
        worst = max(worst, ratio)
        rows.append([name, *(text for time, median, _ in found for text in (f"{time:.2g}", f"{median:.0f}")), f"{ratio:.2f}"])
    return f"{markdown(rows)}\nMeasured on {machine()}.\n", worst


def main():
    folder, build = map(Path, sys.argv[1:3])
    sizes = SIZES[:-1] if sys.argv[3:] else SIZES
    build.mkdir(parents=True, exist_ok=True)
    program, worst = stepping(build, True, "full"), 0.0
    rows = [["scene", "`solver.fixed_step`, s", "median", "costliest", "costliest / median"]]
    for scene, *options in SCENES:
        for size in sizes:
            name = ", ".join([scene, *options])
            say((len(rows) - 1) / (len(SCENES) * len(sizes)), f"counting {name}, steps of {size} s")
            median, most = counted(program, folder, size, scene, *options)
            worst = max(worst, most / median)
            rows.append([name, size, f"{median:.0f}", str(most), f"{most / median:.2f}"])
    remark = real_time_sources.REMARK
    if real_time_sources.UNIT.is_file():
        found, remark = real_time_sources.rows(folder.with_name("real-time-sources"))
        for name, size, median, most in found:
            worst = max(worst, most / median)
            rows.append([name, size, f"{median:.0f}", str(most), f"{most / median:.2f}"])
    if not sys.argv[3:]:
        table, of_levels = levels(program, folder)
        worst = max(worst, of_levels)
        (folder / "levels.md").write_text(table, encoding="utf-8")
    text = f"{markdown(rows)}\nInstructions of a communication step of 1 ms, {STEPS} steps each. {remark}"
    if worst > MOST:
        raise Finding(f"{text}\nthe costliest step costs {worst:.2f} times the median one, more than {MOST:g}")
    print(text, end="")


if __name__ == "__main__":
    main()
