"""Linear systems with inputs that are held or on a line over a step: exact steps by the matrix exponential."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

# matrices F, G, L of a step: x becomes F x + G u + L du/dt, with the inputs u at its start
Step: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
# order of the Padé approximant, which is exact to rounding below the norm 0.5
ORDER = 8
# sweeps of balancing; three suffice if scales differ by less than 1e30
SWEEPS = 10
# eigenvalues below this rate belong to rigid rotation, 1/s: the slowest elastic motion of a drivetrain is a hundred times faster
RIGID = 1e-2


def balancing(a: np.ndarray) -> np.ndarray:
    """Powers of two, one for each state, so that rows and columns of a / scale[:, None] * scale have similar sizes (Osborne)."""
    scale = np.ones(len(a))
    sizes = np.abs(a)
    np.fill_diagonal(sizes, 0.0)
    for _ in range(SWEEPS):
        for i in range(len(a)):
            column, row = sizes[:, i].sum(), sizes[i].sum()
            if column and row:
                factor = 2.0 ** np.round(0.5 * np.log2(row / column))
                scale[i] *= factor
                sizes[:, i] *= factor
                sizes[i] /= factor
    return scale


def exponential(a: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """Matrix exponential by a Padé approximant with scaling and squaring (Golub and Van Loan, *Matrix Computations*, 9.3). The matrix is
    balanced by `scale`, because stiff teeth give accelerations far above angles."""
    a = a / scale[:, None] * scale
    squarings = max(0, int(np.ceil(np.log2(max(np.abs(a).sum(axis=1).max(initial=0.0), 1e-300)))) + 1)
    a = a / 2.0**squarings
    power, up, down, factor = np.eye(len(a)), np.eye(len(a)), np.eye(len(a)), 1.0
    for k in range(1, ORDER + 1):
        factor *= (ORDER - k + 1) / (k * (2 * ORDER - k + 1))
        power = a @ power
        up, down = up + factor * power, down + (-1.0) ** k * factor * power
    result = np.linalg.solve(down, up)
    for _ in range(squarings):
        result = result @ result
    return result * scale[:, None] / scale


@dataclass(frozen=True)
class Linear:
    """ẋ = A x + B u, o = C x + D u."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    # matrix of states, inputs and their slopes, with its balancing; and steps by their size
    _whole: list[np.ndarray] = field(default_factory=list, repr=False, compare=False)
    _steps: dict[float, Step] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(cls, a: Any, b: Any, c: Any, d: Any) -> "Linear":
        """System of these matrices, given as arrays or lists. A system without states has an empty A."""
        d = np.atleast_2d(np.asarray(d, float))
        a = np.asarray(a, float)
        n = len(a) if a.size else 0
        return cls(a.reshape(n, n), np.asarray(b, float).reshape(n, d.shape[1]), np.asarray(c, float).reshape(d.shape[0], n), d)

    def exact(self, size: float) -> Step:
        """Matrices of a step of `size` [s]."""
        n, m = self.b.shape
        if not self._whole:
            whole = np.zeros((n + 2 * m, n + 2 * m))
            whole[:n, :n], whole[:n, n:n + m], whole[n:n + m, n + m:] = self.a, self.b, np.eye(m)
            self._whole.extend([whole, balancing(whole)])
        if size not in self._steps:
            whole, scale = self._whole
            e = exponential(whole * size, scale)
            self._steps[size] = e[:n, :n], e[:n, n:n + m], e[:n, n + m:]
        return self._steps[size]

    def transfer(self, rate: float) -> np.ndarray:
        """Outputs over inputs that grow as exp(rate t), rate [1/s]."""
        return self.c @ np.linalg.solve(rate * np.eye(len(self.a)) - self.a, self.b) + self.d

    def reduced(self) -> "Linear":
        """Same system without states that no input reaches or that no output depends on."""
        reached, seen = _closure(self.a, np.any(self.b, axis=1)), _closure(self.a.T, np.any(self.c, axis=0))
        kept = np.flatnonzero(reached & seen)
        return Linear(self.a[np.ix_(kept, kept)], self.b[kept], self.c[:, kept], self.d)


def _closure(a, begin):
    """States that those of `begin` influence through nonzero entries of a."""
    while True:
        more = begin | np.any(a[:, begin], axis=1)
        if np.array_equal(more, begin):
            return begin
        begin = more


def joined(parts: Sequence[Linear], sources: np.ndarray) -> np.ndarray:
    """Matrix of the states of parts that exchange signals continuously; their inputs are `sources` times their outputs."""
    def blocks(matrices):
        rows, columns = zip(*(matrix.shape for matrix in matrices))
        whole, row, column = np.zeros((sum(rows), sum(columns))), 0, 0
        for matrix in matrices:
            whole[row:row + matrix.shape[0], column:column + matrix.shape[1]] = matrix
            row, column = row + matrix.shape[0], column + matrix.shape[1]
        return whole

    a, b, c, d = (blocks([getattr(part, name) for part in parts]) for name in "abcd")
    return a + b @ sources @ np.linalg.solve(np.eye(len(d)) - d @ sources, c)


def poles(a: np.ndarray) -> np.ndarray:
    """Eigenvalues of ẋ = A x [1/s], with a balanced matrix."""
    scale = balancing(a)
    return np.linalg.eigvals(a / scale[:, None] * scale)


def motions(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues of ẋ = A x [1/s], and their vectors, shape (states, eigenvalues)."""
    scale = balancing(a)
    values, vectors = np.linalg.eig(a / scale[:, None] * scale)
    return values, scale[:, None] * vectors


def rigid_count(a: np.ndarray) -> int:
    """Number of motions of ẋ = A x that neither swing nor decay, as rigid rotation."""
    return int(np.sum(np.abs(poles(a)) < RIGID))
