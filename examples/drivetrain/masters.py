"""Co-simulation masters. Each advances a system by one communication step.

    step(system, time, size, y, before) → y at the end of the step

`delay` is the delay of the answer that the differential sees, in steps (`coupling.host_delay`): the other parts integrate
its speed or torque. It is None if repetitions exchange values within a step.

y contains all outputs at the start of the step, `before` those one step earlier. All inputs of a part act from the start
of the step, held or on a line.
"""

import numpy as np

# iterations stop when outputs change by less than this, relative to their largest values so far
CONVERGED = 1e-8
FLOOR = 1e-3
MOST = 60
# outputs above this have diverged, in any SI unit
BOUND = 1e7


class NoConvergence(Exception):
    """The iteration of a step does not converge."""


class Jacobi:
    """Steps all parts at the same time, with inputs held at their values at the start, as plain hosts do."""

    label, order, states, delay = "Jacobi, held", 1, False, 0.5

    def step(self, system, time, size, y, before):
        for part, feeds in zip(system.parts, system.feeds):
            part.step(time, size, y[feeds])
        return system.read()


class GaussSeidel:
    """Steps one part after the other; each uses the outputs that the parts before it have at the end of the step."""

    label, order, states, delay = "Gauss-Seidel, held", 1, False, -0.5

    def step(self, system, time, size, y, before):
        y = y.copy()
        for part, feeds, gives in zip(system.parts, system.feeds, system.gives):
            part.step(time, size, y[feeds])
            y[gives] = part.read()
        return y


class Lines:
    """Steps all parts at the same time; inputs continue along the line through the last two communication points."""

    label, order, states, delay = "Jacobi, lines", 2, False, 0.0

    def step(self, system, time, size, y, before):
        slope = (y - before) / size
        for part, feeds in zip(system.parts, system.feeds):
            part.step(time, size, y[feeds], slope[feeds])
        # direct feedthrough uses the inputs at the end of the step
        system.put(y + size * slope)
        return system.read()


class IteratedHeld:
    """Repeats the step from its start, with inputs held at the outputs of the last repetition, until these converge."""

    label, order, states, delay = "rollback, held", 1, True, None
    lines = False

    def __init__(self):
        self.largest, self.iterations = FLOOR, []

    def step(self, system, time, size, y, before):
        saved = system.save()
        # first guess: outputs continue as in the last step
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
        """Outputs at the end of the step for inputs from `guess`. Parts step one after the other, with the latest outputs. This
        converges to the same result as stepping all at the same time, in fewer repetitions."""
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
    """Repeats the step with inputs on lines from their values at the start to those at the end."""

    label, order = "rollback, lines", 2
    lines = True


ALL = {"jacobi": Jacobi, "gauss_seidel": GaussSeidel, "lines": Lines, "iterated_held": IteratedHeld,
       "iterated_lines": IteratedLines}


def run(system, master, size, count, every=1, watch=lambda: None):
    """Outputs at the start and after every `every` of `count` steps of `size` [s]. `watch` is called after each step. A run that diverges
    ends early."""
    y = system.read()
    before, rows = y, [y]
    for k in range(count):
        y, before = master.step(system, k * size, size, y, before), y
        if not np.all(np.abs(y) < BOUND):
            break
        watch()
        if (k + 1) % every == 0:
            rows.append(y)
    return np.array(rows)
