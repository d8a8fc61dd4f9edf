"""Measurements as Markdown."""

from bevel_differential.text import markdown as table
from advice import BEGIN, WANTED
from checks import expected, observed
from masters import ALL
from measure import QUANTITIES
from parameters import STEP


def markdown(found):
    parts = [hosts(found["hosts"]), limits(found["limits"]), advice(found)]
    # errors with ideal gears are in the picture and in errors.csv
    parts.append(errors(list(found["references"])[-1], found))
    parts.append(quantities(found))
    parts.append(mesh(found["mesh"], found["limits"]))
    return "\n".join(parts)


def hosts(found):
    names = list(found["ideal"])
    rows = [[name, *(f"{found[contact][name]:.1e}" if name != "FMPy" else "0" for contact in found)] for name in names]
    return (f"Same archive (SSP 1.0 unless stated), steps of {STEP * 1e3:g} ms: largest difference from FMPy in any quantity, over its\n"
            "largest value.\n\n"
            + table([["host", *(f"`{contact}`" for contact in found)], *rows]))


def limits(found):
    rows = []
    for name, master in ALL.items():
        row = found[name]
        around = f"× {row['inside']:.2g} / × {row['outside']:.2g}" if "inside" in row else "–"
        rows.append([master.label, f"{row['predicted'] * 1e3:.2f}", measured(row), around])
    shortest = min(found[name]["predicted"] for name in ALL)
    return ("Longest communication step, ms, at which nothing grows (with rollback: repetitions converge), and what a disturbance\n"
            "becomes in 0.2 s at 0.85 / 1.15 of the prediction.\n\n"
            + table([["master", "predicted", "found", "at 0.85 / at 1.15"], *rows])
            + f"\nThe archive's step of {STEP * 1e3:g} ms is {100.0 * STEP / shortest:.0f} % of the shortest of these.\n")


def measured(row):
    """Limit that runs have shown, in ms."""
    return "–" if row.get("measured") is None else f"{row['measured'] * 1e3:.2f}"


def advice(found):
    rows = []
    for name, row in found["advice"].items():
        followed = f"{row['followed']:.1e}" if "followed" in row else "–"
        rows.append([ALL[name].label, f"{ALL[name].delay:g}", f"{row['ratio']:.1e}", f"{row['half']:.1e}", advised(row), followed,
                     f"{row['error']:.1e}"])
    contact = list(found["references"])[-1]
    return (f"`{contact}`: what the differential says of the cut (`effects.coupling_advice`) from {BEGIN:g} s on: the largest energy ratio "
            f"in steps of\n{STEP * 1e3:g} ms and of half of it, and the shortest advice for a ratio of {WANTED:g}, with the ratio in such steps. "
            "Last column: largest error of any\nquantity in steps of "
            f"{STEP * 1e3:g} ms.\n\n"
            + table([["master", "host_delay", "ratio", "half the step", "advice, ms", "ratio there", "error"], *rows]))


def advised(row):
    return f"{row['advice'] * 1e3:.2g}" if row["advice"] > 0.0 else "none"


def summary(found):
    """Limit, advice and error of each master side by side."""
    limits, rows, shown = found["limits"], found["advice"], f"in steps of {STEP * 1e3:g} ms, %"
    lines = [["longest stable step, ms: predicted", *(f"{limits[name]['predicted'] * 1e3:.2f}" for name in rows)],
             ["found", *(measured(limits[name]) for name in rows)],
             [f"advised step for an energy ratio of {100.0 * WANTED:g} %, ms", *(advised(row) for row in rows.values())],
             [f"energy ratio {shown}", *(f"{100.0 * row['ratio']:.2g}" for row in rows.values())],
             [f"largest error {shown}", *(f"{100.0 * row['error']:.2g}" for row in rows.values())]]
    return table([["drivetrain", *(ALL[name].label for name in rows)], *lines])


def errors(contact, found):
    rows = [row for row in found["errors"] if row["contact"] == contact]
    lines = []
    for step in sorted({row["step"] for row in rows}, reverse=True):
        line = [f"{step * 1e3:g}"]
        for name in ALL:
            row = next((row for row in rows if (row["step"], row["master"]) == (step, name)), None)
            line.append("–" if row is None else row["state"] if row["state"] != "ok" else error_cell(row))
        # steps with which no master succeeds, and those that not all masters use, are in the picture
        states = [row["state"] for row in rows if row["step"] == step]
        if "ok" in states and len(states) == len(ALL):
            lines.append(line)
    order = ["order"]
    theory = ["theory"]
    for name, master in ALL.items():
        own = [row for row in rows if row["master"] == name and row["state"] == "ok"]
        order.append(f"{observed(own):.2f}" if len(own) > 1 else "–")
        low, high = expected(master, found["limits"]["interpolates"])
        theory.append(f"{master.order}" if high - low < 1 else "1 to 2")
    doubt, methods = found["references"][contact].doubt, found["references"][contact].methods
    return (f"`{contact}`: largest error of any quantity by communication step, ms (in brackets: runs of a step with rollback).\n"
            f"Reference: {methods[0]} on all equations at once; {methods[1]} differs from it by {doubt:.0e}.\n\n"
            + table([["step, ms", *(master.label for master in ALL.values())], *lines, order, theory]))


def error_cell(row):
    return f"{row['largest']:.1e}" + (f" ({row['repeats']:.1f})" if ALL[row["master"]].states else "")


def quantities(found):
    contact = list(found["references"])[-1]
    rows = [row for row in found["errors"] if row["contact"] == contact and row["state"] == "ok"]
    step = max(step for step in {row["step"] for row in rows} if step <= 1.01 * max(STEP, min(row["step"] for row in rows)))
    lines = [[master.label, *(f"{row[q]:.1e}" for q in QUANTITIES), f"{row['seconds']:.1f}"]
             for name, master in ALL.items() for row in rows if (row["master"], row["step"]) == (name, step)]
    return (f"`{contact}`, steps of {step * 1e3:g} ms: largest error of each quantity over its largest value, and CPU time.\n\n"
            + table([["master", *QUANTITIES, "s"], *lines]))


def mesh(found, limits):
    fastest = found["fastest"]
    return (f"If the mesh were cut open: teeth under {found['load']:.0f} N·m have {found['swing']:.2g} rad/s undamped, and "
            f"{fastest:.2g} 1/s as fastest pole. No step\nabove 2/{fastest:.2g} s = {2e6 / fastest:.1f} µs would do, where the cut at the "
            "half-shafts allows "
            f"{limits['jacobi']['predicted'] * 1e6:.0f} µs.\n")
