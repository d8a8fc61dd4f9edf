"""Communication steps from microseconds to hours, and a day of driving: the same trajectory, and no drift."""

import numpy as np
import pytest
import theory
from driving import CARRIER, SIDES, TURN, UNDAMPED

DAY = 86400.0


@pytest.fixture(scope="module")
def fine(run):
    return run(TURN, stop=0.5, step=5e-4, output=[f"{side}.speed" for side in SIDES])


@pytest.mark.parametrize("step", [1e-5, 1e-4, 1e-3, 1e-2, 1e-1])
def test_the_communication_step_does_not_change_the_trajectory(drive, fine, step):
    scene, record = drive(TURN), []
    scene.to(min(0.5, 2e4 * step), step, lambda s: record.append((s.time, *s.read([f"{side}.speed" for side in SIDES]))))
    compared = 0
    for time, left, right in record:
        k = np.searchsorted(fine["time"], time - 1e-9)
        # past the first blows, where a speed that turns within microseconds is a matter of the tolerance
        if time > 0.005 and abs(fine["time"][k] - time) < 1e-9:
            assert [left, right] == pytest.approx([fine["left.speed"][k], fine["right.speed"][k]], rel=3e-6), time
            compared += 1
    assert compared >= 5
    assert scene.imbalance() < UNDAMPED


def test_irregular_communication_steps_give_the_same_end(drive):
    ends = []
    for seed in [1, 2, 3]:
        random, scene = np.random.default_rng(seed), drive(TURN)
        while scene.time < 0.5 - 1e-12:
            scene.step(min(10.0 ** random.uniform(-6.0, -1.0), 0.5 - scene.time))
        ends.append(scene.read([f"{side}.speed" for side in SIDES]))
        assert scene.imbalance() < UNDAMPED
    np.testing.assert_allclose(ends, [ends[0]] * 3, rtol=3e-6)


@pytest.mark.parametrize("step", [10.0, 60.0])
def test_a_day_of_straight_driving_drifts_neither_in_speed_nor_in_force(drive, step):
    scene = drive({"scene.start": "rolling"}).to(DAY, step)
    for side in SIDES:
        assert scene[f"{side}.speed"] == pytest.approx(CARRIER, rel=1e-6)
        assert scene[f"{side}.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    # 4.3 million radians: what both side gears lag behind in the mean, wherever the free planets came to rest, is still
    # exact to less than a micrometre at the teeth
    lag = scene["carrier.angle"] - 0.5 * (scene["left.angle"] + scene["right.angle"])
    assert lag == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene["carrier.angle"] == pytest.approx(DAY * CARRIER, rel=1e-12)
    assert scene.imbalance() < UNDAMPED


def test_a_day_in_a_slow_turn_leaves_the_teeth_as_they_stood_at_the_start(drive):
    # five mesh periods an hour and a half: 80 in a day
    spin = 80.0 * 2.0 * np.pi / theory.PLANET_TEETH / DAY
    scene = drive(TURN | {"scene.start": "equilibrium", "spin.command": spin})
    begin = scene["left.tangential_force"]
    scene.to(DAY, 60.0)
    ratio = theory.PLANET_TEETH / theory.SIDE_TEETH
    assert scene["planet[1].spin_angle"] == pytest.approx(DAY * spin, rel=1e-11)
    assert scene["left.tangential_force"] == pytest.approx(begin, rel=1e-6)
    assert begin == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    for side, expected in zip(SIDES, theory.side_speeds(np.radians(954.0), spin)):
        assert scene[f"{side}.speed"] == pytest.approx(expected, rel=1e-6)
    wind_up = scene["carrier.angle"] + ratio * scene["planet[1].spin_angle"] - scene["left.angle"]
    assert wind_up == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene.imbalance() < UNDAMPED


def test_ten_minutes_in_the_study_s_turn_leave_the_teeth_as_they_stood_at_the_start(drive):
    # more than three thousand whole mesh periods
    scene = drive(TURN).to(594.0, 0.18)
    assert scene["planet[1].spin_angle"] == pytest.approx(594.0 * np.radians(200.0), rel=1e-11)
    assert scene["left.tangential_force"] == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
    ratio = theory.PLANET_TEETH / theory.SIDE_TEETH
    wind_up = scene["carrier.angle"] + ratio * scene["planet[1].spin_angle"] - scene["left.angle"]
    assert wind_up == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
    assert scene.imbalance() < UNDAMPED
