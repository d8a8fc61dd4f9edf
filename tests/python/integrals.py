"""What outputs must be the integral of what: angles of speeds, lengths of speeds along axes, heat of the power lost.

A communication step is taken whole, and the same interval again, from the state at its beginning, in many small steps between
which the rates are read. Trapezia between the readings are off by at most the step's width times the variation of the rate, where
the readings catch its turns. Where they do not, as in a blow, the interval is divided further."""

import math

import numpy as np

# readings of one communication step: at first, and at most; each division is four times finer than the one before
FIRST, MOST = 32, 2048
# share of what the largest rate would give in the whole step, beyond which an interval is divided further
COARSE = 0.05
# of a position of many turns; and what the solver resolves, in its tolerances [rad, m, J]
ROUNDING, RESOLVED = 1e-13, 1e-3
# speeds within a step of fixed size that does not resolve a blow, over those at its ends
OVERSHOOT = 10.0


def motions(fmu):
    """[(position, its rate)]: outputs of an angle with their speed, and the states of positions with their derivative."""
    variables = fmu.variables
    states = [(name.removeprefix("der(").removesuffix(")"), name) for name in variables if name.startswith("der(")]
    states = [(name, rate) for name, rate in states if variables[name].unit in ("rad", "m")]
    outputs = [(name, name.removesuffix("angle") + "speed") for name, variable in variables.items()
               if variable.causality == "output" and name.endswith("angle")]
    return states + outputs


class Walk:
    """Steps of an initialised instance, each compared with the integrals of its rates.

    `pairs`: [(names of quantities, whose sum it is; name of the rate)]. `division`: s, the longest step where the method has steps
    of fixed size, which then are those between the readings."""

    def __init__(self, opened, pairs, tolerance, division=None):
        self.opened, self.tolerance, self.division = opened, tolerance, division
        self.places = [list(names) for names, _ in pairs]
        self.rates = [rate for _, rate in pairs]

    def now(self):
        flat = iter(self.opened.read([name for names in self.places for name in names]))
        return np.array([sum(next(flat) for _ in names) for names in self.places])

    def step(self, size):
        """Takes a step of `size`; returns [(names, gained, integral, by how much these may differ)] of what differs."""
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
            # other steps than those of the step that is judged would be another motion
            return [max(math.ceil(size / self.division - 1e-9), 1)]
        return [count for count in (FIRST * 4**k for k in range(8)) if count <= MOST]

    def readings(self, time, size, count):
        one, found = self.opened, [self.opened.read(self.rates)]
        for k in range(count):
            begin = time + size * k / count
            one.do_step(begin, time + size * (k + 1) / count - begin)
            found.append(one.read(self.rates))
        return np.array(found)
