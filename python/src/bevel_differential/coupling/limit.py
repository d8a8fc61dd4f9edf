"""Search for the longest stable step: spectral radius of the step's matrix, its first loss of stability, and the motion that grows."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .linear import RIGID, poles
from .masters import ROLLBACK, Exchange

# range of the search [s], and its points per decade: of steps that are far shorter than all swings, and of others. A swing whose period
# is a few steps may grow in a range of steps that is only a few percent wide
SHORTEST, LONGEST, PER_DECADE, PER_DECADE_OF_SWINGS = 1e-7, 1.0, 40, 300
# angle by which a swing turns in a step that is far shorter than its period, rad; and damping ratio above which nothing swings
SLOW, DAMPED = 0.3, 0.95
# a radius above this grows; rounding of motions other than rigid rotation is below
GROWS = 1.0 + 1e-11
# radius from which a maximum between points of the search is looked at more closely, and number of points for this
NEAR, CLOSER = 0.97, 16
# a growth counts from this multiple of the growth in continuous exchange on, because steps change the latter slightly
FASTER = 2.0
# bisections: a step to 2e-10 of itself
BISECTIONS = 28


def longest(radius: Callable[[float], float], low: float = SHORTEST, high: float = LONGEST, dense: float | None = None) -> float:
    """Longest step [s] up to which `radius(step)` stays at 1 or below: the end of the first stable range. 0 if it exceeds 1 at `low`,
    infinite if it does not exceed 1 up to `high`. The search is dense from the step `dense` on, by default everywhere."""
    dense = min(max(dense or low, low), high)
    sizes = np.concatenate([_points(low, dense, PER_DECADE)[:-1], _points(dense, high, PER_DECADE_OF_SWINGS)])
    values = [radius(sizes[0])]
    if values[0] > GROWS:
        return 0.0
    for i, size in enumerate(sizes[1:], 1):
        values.append(radius(size))
        bad = size if values[-1] > GROWS else None
        # a narrow range of growth between three points
        if i > 1 and values[-2] > NEAR and values[-2] > values[-3] and (bad is not None or values[-2] >= values[-1]):
            between = np.geomspace(sizes[i - 2], size, CLOSER)[1:-1]
            bad = next((each for each in between if radius(each) > GROWS), bad)
        if bad is not None:
            good = max(each for each in sizes if each < bad and each <= sizes[i - 1])
            return _bisected(radius, good if radius(good) <= GROWS else sizes[i - 2], bad)
    return math.inf


def _points(low, high, per_decade):
    return np.geomspace(low, high, 1 + math.ceil(per_decade * math.log10(high / low)))


def limit(exchange: Exchange) -> float:
    """Longest stable step [s] of an exchange; see `longest`. A motion that grows in continuous exchange, too, is not due to the steps."""
    # swings of the unit with constant torques, and of all together
    together = poles(exchange.continuous())
    found = np.concatenate([poles(exchange.unit.a), together])
    swings = np.abs(found.imag[np.abs(found.real) < DAMPED * np.abs(found)])
    rate = FASTER * _largest_growth(together)
    return longest(lambda step: growth(exchange, step) * math.exp(-rate * step), dense=SLOW / max(swings.max(initial=0.0), SLOW))


def departure(exchange: Exchange) -> float:
    """Rate [1/s] at which a disturbance grows in continuous exchange; 0 if it does not. Without friction, loaded teeth may leave the
    operating point as a ball leaves the top of a hill."""
    return _largest_growth(poles(exchange.continuous()))


def _largest_growth(found):
    return float(found.real[np.abs(found) >= RIGID].max(initial=0.0))


def _bisected(radius, good, bad):
    for _ in range(BISECTIONS):
        middle = math.sqrt(good * bad)
        good, bad = (good, middle) if radius(middle) > GROWS else (middle, bad)
    return float(good)


def growth(exchange: Exchange, size: float) -> float:
    """Factor by which the fastest-growing motion grows in one step of `size` [s]. Rigid rotation does not count. With rollback, it is at
    least the factor by which repetitions of a step approach or leave each other."""
    values = np.linalg.eigvals(exchange.matrix(size))
    largest = float(np.max(np.abs(values[_counted(values, exchange)])))
    if exchange.master == ROLLBACK:
        largest = max(largest, float(np.max(np.abs(np.linalg.eigvals(exchange.repetition(size))))))
    return largest


def _fastest(exchange, size):
    """Largest eigenvalue without those of rigid rotation, with its vector."""
    values, vectors = np.linalg.eig(exchange.matrix(size))
    counted = _counted(values, exchange)
    index = counted[np.argmax(np.abs(values[counted]))]
    return values[index], vectors[:, index]


def _counted(values, exchange):
    """Places of the eigenvalues without those of rigid rotation, which are nearest to 1."""
    return np.argsort(np.abs(values - 1.0))[exchange.rigid:]


@dataclass(frozen=True)
class Mode:
    """Motion that loses stability first. `frequency` [Hz] is half the rate of steps if it changes sign at each, and 0 if repetitions of a
    step do not converge. `port`: the port through which most of its power passes."""

    frequency: float
    port: str


def mode(exchange: Exchange, size: float) -> Mode:
    """Motion that grows fastest in steps of `size` [s]."""
    value, vector = _fastest(exchange, size)
    if exchange.master == ROLLBACK:
        factors, guesses = np.linalg.eig(exchange.repetition(size))
        worst = np.argmax(np.abs(factors))
        if abs(factors[worst]) > abs(value):
            return Mode(0.0, exchange.hosts[int(np.argmax(np.abs(guesses[:, worst])))].port)
    state = exchange.state(vector[:, None])
    # the last output of a port is its speed, or the torque of a port driven by speed
    power = [abs(v * state.y[rows][-1, 0]) for v, rows in zip(state.v[:, 0], exchange.rows)]
    return Mode(abs(float(np.angle(value))) / (2.0 * math.pi * size), exchange.hosts[int(np.argmax(power))].port)
