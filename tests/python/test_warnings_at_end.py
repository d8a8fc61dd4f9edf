"""Warnings at the end of a run: fixed steps that are too long, planets that rolled too little for their rating, and speeds that run away."""

import warnings

import pytest

from bevel_differential import Differential, differential

AXLE = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "carrier.torque_command": 1670.0}
# teeth that strike first
FRICTION = {**AXLE, "scene.start": "rest", "effects.thrust_friction": True, "effects.tooth_friction": True, "left.speed_command": 52.5, "right.speed_command": 47.5}
TURN = {"scene.gear_contact": "lumped", "scene.planet_spin": "imposed", "effects.strength": True}


def warned(values, stop, step=1e-3):
    """Warnings of a run, and its record."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        record = Differential(values).run(outputs=["left.shaft_torque", "right.shaft_torque"], stop=stop, step=step)
    return [str(each.message) for each in found], record


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_fixed_steps_that_lose_energy_are_reported_and_short_ones_are_not(sign):
    values = {**FRICTION, "solver.method": "fixed_step", "carrier.torque_command": sign * 1670.0}
    right = {}
    for size in (2e-3, 1e-4):
        texts, record = warned({**values, "solver.fixed_step": size}, 0.3, max(size, 1e-3))
        told = [text for text in texts if text.startswith("solver.fixed_step: steps of")]
        right[size] = 1.0 < abs(record["right.shaft_torque"][-1] / record["left.shaft_torque"][-1]) ** sign < 1.3
        assert bool(told) != right[size], (size, texts)
    assert right == {2e-3: False, 1e-4: True}
    # plain teeth need no shorter steps
    texts, _ = warned({**AXLE, "left.speed_command": 51.0, "right.speed_command": 49.0, "solver.method": "fixed_step",
                                 "solver.fixed_step": 1e-3}, 0.3)
    assert not any("too long" in text for text in texts)


@pytest.mark.parametrize("spin", ["120 deg/s", "-120 deg/s"])
@pytest.mark.parametrize("stop, is_told", [(0.1, False), (1.0, True), (1.6, False)])
def test_planets_that_roll_less_than_half_a_revolution_are_reported(spin, stop, is_told):
    # a pitch is 36 degrees
    texts, _ = warned({**TURN, "spin.command": spin}, stop)
    told = [text for text in texts if "no tooth of a planet met both side gears" in text]
    assert len(told) == is_told
    if told:
        assert told[0].startswith("safety.root_min: the planets rolled 120 deg")


def test_straight_ahead_nothing_is_said_about_rolling():
    texts, _ = warned({"scene.gear_contact": "lumped", "effects.strength": True}, 0.2)
    assert not any("rolled" in text for text in texts)


@pytest.mark.parametrize("stops", [False, True])
def test_speeds_that_run_away_are_reported_with_their_cause_also_if_ctrl_c_stops_the_run(monkeypatch, stops):
    advance = differential._advance

    def until_ctrl_c(*arguments):
        advance(*arguments)
        if stops:
            raise KeyboardInterrupt

    monkeypatch.setattr(differential, "_advance", until_ctrl_c)
    # wheels without inertia under unequal loads
    unit = Differential({"scene.gear_contact": "lumped", "left.load_torque": 0.0})
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        try:
            unit.run(outputs=["left.speed"], stop=0.02)
            assert not stops
        except KeyboardInterrupt:
            assert stops
    told = [str(each.message) for each in found if "faster than any differential turns" in str(each.message)]
    assert len(told) == 1 and "inertia.left_end" in told[0]
