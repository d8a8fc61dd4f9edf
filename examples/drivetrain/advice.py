"""Advice of the differential about the communication step (`effects.coupling_advice`), under each master."""

import numpy as np

import masters
from measure import GRID, difference, progress
from parameters import END, STEP
from slaves import System

OUTPUTS = ["coupling.energy_ratio", "coupling.step_advice"]
# ratio at which the advised step aims: the FMU's start value
WANTED = 0.01
# largest relative difference between equal steps
ROUNDING = 1e-9
# sums cover a few periods of the half-shafts from this time on [s]
BEGIN = 0.1


def advice(fmus, contact, right):
    """A row for each master that answers at communication points: largest energy ratio and shortest advice in steps of the SSP, the
    largest error of the same run, the ratio in steps of half the size, and the ratio in advised steps, where they are shorter."""
    rows = {}
    for name, master in masters.ALL.items():
        if master.delay is None:
            continue
        progress(0.25, f"{contact}: advice under {master.label}")
        seen, found = run(fmus, contact, master, STEP)
        ratio, advised = np.max(seen[:, 0]), np.min(seen[:, 1])
        row = {"ratio": ratio, "advice": advised, "half": np.max(run(fmus, contact, master, 0.5 * STEP)[0][:, 0]),
               "error": max(difference(right.signals, found, right.rows[:len(found)]).values())}
        # the differential computes its step from rounded times
        if 0.0 < advised < (1.0 - ROUNDING) * STEP:
            row["followed"] = np.max(run(fmus, contact, master, END / np.ceil(END / advised))[0][:, 0])
        rows[name] = row
    return rows


def run(fmus, contact, master, step):
    """Ratio and advice after each step from `BEGIN` on, and all outputs of the system at the points of the grid, if steps meet them."""
    changes = {("differential", "effects.coupling_advice"): 1, ("differential", "coupling.host_delay"): master.delay}
    seen = []
    with System.of_fmus(fmus, contact, changes) as system:
        differential = system.part("differential")
        given = differential.variables(OUTPUTS)
        rows = masters.run(system, master(), step, round(END / step), round(GRID / step),
                           lambda: seen.append(given.get(differential.instance)))
    return np.array(seen)[round(BEGIN / step):], rows
