"""The summary of work_precision.csv: error and time by tolerance, and the cheapest method for an accuracy."""

from bevel_differential.records import read
from bevel_differential.text import markdown
from tools import significant

# errors of speed in the table of cheapest methods; an error below AT_REST is rounding
WANTED, AT_REST = (1e-3, 1e-6, 1e-9), 1e-12
OWN, DEFAULT = "adaptive", 1e-6
# tolerances of the file that the table leaves out
LEFT_OUT = (1e-5, 1e-7, 1e-9)


def summary(folder):
    """Both tables, as Markdown."""
    _, rows = read(folder / "work_precision.csv")
    cases = {}
    for row in rows:
        cases.setdefault(row["case"], []).append(row)
    # without cases at rest or in closed form: the solver makes no error there, whatever the tolerance
    solved = {case: own for case, own in cases.items()
              if any(row["method"] == OWN and not (good(row) and row["speed_error"] <= AT_REST) for row in own)}
    tolerances = [each for each in dict.fromkeys(row["setting"] for row in rows if row["method"] == OWN) if each not in LEFT_OUT]
    by_tolerance, cheapest = [["case", *map(short, tolerances)]], [["case", *(f"≤{short(wanted)}" for wanted in WANTED)]]
    for case, own in solved.items():
        of_own = {row["setting"]: row for row in own if row["method"] == OWN}
        unit = of_own[DEFAULT]["cpu_s"]
        cells = [f"{short(row['speed_error'])} {short(row['force_error'])} ×{two(row['cpu_s'] / unit)}" if good(row) else "failed"
                 for row in map(of_own.get, tolerances)]
        by_tolerance.append([case, *cells])
        cheapest.append([case, *(_cheapest(own, wanted, unit) for wanted in WANTED)])
    left = range(len(by_tolerance[0]))
    return (f"{OWN}, by solver.relative_tolerance: error of speed, error of force, time × that at 1e-6:\n\n"
            f"{markdown(by_tolerance, left)}\n"
            "cheapest method within each error of speed: method, tolerance or step, time × that of the default:\n\n"
            f"{markdown(cheapest, left)}")


def _cheapest(rows, wanted, unit):
    """The cheapest method with an error of speed of at most `wanted` and its time over `unit`; beside it the default method."""
    found = sorted((row for row in rows if good(row) and row["speed_error"] <= wanted), key=lambda row: row["cpu_s"])
    if not found:
        return "none"
    best, own = found[0], next((row for row in found if row["method"] == OWN), None)
    step = " s" if best["method"] == "fixed_step" else ""
    text = f"{best['method']} {short(best['setting'])}{step} ×{two(best['cpu_s'] / unit)}"
    if own is best:
        return text
    return f"{text} (adaptive{f' ×' + two(own['cpu_s'] / unit) if own else ': none'})"


def good(row):
    return row is not None and row["status"] == "ok"


def short(value):
    return f"{value:.0e}".replace("e-0", "e-").replace("e+00", "e0")


def two(value):
    return significant(value, 2)
