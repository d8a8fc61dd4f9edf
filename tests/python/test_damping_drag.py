"""Drag of rolling planets by contact damping, against a formula evaluated on the plain model of the teeth.

Teeth that roll slowly are in static equilibrium at every position x of their cycle. Their depths d_k(x) change as pairs enter
and leave contact, and IMPACT damping turns this into heat: T = c ψ̇, c = C Σ_meshes ⟨Σ_k STEP(d_k/d_max) (∂d_k/∂ψ)²⟩."""

import numpy as np
import plain
import pytest
import theory
from scipy.optimize import brentq

PLACES = 2000


@pytest.fixture(scope="module")
def coefficient():
    """Coefficient c of the study's gears under the study's load [N·m·s]."""
    model = plain.Differential(plain.Scene(spin_imposed=True))
    gears, scene = model.gears, model.scene

    def balance(approach, travel):
        pairs = model.pairs(approach, 0.0, travel, 0.0)
        torque = sum(force * by_approach for _, _, _, force, by_approach, _ in pairs)
        return torque * theory.MEAN_CONE * gears.lever["side"] - theory.LOAD / theory.PLANETS

    def depths(travel):
        approach = brentq(balance, 0.0, 0.01, args=(travel,), xtol=1e-16, rtol=1e-14)
        return {number: depth for number, _, depth, _, _, _ in model.pairs(approach, 0.0, travel, 0.0)}

    width = gears.base_pitch / PLACES
    places = [depths(width * (k + 0.5)) for k in range(PLACES + 1)]
    total = 0.0
    for one, next_one in zip(places, places[1:]):
        for number in one.keys() | next_one.keys():
            begin, end = one.get(number, 0.0), next_one.get(number, 0.0)
            share = min(0.5 * (begin + end) / scene.full_damping, 1.0)
            total += share * share * (3.0 - 2.0 * share) * ((end - begin) / width) ** 2
    meshes = 2 * theory.PLANETS
    return meshes * scene.damping * total / PLACES * gears.lever["planet"] ** 2


def lost(drive, spin):
    """Mean power over whole tooth cycles at a spin."""
    cycle = theory.TOOTH_PITCH / spin
    driven = drive({"scene.planet_spin": "imposed", "spin.command": spin}).to(4.0 * cycle, cycle)
    before = driven["heat.contact"]
    return (driven.to(8.0 * cycle, cycle)["heat.contact"] - before) / (4.0 * cycle)


def test_slow_rolling_loses_the_damping_work_of_pairs_that_enter_and_leave(drive, coefficient):
    assert lost(drive, 1.0) == pytest.approx(coefficient, rel=1e-3)


def test_fast_rolling_loses_somewhat_less_because_damping_then_bears_a_part_of_the_load(drive, coefficient):
    spins = [20.0, 58.0, 116.0]
    torques = [lost(drive, spin) / spin for spin in spins]
    print(f"c = {coefficient:.5f} N.m.s; " + ", ".join(f"{s:.0f} rad/s: {t:.3f} N.m" for s, t in zip(spins, torques)))
    shares = np.array(torques) / (coefficient * np.array(spins))
    assert np.all(np.diff([1.0, *shares]) < 0.0)
    assert shares[-1] > 0.9
