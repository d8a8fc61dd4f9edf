"""Peak-to-peak values over mesh cycles, against a recording in steps of a microsecond and in fmpy's own loop."""

from math import pi

import numpy as np
import pytest

SPEEDS = ["left.speed", "right.speed"]
ERRORS = [f"planet[{i}].{side}_transmission_error" for i in (1, 2) for side in ("left", "right")]
NAMES = SPEEDS + ERRORS
# a tooth passes in 21 ms
TURN = {"effects.mesh_history": True, "scene.planet_spin": "imposed", "carrier.speed_command": 16.65,
        "spin.command": 30.0, "left.load_torque": 400.0, "right.load_torque": 400.0}
STOP = 0.045


def peaks(opened):
    return np.array(opened.read([f"{name}_peak_to_peak" for name in NAMES]))


def test_values_are_those_of_a_dense_recording(fmu):
    with fmu.open() as opened:
        opened.initialise(TURN)
        angles = ["left.angle", "right.angle"]
        rows = [opened.read(NAMES + angles)]
        for k in range(round(STOP * 1e6)):
            opened.do_step(k * 1e-6, 1e-6)
            rows.append(opened.read(NAMES + angles))
        found = peaks(opened)
    rows = np.array(rows)
    rolled = 0.5 * (rows[:, -2] - rows[:, -1]) * 16 / (2.0 * pi)
    rolled = np.abs(rolled - rolled[0])
    whole = int(rolled[-1])
    assert whole == 2
    cycle = rows[(rolled >= whole - 1) & (rolled <= whole), :len(NAMES)]
    assert found == pytest.approx(np.ptp(cycle, axis=0), rel=1e-3)


def test_values_do_not_depend_on_communication_steps_or_on_the_sense_of_the_turn(run):
    names = [f"{name}_peak_to_peak" for name in NAMES]

    def last(values, step):
        record = run(values, stop=STOP, step=step, output=names)
        return np.array([record[name][-1] for name in names])

    coarse, fine = last(TURN, 5e-3), last(TURN, 1e-4)
    assert fine == pytest.approx(coarse, rel=1e-8)
    reverse = {name: -value if isinstance(value, float) else value for name, value in TURN.items()}
    assert last(reverse, 5e-3) == pytest.approx(coarse, rel=1e-6)


def test_a_smaller_tolerance_changes_little(run):
    names = [f"{name}_peak_to_peak" for name in NAMES]

    def last(tolerance):
        record = run(TURN | {"solver.relative_tolerance": tolerance}, stop=STOP, step=5e-3, output=names)
        return np.array([record[name][-1] for name in names])

    assert last(1e-6) == pytest.approx(last(1e-9), rel=2e-3)
