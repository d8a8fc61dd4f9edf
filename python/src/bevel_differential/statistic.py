"""Figures that a series over time is judged by: those of the command `accuracy`."""

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .values import DifferentialError, suggestion

# periods of an order need so many radians between two points at most
COARSEST = 0.5 * np.pi
_ORDER = re.compile(r"(mesh|shaft)_order_([1-9]\d*)$")
_OTHER_ORDER = re.compile(r"order_([1-9]\d*)_of_(mesh|shaft)$")


def mean(times: np.ndarray, values: np.ndarray) -> float:
    """Mean over time, straight from point to point."""
    span = times[-1] - times[0]
    return float(np.trapezoid(values, times) / span) if span > 0.0 else float(values[0])


def rms(times: np.ndarray, values: np.ndarray) -> float:
    """Effective value."""
    return float(np.sqrt(mean(times, np.square(values))))


def time_of_peak(times: np.ndarray, values: np.ndarray) -> float:
    """Time of the largest magnitude, by a parabola through it and its neighbours, s."""
    size = np.abs(values)
    k = len(size) - 1 - int(np.argmax(size[::-1]))
    if k in (0, len(size) - 1):
        return float(times[k])
    down, up = times[k] - times[k - 1], times[k + 1] - times[k]
    left, right = (size[k] - size[k - 1]) / down, (size[k + 1] - size[k]) / up
    if left - right <= 0.0:
        return float(times[k])
    # where the slope, left at the middle of the first piece and right at that of the second, is zero
    return float(times[k] - 0.5 * down + 0.5 * (down + up) * left / (left - right))


FIGURES: dict[str, Callable[[np.ndarray, np.ndarray], float]] = {
    "final": lambda times, values: float(values[-1]),
    "mean": mean,
    "rms": rms,
    "min": lambda times, values: float(np.min(values)),
    "max": lambda times, values: float(np.max(values)),
    "peak_to_peak": lambda times, values: float(np.max(values) - np.min(values)),
    "time_of_peak": time_of_peak,
}
SHORT = {"p2p": "peak_to_peak", "pp": "peak_to_peak"}


@dataclass(frozen=True)
class Statistic:
    """A figure of a series.

    `word`: a key of FIGURES, or an order: "mesh_order_2" is the amplitude of two periods per pitch of planet 1, "shaft_order_1"
    that of one period per turn of the carrier."""

    word: str

    @classmethod
    def parse(cls, text: str) -> "Statistic":
        """The statistic that a word names."""
        word = re.sub(r"[\s-]+", "_", text.strip().lower())
        word = SHORT.get(word, word)
        other = _OTHER_ORDER.match(word)
        if other:
            word = f"{other[2]}_order_{other[1]}"
        if word not in FIGURES and not _ORDER.match(word):
            known = [*FIGURES, "mesh_order_1", "shaft_order_1"]
            raise DifferentialError(f"there is no statistic {text!r}{suggestion(word, known)}; known: {', '.join(known)} (any "
                                    "whole number)")
        return cls(word)

    @property
    def angle(self) -> str | None:
        """The angle by which an order is counted, an output."""
        order = _ORDER.match(self.word)
        return order and {"mesh": "planet[1].spin_angle", "shaft": "carrier.angle"}[order[1]]

    def of(self, times: np.ndarray, values: np.ndarray, phase: np.ndarray | None = None) -> float:
        """The figure of `values` at `times` (s), shape (points,); `phase` (rad, 2π a period of order 1) for orders."""
        if self.word in FIGURES:
            return FIGURES[self.word](times, values)
        order = _ORDER.match(self.word)
        if order is None or phase is None:
            raise DifferentialError(f"{self.word}: an order needs the angle that it is counted by")
        try:
            return amplitude(phase, values, int(order[2]))
        except DifferentialError as error:
            raise DifferentialError(f"{self.word}: {error}") from None


def amplitude(phase: np.ndarray, values: np.ndarray, order: int) -> float:
    """Amplitude of an order of `phase` (rad) in `values`, over the last whole periods."""
    turned = phase[-1] - phase[0]
    periods = np.floor(abs(turned) / (2.0 * np.pi) * (1.0 + 1e-12))
    if periods < 1.0:
        raise DifferentialError("what it is counted by turns by less than one period: let the scene run longer, or let it turn")
    phase = phase * np.sign(turned)
    if np.any(np.diff(phase) < -1e-9):
        raise DifferentialError("what it is counted by turns to and fro")
    coarsest = np.diff(phase).max() * order
    if coarsest > COARSEST:
        raise DifferentialError(f"a period of it has only {2.0 * np.pi / coarsest:.1f} communication points: make the scene's step "
                                f"{np.ceil(coarsest / COARSEST):.0f} times smaller")
    begin = phase[-1] - 2.0 * np.pi * periods
    inside = phase > begin
    values = np.append(np.interp(begin, phase, values), values[inside])
    phase = np.append(begin, phase[inside])
    length = 2.0 * np.pi * periods
    swing = values - np.trapezoid(values, phase) / length
    wave = np.trapezoid(swing * np.exp(1j * order * phase), phase) / length
    return float(2.0 * abs(wave))
