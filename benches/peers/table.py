"""The results as Markdown and CSV."""

import csv

import numpy as np
from bevel_differential.text import markdown as aligned

import cases
import gears

# Project Chrono (C++, millimetres) with the exact IMPACT law, C = 50 N·s/mm, step 2e-6 s: CPU seconds per simulated second, straight ahead.
# The value is from an earlier measurement on a machine with two cores; Chrono is not run here.
CHRONO = 122.0
# a larger slip [deg] means a skipped tooth; half the play plus the deflection of teeth are a third of a degree
SKIPPED = 10.0
# row whose cost is compared with the others
OURS = ("this program, `tooth`, `impact`", "tolerance 1e-6")
CASES = tuple(cases.CASES)
CSV_COLUMNS = {"cost": "CPU s per s", "ripple": "ripple peak to peak, %", "ripple_rms": "ripple rms, %",
          "speed_error": "mean speed off the gear law, %", "slip": "slip, deg", "force": "sum of normal forces, N",
          "calls": "of the cost: calls that do nothing, s per s"}


def markdown(results, machine, missing):
    ours = next((r for r in results if (r["row"].group, r["row"].label) == OURS), None)
    head = ["tool", "setting", "s/s ahead", "s/s turn", "× ahead", "× turn", "ripple ahead", "ripple turn", "off, %", "slip, °", "ΣF_n, kN"]
    rows = [cells(result, finest(result, results), ours) for result in results]
    rows.append(["Project Chrono, same law", "cited", f"{CHRONO:.0f}", "–", over_net({"straight": CHRONO}, ours, "straight"), *6 * "–"])
    lines = aligned([head, *rows], left=(0, 1))
    off_law = max(largest(case["speed_error"]) for result in results for case in result["cases"].values())
    heel, middle, toe = statics()
    notes = [f"s/s: CPU s per simulated s, and × that of this program. Mean speeds are within {percent(off_law)} % of the gear law. {calls(ours)}",
             f"Statics, T / (R sin δ_b): ΣF_n is {heel:.1f} kN with all of it at the heel, {middle:.1f} kN in the "
             f"middle, {toe:.1f} kN at the toe.", *(f"No rows of {name}: it is not installed." for name in missing)]
    return "\n".join([lines, *notes, f"Measured on {machine}."]) + "\n"


def calls(ours):
    """Share of Python's calls in this program's cost, as a sentence."""
    if ours is None:
        return ""
    cost, idle = ([1e3 * ours["cases"][case][key] for case in CASES] for key in ("cost", "calls"))
    return (f"Of the {cost[0]:.1f} and {cost[1]:.1f} ms of {OURS[0]}, {OURS[1]}, {idle[0]:.1f} and {idle[1]:.1f} ms are Python's calls, "
            "which × leaves out.")


def cells(result, reference, ours):
    straight, turn = (result["cases"][case] for case in CASES)
    row = result["row"]
    changed = "–"
    if reference is not result and turn["ripple"][0] > 1e-6:
        pairs = zip(turn["ripple"], reference["cases"]["turn"]["ripple"])
        difference = max(100.0 * abs(own / fine - 1.0) for own, fine in pairs)
        changed = significant(difference, 2) if difference >= 0.01 else "< 0.01"
    other = {case: result["cases"][case]["cost"] for case in CASES} if row.needs and keeps_teeth(result) else {}
    return [row.group, row.label, *(significant(case["cost"], 2) for case in (straight, turn)), *(over_net(other, ours, case) for case in CASES),
            percent(max(straight["ripple"])), both(turn["ripple"]), changed, f"{max(largest(case['slip']) for case in (straight, turn)):.2f}",
            f"{sum(turn['force']) / 2e3:.1f}"]


def over_net(costs, ours, case):
    """A cost divided by that of this program without Python's calls."""
    if ours is None or case not in costs:
        return "–"
    net = ours["cases"][case]["cost"] - ours["cases"][case]["calls"]
    return f"{float(f'{costs[case] / net:.2g}'):.0f}"


def finest(result, results):
    """Last result of the same group."""
    return [other for other in results if other["row"].group == result["row"].group][-1]


def significant(value, digits):
    text = f"{value:#.{digits}g}".rstrip(".")
    return text if "e" not in text else f"{value:.1g}"


def percent(value):
    return "0.00" if value < 0.005 else f"{value:.2f}"


def both(values):
    return " / ".join(percent(value) for value in values)


def largest(values):
    return max(abs(value) for value in values)


def keeps_teeth(result):
    return all(largest(case["slip"]) < SKIPPED for case in result["cases"].values())


def write_csv(path, results):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        names = [f"{text}{side}" for key, text in CSV_COLUMNS.items() for side in (sides(key))]
        writer.writerow(["tool", "setting", "case", *names, "smallest cost", "largest cost"])
        for result in results:
            for name, case in result["cases"].items():
                values = [value for key in CSV_COLUMNS for value in as_list(case.get(key, ""))]
                writer.writerow([result["row"].group, result["row"].label, name, *values, min(case["costs"]),
                                 max(case["costs"])])


def sides(key):
    return [""] if key in ("cost", "calls") else [" (left)", " (right)"]


def as_list(value):
    return value if isinstance(value, list) else [value]


def statics():
    """Sum of normal forces on a side gear [kN] if all of it acts at the heel, the middle or the toe."""
    return [cases.LOAD / (cone * np.sin(gears.SIDE.base)) / 1e3
            for cone in (gears.OUTER_CONE, gears.MEAN_CONE, gears.INNER_CONE)]
