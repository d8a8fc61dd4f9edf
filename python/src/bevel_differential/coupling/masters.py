"""Masters of the coupling: one communication step of unit and hosts as a matrix.

Unit and hosts step exactly. At a communication point, the unit returns its outputs y, and the hosts return the values v that drive
the unit. The masters:

- `jacobi`: unit and hosts step at the same time, from values at the start of the step.
- `gauss-seidel`: the unit steps first with the hosts' values at the start, and the hosts then use its outputs at the end. If hosts step
  first, the unit uses their values at the end.
- `rollback`: the step is repeated until all values at its end agree.

Inputs on lines continue the line through the last two points. If the values at the end are known, the line connects both ends. With
`solver.input_ramp`, the unit reaches a held input only at the end of the step, on a line from the one before.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..values import DifferentialError
from .host import Host
from .linear import Linear, joined, rigid_count

JACOBI, GAUSS_SEIDEL, ROLLBACK = MASTERS = ("jacobi", "gauss-seidel", "rollback")
HELD, LINES = INPUTS = ("held", "lines")
UNIT, HOST = FIRST = ("unit", "host")


@dataclass(frozen=True)
class State:
    """Columns of states: unit, hosts, outputs y of the unit at this point and one step before, values v of the hosts likewise."""

    x: np.ndarray
    z: list[np.ndarray]
    y: np.ndarray
    y_before: np.ndarray
    v: np.ndarray
    v_before: np.ndarray

    def stacked(self) -> np.ndarray:
        """All rows in one array."""
        return np.concatenate([self.x, *self.z, self.y, self.y_before, self.v, self.v_before])


class Exchange:
    """Unit and hosts under one master. `first`: which of them steps first under Gauss-Seidel; `ramp`: true if the unit spreads a held
    input over the step."""

    def __init__(self, unit: Linear, hosts: Sequence[Host], master: str, inputs: str, first: str = UNIT, ramp: bool = False):
        for name, given, known in (("master", master, MASTERS), ("inputs", inputs, INPUTS), ("first", first, FIRST)):
            if given not in known:
                raise DifferentialError(f"{name} = {given!r}: it is one of {', '.join(known)}")
        self.unit, self.hosts, self.master, self.inputs, self.first = unit, hosts, master, inputs, first
        self.lines, self.ramp = inputs == LINES, ramp
        # rows of y that each host reads
        ends = np.cumsum([len(host.outputs) for host in hosts])
        self.rows = [slice(end - len(host.outputs), end) for host, end in zip(hosts, ends)]
        self.sizes = [len(unit.a), *(len(host.law.a) for host in hosts), *2 * [len(unit.c)], *2 * [len(hosts)]]
        self.rigid = rigid_count(self.continuous())

    def continuous(self) -> np.ndarray:
        """Matrix of unit and hosts that exchange their values continuously."""
        p, laws = len(self.hosts), [host.law for host in self.hosts]
        sources = np.zeros((p + sum(law.b.shape[1] for law in laws), len(self.unit.c) + p))
        sources[:p, len(self.unit.c):] = np.eye(p)
        row = p
        for law, rows in zip(laws, self.rows):
            count = law.b.shape[1]
            sources[row:row + count, rows.start:rows.start + count] = np.eye(count)
            row += count
        return joined([self.unit, *laws], sources)

    def state(self, columns: np.ndarray) -> State:
        """State with these columns."""
        x, *z, y, y_before, v, v_before = np.split(columns, np.cumsum(self.sizes)[:-1])
        return State(x, z, y, y_before, v, v_before)

    def matrix(self, size: float) -> np.ndarray:
        """Matrix of one communication step of `size` [s]."""
        return self.step(self.state(np.eye(sum(self.sizes))), size).stacked()

    def repetition(self, size: float) -> np.ndarray:
        """Matrix of one repetition of a step: from assumed to resulting values of the hosts at its end."""
        p = len(self.hosts)
        return self._repeat(self.state(np.zeros((sum(self.sizes), p))), np.eye(p), size).v

    def step(self, state: State, size: float) -> State:
        """Columns after one communication step."""
        if self.master == ROLLBACK:
            # the value that a repetition reproduces
            fixed = self._repeat(state, 0.0 * state.v, size).v
            return self._repeat(state, np.linalg.solve(np.eye(len(self.hosts)) - self.repetition(size), fixed), size)
        if self.master == GAUSS_SEIDEL and self.first == HOST:
            z, v = self._move_hosts(state, None, size)
            x, y = self._move_unit(state.x, self._answers(state, size) if self.lines else state.v, v, size)
        else:
            # a line continues beyond the last value, and a held input stays there
            ahead = 2.0 * state.v - state.v_before if self.lines else state.v
            x, y = self._move_unit(state.x, state.v if self.lines else state.v_before, ahead, size)
            z, v = self._move_hosts(state, y if self.master == GAUSS_SEIDEL else None, size)
        return State(x, z, y, state.y, v, state.v)

    def _repeat(self, state, guess, size):
        """The step with assumed values of the hosts at its end."""
        x, y = self._move_unit(state.x, state.v, guess, size)
        z, v = self._move_hosts(state, y, size, guess)
        return State(x, z, y, state.y, v, state.v)

    def _move_unit(self, x, begin, end, size):
        """States and outputs of the unit at the end of the step. Its inputs are on the line from `begin` to `end`, or held at `end`."""
        free, held, line = self.unit.exact(size)
        if self.lines or self.ramp:
            x = free @ x + held @ begin + line @ ((end - begin) / size)
        else:
            x = free @ x + held @ end
        return x, self.unit.c @ x + self.unit.d @ end

    def _move_hosts(self, state, y, size, guess=None):
        """States and values of the hosts at the end of the step. `y`: outputs of the unit there, None if unknown; `guess`: values of the
        hosts there that are assumed in a repetition."""
        z, v = [], []
        for i, (host, rows) in enumerate(zip(self.hosts, self.rows)):
            law, own = host.law, state.z[i]
            heard, slope = host.hears(state.y[rows], state.y_before[rows], size)
            end = heard + size * slope if self.lines else heard
            if host.sampled and not self.lines:
                # the torque at the start, from values there, moves the host's inertia
                torque = law.c @ own + law.d @ heard
                free, held, _ = host.sampled.exact(size)
                moved = free @ own + held @ (torque if guess is None else guess[i:i + 1])
                if y is None:
                    z, v = [*z, moved], [*v, torque]
                    continue
                end, _ = host.hears(y[rows], state.y[rows], size)
            else:
                if y is not None:
                    end, slope = host.hears(y[rows], state.y[rows], size)
                    heard = end - size * slope if self.lines else end
                free, held, line = law.exact(size)
                moved = free @ own + held @ heard
                if self.lines:
                    moved = moved + line @ slope
            z, v = [*z, moved], [*v, law.c @ moved + law.d @ end]
        return z, np.concatenate(v)

    def _answers(self, state, size):
        """Values of the hosts at the start of the step, from the outputs of the unit there."""
        heard = [host.hears(state.y[rows], state.y_before[rows], size)[0] for host, rows in zip(self.hosts, self.rows)]
        return np.concatenate([host.law.c @ z + host.law.d @ each for host, z, each in zip(self.hosts, state.z, heard)])
