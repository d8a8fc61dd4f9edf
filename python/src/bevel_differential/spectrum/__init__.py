"""Damage of the gears over a duty cycle, and their life.

>>> from bevel_differential.spectrum import spectrum
>>> print(spectrum("duty_cycle.csv").summary())  # doctest: +SKIP
"""

from .damage import Event
from .result import SpectrumResult, spectrum

__all__ = ["Event", "SpectrumResult", "spectrum"]
