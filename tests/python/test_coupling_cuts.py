"""Warnings and advice of cuts that are too coarse: spinning, locked and equal wheels, tyres and springs, and all masters."""

import math

import numpy as np
import pytest
from coupled_cars import FINE, SIDES, Coupling, Tyre, Wheel, run

SCENES = range(40)
# fractions of the largest torque: error that must be noticed, five times the wanted ratio, and error without a warning
LARGE, SMALL = 0.05, 0.01
# periods within which it must be noticed
PERIODS = 10


def errors_of(coarse, fine, factor):
    """Differences of the torques at the communication points of the coarse run, over the largest torque; infinite if it diverges."""
    same = fine.torques[factor - 1::factor]
    count = min(len(same), len(coarse.torques))
    found = np.abs(coarse.torques[:count] - same[:count]).max(axis=1) / np.abs(fine.torques).max()
    return found if count == len(same) else np.append(found, np.inf)


def period_of(torques, size):
    """Mean period of a torque about its mean, s."""
    changes = max(np.count_nonzero(np.diff(np.sign(torque - torque.mean()))) for torque in torques.T)
    return 2.0 * size * len(torques) / max(changes, 1)


@pytest.mark.parametrize("number", SCENES)
def test_a_large_error_is_noticed_and_a_small_one_gets_no_warning(fmu, number):
    scene = Coupling(number)
    factor = math.ceil(scene.step / FINE)
    coarse, fine = run(fmu, scene, scene.step), run(fmu, scene, scene.step / factor)
    errors = errors_of(coarse, fine, factor)
    large = np.flatnonzero(errors > LARGE)
    if large.size:
        begin = scene.step * (large[0] + 1)
        until = begin + PERIODS * period_of(coarse.torques, scene.step)
        times = scene.step * np.arange(1, len(coarse.advice) + 1)
        advised = (coarse.advice > 0.0) & (coarse.advice < scene.step) & (begin <= times) & (times <= until)
        assert coarse.warned <= until or advised.any()
    if errors.max() < SMALL:
        assert not np.isfinite(coarse.warned)


class PickUp(Coupling):
    """Launch of a pick-up on split friction: the host has wheels and tyres, and drives both sides by speed, Jacobi, held."""

    def __init__(self, step, sign):
        self.kind, self.master, self.is_line, self.step, self.car_mass, self.torque = "wheels", "jacobi", False, step, 2400.0, sign * 2200.0
        self.values = {"geometry.module": 6e-3, "geometry.planet_teeth": 10, "geometry.side_teeth": 16, "geometry.planet_count": 4,
                       "geometry.face_width": 17e-3, "geometry.backlash": 0.15e-3, "contact.law": "line", "inertia.carrier": 2.9,
                       "scene.carrier_drive": "torque", "carrier.torque_command": 0.0, "effects.coupling_advice": True,
                       "coupling.host_delay": 0.5}
        for side in SIDES:
            self.values |= {f"scene.{side}_drive": "speed", f"{side}.speed_command": 0.0, f"half_shaft.{side}_stiffness": 14000.0}
        self.hosts = lambda: [Wheel(Tyre(friction, 5900.0, 0.372, 70000.0), 1.6, 0.0) for friction in (0.3, 0.9)]


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("step", [2e-3, 3e-3])
def test_a_spinning_wheel_does_not_hide_an_unstable_cut(fmu, step, sign):
    found = run(fmu, PickUp(step, sign), step, stop=1.0)
    # the swing of both torques grows with the spinning wheel, whose energy grows faster
    assert found.warned < 1.0 and "unstable cut at the left side" in found.message
    assert 0.0 < found.advice[-1] < step


def test_a_stable_cut_behind_a_spinning_wheel_gets_no_warning(fmu):
    assert not np.isfinite(run(fmu, PickUp(1e-3, 1.0), 1e-3, stop=1.0).warned)
