"""Picture of a coupling: change of a disturbance in one step, over the communication step, for each master."""

import math
from pathlib import Path

import numpy as np

from ..extras import matplotlib
from ..values import FileName
from . import Coupling
from .masters import INPUTS, LINES, MASTERS

# range of steps around the longest stable one, and number of points
BELOW, ABOVE, POINTS = 0.1, 12.0, 300
# change up to which the axis is linear, and its ends, %
LINEAR, END = 0.1, 100.0


def draw(result: Coupling, file: FileName) -> Path:
    """Draws a coupling into `file`; returns its path."""
    matplotlib("plot")
    from .. import style

    sizes = np.geomspace(BELOW * result.step, ABOVE * result.step, POINTS)
    with style.styled():
        figure, axes = style.panels(1, 1, 6.2)
        axes.axhline(0.0, color=style.INK, lw=1.0)
        for master, color in zip(MASTERS, style.CYCLE):
            for inputs in INPUTS:
                one = result.under(master, inputs)
                chosen = (master, inputs) == (result.exchange.master, result.exchange.inputs)
                axes.plot(1e3 * sizes, [100.0 * (one.growth(size) - 1.0) for size in sizes], "--" if inputs == LINES else "-", color=color,
                          lw=3.0 if chosen else 1.2, label=f"{master}, {inputs}")
                if 0.0 < one.limit < math.inf:
                    axes.plot(1e3 * one.limit, 0.0, "o", color=color, ms=9.0 if chosen else 6.0)
        if result.limit == result.step:
            axes.annotate(f"{result.limit * 1e3:.3g} ms", (result.limit * 1e3, 0.0), (-8, 8), textcoords="offset points", ha="right",
                          color=style.TEXT)
        axes.set(xscale="log", xlabel="communication step, ms", ylabel="change of a disturbance in one step, %", ylim=(-END, END),
                 xlim=(1e3 * sizes[0], 1e3 * sizes[-1]))
        axes.set_yscale("symlog", linthresh=LINEAR)
        ticks = [sign * tick for sign in (-1.0, 1.0) for tick in (0.1, 1.0, 10.0, 100.0)] + [0.0]
        axes.set_yticks(ticks, [f"{tick:+g}".replace("-", "−") if tick else "0" for tick in ticks])
        axes.minorticks_off()
        style.plain_decades(axes.xaxis)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        hosts = "; ".join(f"{host.port}: {host.words}" for host in result.exchange.hosts)
        for spelled, shown in (("N.m.s", "N·m·s"), ("N.m", "N·m"), ("kg.m2", "kg·m²")):
            hosts = hosts.replace(spelled, shown)
        style.caption(figure, "Below 0, the largest disturbance decays from step to step (spectral radius less 1). Above 0, it grows, and "
                      "the coupling is unstable. Dots: longest stable step of each master. Thick: the requested master. Solid: inputs held "
                      f"over a step; dashed: inputs on lines. {hosts}.")
        style.save(figure, file)
    return Path(file)
