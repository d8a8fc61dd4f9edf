"""Proof that inactive effects cost nothing: the full build gives the same bits as a build without effects, and does no more work. Work is
arithmetic, branches and calls. Moves around them depend on the compiler, and may differ by 1 %.

usage: zero_cost.py FOLDER [EFFECT...]    also measures the cost of each of these effects when it is on"""

import sys
from pathlib import Path

from bevel_differential.text import markdown
from counting import BRANCH, COUNTED, FLOAT, executed, instructions, stepping
from tools import Finding, completed, say

SCENES = ("straight", "turn")
WORK = (FLOAT, BRANCH)
# relative tolerance of all instructions between builds of the same work, because the compiler keeps different values in registers
ARRANGEMENT = 0.01


def measured(program):
    """Bits of a run, and its instructions per communication step by kind, for each scene."""
    return {scene: (completed([program, scene, COUNTED[1]]).stdout.strip(), executed(program, scene)) for scene in SCENES}


def check(scene, off, left_out):
    """Fails if inactive effects cost more than effects that are left out of the build."""
    (bits, here), (others, there) = off, left_out
    place = f"effects that are off, {scene}"
    if bits != others:
        raise Finding(f"{place}: results change: {bits} for {others}")
    for kind in WORK:
        if here[kind] > there[kind]:
            raise Finding(f"{place}: {kind}: {here[kind]} for {there[kind]} per communication step")
    here, there = sum(here.values()), sum(there.values())
    if here > (1.0 + ARRANGEMENT) * there:
        raise Finding(f"{place}: instructions: {here} for {there} per communication step")


def main():
    folder, *effects = sys.argv[1:]
    full = stepping(folder, True, "full")
    say(0.2, "building without effects")
    less = stepping(folder, False, "less")
    say(0.4, "counting instructions")
    off, left_out = measured(full), measured(less)
    both = [left_out["turn"][1], off["turn"][1]]
    totals = [sum(counts.values()) for counts in both]
    rows = [["effect", "on", "on / off"]]
    for done, effect in enumerate(effects):
        say(0.5 + 0.5 * done / len(effects), f"counting instructions of {effect}")
        on = instructions(full, "turn", effect)
        rows.append([f"`{effect}`", f"{on:.0f}", f"{on / totals[1]:.2f}"])
    for scene in SCENES:
        check(scene, off[scene], left_out[scene])
    if not effects:
        rows = [["per communication step in the turn", "left out", "off"],
                *([kind, *(f"{counts[kind]:.1f}" for counts in both)] for kind in WORK),
                ["all instructions", *(f"{total:.1f}" for total in totals)]]
        print(f"{markdown(rows)}\nsame bits, no more work")
        return
    print(f"{markdown(rows)}\nInstructions per communication step of 1 ms in the study's turn: {totals[1]:.0f} with all off, {totals[0]:.0f} in "
          "a build without any, with the same bits. An effect that is off adds no floating-point operation, branch or call. One that is on "
          "takes more steps where it brings faster motion. Both builds test once per communication step whether `coupling_advice` is on.")


if __name__ == "__main__":
    Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
    main()
