"""Checks of the measurements against theory; no expected value comes from a run."""

import numpy as np

import masters
from advice import WANTED
from measure import INSIDE

# largest allowed difference between two runs of the same method: rounding, amplified by a stiff solver at 1e-10
SAME = 1e-8
# largest allowed difference of a method's order from theory
BAND = 0.25
# largest allowed difference of an energy ratio's order, and factor between the ratio in advised steps and the wanted one
ORDER, FOLLOWED = 0.2, 1.5
# largest allowed difference between two methods of scipy on the reference
DOUBT = 1e-6


def wrong(found):
    """Messages about all measurements that contradict theory."""
    problems = []
    for contact, rows in found["hosts"].items():
        problems += [f"{contact}: {name} differs from FMPy by {value:.1e}, more than {SAME:g}"
                     for name, value in rows.items() if not value < SAME]
    for contact, right in found["references"].items():
        if not right.doubt < DOUBT:
            problems.append(f"{contact}: {' and '.join(right.methods)} differ by {right.doubt:.1e} on the reference")
    problems += advice_wrong(found["advice"])
    limits = found["limits"]
    for name, master in masters.ALL.items():
        row = limits[name]
        if not master.states and not row["inside"] < 1.0 < row["outside"]:
            problems.append(f"{name}: a disturbance grows by {row['inside']:.2g} inside the predicted limit of "
                            f"{row['predicted']:.2e} s and by {row['outside']:.2g} outside")
        for contact in found["references"]:
            rows = [row for row in found["errors"] if (row["contact"], row["master"]) == (contact, name)]
            problems += errors_wrong(contact, master, rows, limits)
    return problems


def advice_wrong(rows):
    """Messages about the energy ratios. Gauss-Seidel with held inputs has none, because each spring gets the mean of its torque."""
    problems = []
    for name, row in rows.items():
        master = masters.ALL[name]
        if master.delay == -0.5:
            problems += [f"{name}: energy ratio {row['ratio']:.1e}, expected 0"] if row["ratio"] > 0.0 else []
            continue
        order = np.log2(row["ratio"] / row["half"])
        if not abs(order - master.order) < ORDER:
            problems.append(f"{name}: the energy ratio has the order {order:.2f}, expected {master.order}")
        if "followed" in row and not WANTED / FOLLOWED < row["followed"] < WANTED * FOLLOWED:
            problems.append(f"{name}: steps of {row['advice']:.2e} s have the energy ratio {row['followed']:.1e}, expected {WANTED:g}")
    return problems


def errors_wrong(contact, master, rows, limits):
    """Messages about one master. A held input is late by at most one step, so errors must stay below frequency times step.
    Orders must be those of theory."""
    problems, good = [], [row for row in rows if row["state"] == "ok"]
    for row in good:
        bound = limits["frequency"] * row["step"]
        if row["step"] < INSIDE * limits[row["master"]]["predicted"] and not row["largest"] < bound:
            problems.append(f"{contact}, {row['master']}, {row['step']:g} s: error {row['largest']:.1e}, above {bound:.1e}")
    low, high = expected(master, limits["interpolates"])
    if len(good) < 2 or not low < observed(good) < high:
        order = f"{observed(good):.2f}" if len(good) > 1 else "unknown"
        problems.append(f"{contact}, {master.label}: order {order}, expected {low} to {high}")
    return problems


def expected(master, interpolates):
    """Allowed range of the order. Masters with inputs on lines have order 2 if all parts follow lines, otherwise between 1 and 2."""
    return (1.0 if master.order == 2 and not interpolates else master.order) - BAND, master.order + BAND


def observed(rows):
    """Order between the two shortest steps."""
    coarse, fine = sorted((row for row in rows if row["state"] == "ok"), key=lambda row: -row["step"])[-2:]
    return np.log(coarse["largest"] / fine["largest"]) / np.log(coarse["step"] / fine["step"])
