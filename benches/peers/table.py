"""The results as Markdown and CSV."""

import csv

import numpy as np
from bevel_differential.text import markdown as aligned

import cases
import gears

# Project Chrono (C++, millimetres) with the exact IMPACT law, C = 50 N·s/mm, step 2e-6 s: CPU seconds per simulated
# second, straight ahead. From an earlier measurement on a machine with two cores; not run here.
CHRONO = 122.0
# more than this [deg] is a skipped tooth; half the play and the deflection of teeth are a third of a degree together
SKIPPED = 10.0
# whose cost the others are compared with
OURS = ("this program, `tooth`, `impact`", "tolerance 1e-6")
CASES = tuple(cases.CASES)
PLACES = {"cost": "CPU s per s", "ripple": "ripple peak to peak, %", "ripple_rms": "ripple rms, %",
          "speed_error": "mean speed off the gear law, %", "slip": "slip, deg", "force": "sum of normal forces, N",
          "calls": "of the cost: calls that do nothing, s per s"}


def markdown(results, machine, missing):
    head = ["tool", "setting", "CPU s per simulated s: straight", "turn", "ripple straight, %", "ripple turn, %",
            "its rms, %", "off the finest, %", "mean speed off the law, %", "slip, °: straight", "turn",
            "ΣF_n, kN: straight", "turn"]
    lines = aligned([head, *(cells(result, finest(result, results)) for result in results)], left=(0, 1))
    notes = [f"No rows of {name}: it is not installed." for name in missing]
    heel, middle, toe = statics()
    notes.append(f"Statics, T / (R sin δ_b): ΣF_n is {heel:.1f} kN with all of it at the heel, {middle:.1f} kN in the "
                 f"middle, {toe:.1f} kN at the toe.")
    return "\n".join([lines, *factors(results), "", f"Measured on {machine}.", *notes]) + "\n"


def cells(result, reference):
    straight, turn = (result["cases"][case] for case in CASES)
    row = result["row"]
    changed = "–"
    if reference is not result and turn["ripple"][0] > 1e-6:
        pairs = zip(turn["ripple"], reference["cases"]["turn"]["ripple"])
        difference = max(100.0 * abs(own / fine - 1.0) for own, fine in pairs)
        changed = significant(difference, 2) if difference >= 0.01 else "< 0.01"
    off_law = max(largest(case["speed_error"]) for case in (straight, turn))
    return [
        row.group, row.label, with_spread(straight["costs"], straight["cost"]),
        with_spread(turn["costs"], turn["cost"]), percent(max(straight["ripple"])), both(turn["ripple"]),
        both(turn["ripple_rms"]), changed, percent(off_law),
        *(f"{largest(case['slip']):.2f}" for case in (straight, turn)),
        *(f"{sum(case['force']) / 2e3:.1f}" for case in (straight, turn)),
    ]


def finest(result, results):
    """The last of the same group."""
    return [other for other in results if other["row"].group == result["row"].group][-1]


def with_spread(costs, middle):
    if len(costs) == 1:
        return significant(middle, 2)
    return f"{significant(middle, 2)} ({significant(min(costs), 2)}–{significant(max(costs), 2)})"


def significant(value, digits):
    text = f"{value:#.{digits}g}".rstrip(".")
    return text if "e" not in text else f"{value:.1g}"


def percent(value):
    return "0.00" if value < 0.005 else f"{value:.2f}"


def both(values):
    return " / ".join(percent(value) for value in values)


def largest(values):
    return max(abs(value) for value in values)


def factors(results):
    """How many times cheaper this program is than the others, case by case."""
    ours = next((r for r in results if (r["row"].group, r["row"].label) == OURS), None)
    if ours is None:
        return []
    cost = {case: ours["cases"][case]["cost"] for case in CASES}
    idle = {case: ours["cases"][case]["calls"] for case in CASES}
    head = [f"cost over that of {OURS[0]}, {OURS[1]}", "straight", "turn", "straight, net", "turn, net"]
    lines = [head]
    named = [(f"{r['row'].group}, {r['row'].label}", {case: r["cases"][case]["cost"] for case in CASES})
             for r in results if r["row"].needs and keeps_teeth(r)]
    named.append(("Project Chrono, the same law (cited, see below)", {"straight": CHRONO}))
    for name, others in named:
        gross = [times(others.get(case), cost[case]) for case in CASES]
        net = [times(others.get(case), cost[case] - idle[case]) for case in CASES]
        lines.append([name, *gross, *net])
    remark = (f"Of this program's {1e3 * cost['straight']:.1f} and {1e3 * cost['turn']:.1f} ms per simulated second, "
            f"{1e3 * idle['straight']:.1f} and {1e3 * idle['turn']:.1f} ms are Python's calls: the same loop with "
            "calls that have nothing to do. \"Net\" leaves them out.")
    return [aligned(lines), remark]


def keeps_teeth(result):
    return all(largest(case["slip"]) < SKIPPED for case in result["cases"].values())


def times(other, own):
    return "–" if other is None else f"{float(f'{other / own:.2g}'):.0f}"


def write_csv(path, results):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        names = [f"{text}{side}" for key, text in PLACES.items() for side in (sides(key))]
        writer.writerow(["tool", "setting", "case", *names, "smallest cost", "largest cost"])
        for result in results:
            for name, case in result["cases"].items():
                values = [value for key in PLACES for value in as_list(case.get(key, ""))]
                writer.writerow([result["row"].group, result["row"].label, name, *values, min(case["costs"]),
                                 max(case["costs"])])


def sides(key):
    return [""] if key in ("cost", "calls") else [" (left)", " (right)"]


def as_list(value):
    return value if isinstance(value, list) else [value]


def statics():
    """Sum of normal forces on a side gear [kN] with all of it at the heel, the middle and the toe."""
    return [cases.LOAD / (cone * np.sin(gears.SIDE.base)) / 1e3
            for cone in (gears.OUTER_CONE, gears.MEAN_CONE, gears.INNER_CONE)]
