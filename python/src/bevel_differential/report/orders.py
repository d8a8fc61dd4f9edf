"""Order tracking: a signal over time becomes one over an angle, and its spectra count periods per turn."""

from dataclasses import dataclass

import numpy as np

from ..values import DifferentialError

TURN = 2.0 * np.pi
# points in a period of the highest order: of a record at least, and of the signal over the angle. These are many, so that what the
# record has above the orders of interest does not come back among them
PER_PERIOD, FINER = 4, 16
# of neighbouring windows
OVERLAP = 0.75


@dataclass(frozen=True)
class Waterfall:
    """Spectra of windows along an angle.

    `orders`: periods per turn, shape (orders,). `speeds`: mean of the speed that goes with each window, shape (windows,).
    `amplitudes`: of the signal, shape (windows, orders). `resolution`: distance of two lines, periods per turn."""

    orders: np.ndarray
    speeds: np.ndarray
    amplitudes: np.ndarray
    resolution: float

    @property
    def mean(self) -> np.ndarray:
        """Effective amplitude over all windows, shape (orders,)."""
        return np.sqrt(np.mean(np.square(self.amplitudes), axis=0))

    def strongest(self, count: int, floor: float) -> list[tuple[float, float]]:
        """(order, amplitude) of the strongest peaks above `floor` times the highest, the strongest first. A peak is higher than all
        within two lines, which is the width that the window gives to a pure tone."""
        mean = self.mean
        peaks = [k for k in range(2, len(mean) - 2) if mean[k] == max(mean[k - 2:k + 3]) and mean[k] > floor * mean.max()]
        found = sorted(((self._place(k), float(mean[k])) for k in peaks), key=lambda peak: -peak[1])
        return found[:count]

    def _place(self, k):
        """Order of a peak, by a parabola through the logarithms of it and its neighbours."""
        low, middle, high = np.log(np.maximum(self.mean[k - 1:k + 2], 1e-300))
        bend = low - 2.0 * middle + high
        return float(self.orders[k] + (0.5 * (low - high) / bend if bend < 0.0 else 0.0) * self.resolution)


def over_angle(angle: np.ndarray, values: np.ndarray, per_turn: int) -> tuple[np.ndarray, np.ndarray]:
    """`values` at equal steps of a monotone `angle` (rad): (angles, values), `per_turn` points in a turn.

    A point is the mean over its step, so that orders far above do not come back as low ones: those at multiples of `per_turn`,
    which would fall on the lowest, vanish in it. `damped` says what it does to the others."""
    angle, values = (angle, values) if angle[-1] > angle[0] else (-angle, values)
    if np.any(np.diff(angle) <= 0.0):
        raise DifferentialError("orders are counted by an angle that turns one way")
    step = TURN / per_turn
    edges = angle[0] + np.arange(int((angle[-1] - angle[0]) / step) + 1) * step
    # the integral over the angle, by cubic pieces whose slopes are the values
    slopes = np.gradient(values, angle)
    widths = np.diff(angle)
    pieces = 0.5 * widths * (values[1:] + values[:-1]) + widths**2 / 12.0 * (slopes[:-1] - slopes[1:])
    total = np.concatenate([[0.0], np.cumsum(pieces)])
    place = np.clip(np.searchsorted(angle, edges, side="right") - 1, 0, len(angle) - 2)
    width = widths[place]
    share = (edges - angle[place]) / width
    low, high, rise, fall = total[place], total[place + 1], width * values[place], width * values[place + 1]
    integral = low + share * (rise + share * (3.0 * (high - low) - 2.0 * rise - fall + share * (2.0 * (low - high) + rise + fall)))
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(integral) / step


def damped(orders: np.ndarray, per_turn: int) -> np.ndarray:
    """What the mean over a step leaves of orders: sin x / x with x = π order / per_turn."""
    return np.sinc(orders / per_turn)


def waterfall(angle: np.ndarray, values: np.ndarray, speed: np.ndarray, turns: int, highest: float) -> Waterfall:
    """Spectra up to the order `highest` over windows (Hann) of so many turns of `angle` (rad), which overlap; `speed` labels them."""
    coarsest = float(np.abs(np.diff(angle)).max()) / TURN
    if coarsest * highest * PER_PERIOD > 1.0:
        raise DifferentialError(f"a period of order {highest:.4g} has only {1.0 / (coarsest * highest):.2g} points of the "
                                f"record, and needs {PER_PERIOD}: take shorter steps")
    per_turn = int(2 ** np.ceil(np.log2(FINER * highest)))
    even, resampled = over_angle(angle, values, per_turn)
    ordered = np.argsort(angle)
    labels = np.interp(even * np.sign(angle[-1] - angle[0]), angle[ordered], speed[ordered])
    size = turns * per_turn
    hop = max(1, round(size * (1.0 - OVERLAP)))
    begins = range(0, len(even) - size + 1, hop)
    if len(begins) < 2:
        raise DifferentialError(f"{len(even) / per_turn:.3g} turns are too few for windows of {turns} turns")
    window = np.hanning(size + 1)[:-1]
    spectra = []
    for begin in begins:
        part = resampled[begin:begin + size]
        # the slow trend is not an order
        swing = part - np.polynomial.Polynomial.fit(np.arange(size), part, 1)(np.arange(size))
        spectra.append(2.0 * np.abs(np.fft.rfft(window * swing)) / window.sum())
    speeds = np.array([labels[begin:begin + size].mean() for begin in begins])
    orders = np.arange(size // 2 + 1) / turns
    shown = orders <= highest
    amplitudes = np.array(spectra)[:, shown] / damped(orders[shown], per_turn)
    return Waterfall(orders[shown], speeds, amplitudes, 1.0 / turns)
