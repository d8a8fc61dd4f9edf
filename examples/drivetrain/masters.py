"""Co-simulation masters, each a function that takes a system over one communication step.

    step(system, time, size, y, before) → y at the end of the step

y are all outputs at the begin of the step, `before` those one step earlier. All of a part's inputs act from the begin
of the step, held or on a line.
"""

import numpy as np

# iterations stop when outputs change by less than this, relative to the largest of their kind so far
CONVERGED = 1e-8
FLOOR = 1e-3
MOST = 60
# outputs beyond this have run away, whatever their unit (SI)
BOUND = 1e7


class NoConvergence(Exception):
    """The iteration of a step does not converge."""


class Jacobi:
    """All parts at once, inputs held at the values of the begin: what plain hosts do."""

    label, order, states = "Jacobi, held", 1, False

    def step(self, system, time, size, y, before):
        for part, feeds in zip(system.parts, system.feeds):
            part.step(time, size, y[feeds])
        return system.read()


class GaussSeidel:
    """One part after the other; each is fed with what those before it have reached by the end of the step."""

    label, order, states = "Gauss-Seidel, held", 1, False

    def step(self, system, time, size, y, before):
        y = y.copy()
        for part, feeds, gives in zip(system.parts, system.feeds, system.gives):
            part.step(time, size, y[feeds])
            y[gives] = part.read()
        return y


class Lines:
    """All parts at once, inputs go on along the line through the last two communication points."""

    label, order, states = "Jacobi, lines", 2, False

    def step(self, system, time, size, y, before):
        slope = (y - before) / size
        for part, feeds in zip(system.parts, system.feeds):
            part.step(time, size, y[feeds], slope[feeds])
        # what comes straight from inputs to outputs sees their values at the end
        system.put(y + size * slope)
        return system.read()


class IteratedHeld:
    """The step again and again from its begin, with inputs held at what the last time gave for the end."""

    label, order, states = "rollback, held", 1, True
    lines = False

    def __init__(self):
        self.largest, self.iterations = FLOOR, []

    def step(self, system, time, size, y, before):
        saved = system.save()
        # from where the last step was heading
        guess, count = 2.0 * y - before, 0
        while True:
            count += 1
            found = self.again(system, time, size, y, guess)
            change = np.max(np.abs(found - guess) / self.largest)
            if change < CONVERGED:
                break
            if count == MOST or not np.all(np.abs(found) < BOUND):
                system.drop(saved)
                raise NoConvergence(f"changes by {change:.1e} after {count} iterations at {time:.4g} s")
            guess = found
            system.restore(saved)
        system.drop(saved)
        self.iterations.append(count)
        self.largest = np.maximum(self.largest, np.abs(found))
        return found

    def again(self, system, time, size, y, guess):
        """Outputs at the end if inputs are what `guess` makes of them. One part after the other, with what those before
        have just given: the same in the end as all at once, in fewer rounds."""
        found = guess.copy()
        for part, feeds, gives in zip(system.parts, system.feeds, system.gives):
            if self.lines:
                part.step(time, size, y[feeds], (found - y)[feeds] / size)
                part.put(found[feeds])
            else:
                part.step(time, size, found[feeds])
            found[gives] = part.read()
        return found


class IteratedLines(IteratedHeld):
    """The same, with lines from the values of the begin to those of the end."""

    label, order = "rollback, lines", 2
    lines = True


ALL = {"jacobi": Jacobi, "gauss_seidel": GaussSeidel, "lines": Lines, "iterated_held": IteratedHeld,
       "iterated_lines": IteratedLines}


def run(system, master, size, count, every=1):
    """Outputs at the start and after each `every` of `count` steps of `size`. A run that leaves all bounds ends early."""
    y = system.read()
    before, rows = y, [y]
    for k in range(count):
        y, before = master.step(system, k * size, size, y, before), y
        if not np.all(np.abs(y) < BOUND):
            break
        if (k + 1) % every == 0:
            rows.append(y)
    return np.array(rows)
