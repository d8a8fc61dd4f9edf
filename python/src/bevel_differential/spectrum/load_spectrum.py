"""The load spectrum of what a duty cycle damages most: stresses, how often they occur, and the S–N curves that limit them.

A `result` is a `SpectrumResult`."""

from typing import Any

import numpy as np

from .sn import SnCurve


def curves(result: Any) -> tuple[SnCurve, SnCurve]:
    """S–N curves of the critical mode: of teeth that roll, and of teeth that stand in mesh."""
    strength = result.strength
    if result.is_flank:
        return strength.pitting, strength.pitting
    return (strength.bending if result.critical else strength.idler), strength.bending


def rolling_spectrum(result: Any) -> tuple[np.ndarray, np.ndarray]:
    """Largest stress [Pa] of each event in which teeth roll, and how often it passes a tooth of the critical gear in a duty
    cycle; shapes (events that roll,). Of flanks it is the rated contact pressure."""
    rolling = [one for one in result.events if one.event.count * one.turns * one.root_stress > 0.0]
    if result.is_flank:
        stresses = [result.strength.pitting.strength / one.safety_flank for one in rolling]
    else:
        stresses = [one.root_stress * (result.side_ratio if result.critical else 1.0) for one in rolling]
    # each flank of a planet has one mesh, that of a side gear one with each planet
    is_side = result.critical % 2 == 1
    per_turn = result.planets * result.teeth[0] / result.teeth[1] if is_side else 1.0
    return np.array(stresses), np.array([one.event.count * one.turns * per_turn for one in rolling])


def standing_spectrum(result: Any) -> tuple[np.ndarray, np.ndarray]:
    """Pulsating root stress [Pa] of the slow cycles at the worse fillet of the critical gear, and their counts in a duty cycle;
    empty for flanks, which they do not damage."""
    if result.is_flank:
        return np.empty(0), np.empty(0)
    slow = result.slow.scaled(result.side_ratio) if result.critical else result.slow
    return slow.pulsating(result.strength), slow.count
