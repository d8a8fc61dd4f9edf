"""Picture of a coupling: change of a disturbance in one step, over the communication step, for each master."""

import math
from pathlib import Path

import numpy as np

from ..panel import CYCLE, INK, TEXT, Axis, Mark, Panel, curve, picture
from ..values import FileName
from . import Coupling
from .masters import INPUTS, LINES, MASTERS

# range of steps around the longest stable one, and number of points
BELOW, ABOVE, POINTS = 0.1, 12.0, 300
# change up to which the axis is linear, and its ends, %
LINEAR, END = 0.1, 100.0


def draw(result: Coupling, file: FileName) -> Path:
    """Draws a coupling into `file`; returns its path."""
    panel = Panel(Axis("communication step, ms", lambda steps: 1e3 * steps), "change of a disturbance in one step, %", _marks(result),
                  legend="right", xscale="log", ylim=(-END, END), xlim=(1e3 * BELOW * result.step, 1e3 * ABOVE * result.step))
    hosts = "; ".join(f"{host.port}: {host.words}" for host in result.exchange.hosts)
    picture([[panel]], "Below 0, the largest disturbance decays from step to step (spectral radius less 1). Above 0, it grows, and "
            "the coupling is unstable. Dots: longest stable step of each master. Thick: the requested master. Solid: inputs held "
            f"over a step; dashed: inputs on lines. {hosts}.", file, 6.2)
    return Path(file)


def _marks(result):
    sizes = np.geomspace(BELOW * result.step, ABOVE * result.step, POINTS)
    yield Mark("axhline", 0.0, color=INK, lw=1.0)
    for master, colour in zip(MASTERS, CYCLE):
        for inputs in INPUTS:
            one = result.under(master, inputs)
            is_chosen = (master, inputs) == (result.exchange.master, result.exchange.inputs)
            yield curve(sizes, [100.0 * (one.growth(size) - 1.0) for size in sizes], f"{master}, {inputs}", colour,
                        "--" if inputs == LINES else "-", lw=3.0 if is_chosen else 1.2)
            if 0.0 < one.limit < math.inf:
                yield curve(one.limit, 0.0, None, colour, "o", ms=9.0 if is_chosen else 6.0)
    if result.limit == result.step:
        yield Mark("annotate", f"{result.limit * 1e3:.3g} ms", (result.limit * 1e3, 0.0), (-8, 8), textcoords="offset points", ha="right",
                   color=TEXT)
    yield Mark("set_yscale", "symlog", linthresh=LINEAR)
    ticks = [sign * tick for sign in (-1.0, 1.0) for tick in (0.1, 1.0, 10.0, 100.0)] + [0.0]
    yield Mark("set_yticks", ticks, [f"{tick:+g}".replace("-", "−") if tick else "0" for tick in ticks])
    yield Mark("minorticks_off")
