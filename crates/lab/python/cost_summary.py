"""Summary of work_precision.csv: error and time of the default method by tolerance."""

from bevel_differential.records import read
from bevel_differential.text import markdown
from tools import significant

# a smaller error of speed is a rounding error
OWN, DEFAULT, AT_REST = "adaptive", 1e-6, 1e-12
# tolerances that the table leaves out
LEFT_OUT = (1e-5, 1e-7, 1e-9)


def summary(folder):
    """The table as Markdown."""
    _, rows = read(folder / "work_precision.csv")
    cases = {}
    for row in rows:
        if row["method"] == OWN:
            cases.setdefault(row["case"], {})[row["setting"]] = row
    # without cases at rest or in closed form, in which the solver makes no error at any tolerance
    solved = {case: own for case, own in cases.items()
              if any(not (good(row) and row["speed_error"] <= AT_REST) for row in own.values())}
    tolerances = [each for each in dict.fromkeys(row["setting"] for row in rows if row["method"] == OWN) if each not in LEFT_OUT]
    table = [["case", *map(short, tolerances)]]
    for case, own in solved.items():
        unit = own[DEFAULT]["cpu_s"]
        table.append([case, *(f"{short(row['speed_error'])} {short(row['force_error'])} ×{significant(row['cpu_s'] / unit, 2)}"
                              if good(row) else "failed" for row in map(own.get, tolerances))])
    return (f"{OWN}, by solver.relative_tolerance: error of speed, error of force, time × that at 1e-6:\n\n"
            f"{markdown(table, range(len(table[0])))}")


def good(row):
    return row is not None and row["status"] == "ok"


def short(value):
    return f"{value:.0e}".replace("e-0", "e-").replace("e+00", "e0")
