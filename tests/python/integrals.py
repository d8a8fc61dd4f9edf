"""Integrals between outputs: angles of speeds, lengths of speeds along axes, heat of the power lost.

A communication step is taken as a whole. Then the same interval is repeated from the state at its start, in many small steps
between which the rates are read. The trapezoidal rule between the readings errs by at most the width of a step times the
variation of the rate, if the readings resolve the extremes of the rate. If they do not, as in an impact, the interval is divided
further."""

import math

import numpy as np

# smallest and largest number of readings of one communication step; each division is four times finer than the one before
FIRST, MOST = 32, 2048
# fraction of the integral of the largest rate over the whole step, above which an interval is divided further
COARSE = 0.05
# rounding of a position of many turns; resolution of the solver, in its tolerances [rad, m, J]
ROUNDING, RESOLVED = 1e-13, 1e-3
# speeds within a fixed step that does not resolve an impact, over those at its ends
OVERSHOOT = 10.0


def motions(fmu):
    """Pairs [(position, its rate)]: angle outputs with their speeds, and states of positions with their derivatives."""
    variables = fmu.variables
    states = [(name.removeprefix("der(").removesuffix(")"), name) for name in variables if name.startswith("der(")]
    states = [(name, rate) for name, rate in states if variables[name].unit in ("rad", "m")]
    outputs = [(name, name.removesuffix("angle") + "speed") for name, variable in variables.items()
               if variable.causality == "output" and name.endswith("angle")]
    return states + outputs


class Walk:
    """Steps of an initialised instance, each compared with the integrals of its rates.

    `pairs`: [(names of the quantities in a sum, name of the rate of this sum)]. `division`, s: the step size of a method with fixed
    steps, which then is the interval between readings."""

    def __init__(self, opened, pairs, tolerance, division=None):
        self.opened, self.tolerance, self.division = opened, tolerance, division
        self.places = [list(names) for names, _ in pairs]
        self.rates = [rate for _, rate in pairs]

    def now(self):
        flat = iter(self.opened.read([name for names in self.places for name in names]))
        return np.array([sum(next(flat) for _ in names) for names in self.places])

    def step(self, size):
        """Takes a step of `size`; returns [(names, gained, integral, allowed difference)] of quantities that differ."""
        one, time = self.opened, self.opened.time
        before, kept = self.now(), one.raw.getFMUstate()
        try:
            one.step(size)
            after = self.now()
            moved = one.raw.getFMUstate()
            gained, floor = after - before, ROUNDING * (np.abs(before) + np.abs(after)) + RESOLVED * self.tolerance
            for count in self.counts(size):
                one.raw.setFMUstate(kept)
                rates = self.readings(time, size, count)
                integral = size / count * (np.sum(rates, axis=0) - 0.5 * (rates[0] + rates[-1]))
                coarse = size / count * np.sum(np.abs(np.diff(rates, axis=0)), axis=0)
                resolved = np.minimum(coarse, COARSE * size * np.max(np.abs(rates), axis=0))
                allowed = (OVERSHOOT * coarse if self.division else resolved) + floor
                off = np.abs(gained - integral) > allowed
                if not np.any(off):
                    break
            one.raw.setFMUstate(moved)
            one.raw.freeFMUstate(moved)
        finally:
            one.raw.freeFMUstate(kept)
        return [(self.places[i], gained[i], integral[i], allowed[i]) for i in np.flatnonzero(off)]

    def counts(self, size):
        if self.division:
            # with other steps than those of the judged step, the motion would be different
            return [max(math.ceil(size / self.division - 1e-9), 1)]
        return [count for count in (FIRST * 4**k for k in range(8)) if count <= MOST]

    def readings(self, time, size, count):
        one, found = self.opened, [self.opened.read(self.rates)]
        for k in range(count):
            begin = time + size * k / count
            one.do_step(begin, time + size * (k + 1) / count - begin)
            found.append(one.read(self.rates))
        return np.array(found)
