"""Compares the most expensive communication step of the fixed-step method with the median one, in instructions.

usage: real_time.py FOLDER BUILD [--quick]    FOLDER is emptied; the program is built in BUILD; quick leaves out the shortest steps"""

import shutil
import statistics
import sys
from pathlib import Path

from bevel_differential.text import markdown
import real_time_sources
from counting import callgrind, counts, stepping
from tools import Finding, say

# scenes with options, as named by the stepping program
SCENES = (("straight",), ("turn", "rolling", "reversal"))
# step sizes of the method [s], and the number of communication steps of 1 ms
SIZES, STEPS = ("1e-3", "1e-4", "1e-5"), "300"
# maximum ratio of the most expensive step to the median one
MOST = 2.0


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
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            callgrind(program, [scene, STEPS, "unread", f"fixed_step={size}", *options],
                      ["--dump-after=*one_communication_step*"], folder / "count")
            found = counts(folder)
            median, most = statistics.median(found), max(found)
            worst = max(worst, most / median)
            rows.append([name, size, f"{median:.0f}", str(most), f"{most / median:.2f}"])
    remark = real_time_sources.REMARK
    if real_time_sources.UNIT.is_file():
        found, remark = real_time_sources.rows(folder.with_name("real-time-sources"))
        for name, size, median, most in found:
            worst = max(worst, most / median)
            rows.append([name, size, f"{median:.0f}", str(most), f"{most / median:.2f}"])
    text = f"{markdown(rows)}\nInstructions of a communication step of 1 ms, {STEPS} steps each. {remark}"
    if worst > MOST:
        raise Finding(f"{text}\nthe costliest step costs {worst:.2f} times the median one, more than {MOST:g}")
    print(text, end="")


if __name__ == "__main__":
    main()
