"""Cases that break careless solvers, on the packaged FMU: each must stay stable and keep its energy."""

import numpy as np
import pytest
import theory
from fmpy.fmi1 import FMICallException

TURN = {"scene.start": "rolling", "scene.planet_spin": "imposed", "carrier.speed_command": (954.0, "deg/s"),
        "planet.spin_command": (200.0, "deg/s")}
CARRIER = np.radians(2861.0)
SIDES = ["left", "right"]
DISCARD, ERROR = 2, 3


def steps(opened, stop, step=1e-3, begin=0.0, each=None):
    """Steps an opened instance from `begin` to `stop`, calling `each(time)` before every step."""
    for k in range(round((stop - begin) / step)):
        time = begin + k * step
        if each:
            each(time)
        opened.fmu.doStep(time, step)


def started(opened, **values):
    for name, value in values.items():
        opened.set(name.replace("__", "."), value)
    opened.initialise()


def residual(opened):
    """Energy residual over the heat that the teeth made, which is what a transient has to account for [J/J]."""
    return abs(opened.get("solver.energy_residual")) / max(opened.get("heat.contact"), 1e-3)


def assert_straight(opened, sign=1.0):
    for side in SIDES:
        assert opened.get(f"{side}.speed") == pytest.approx(CARRIER, rel=1e-6)
        assert opened.get(f"{side}.tangential_force") == pytest.approx(sign * theory.TANGENTIAL_FORCE, rel=1e-6)
        assert opened.get(f"planet[1].{side}_normal_force") == pytest.approx(theory.normal_force(), rel=1e-6)


def test_both_loads_reversed_and_back_cross_the_play_and_settle(open_fmu):
    with open_fmu() as opened:
        started(opened, scene__start="rolling")
        peak = 0.0
        time = 0.0
        for sign in [1.0, -1.0, 1.0, -1.0]:
            for side in SIDES:
                opened.set(f"{side}.load_torque", sign * theory.LOAD)
            for _ in range(100):
                opened.fmu.doStep(time, 1e-4)
                time += 1e-4
                peak = max(peak, opened.get("planet[1].left_normal_force"))
            steps(opened, time + 0.09, begin=time)
            time += 0.09
            assert_straight(opened, sign)
            # drive flanks touch under positive load; under negative load they stand a whole play apart
            error = opened.get("planet[1].left_transmission_error")
            assert error > 0.0 if sign > 0.0 else error < -2.0 * theory.half_play_arc() * theory.MEAN_CONE
        # blows of one fall through the play: far below what undamped teeth would feel from four added up
        assert peak < 6.0 * theory.normal_force()
        assert residual(opened) < 5e-3


def test_a_start_from_rest_settles_to_the_state_of_a_rolling_start(open_fmu):
    ends = []
    for start in ["rest", "rolling", "equilibrium"]:
        with open_fmu() as opened:
            started(opened, scene__start=start)
            steps(opened, 0.1)
            assert_straight(opened)
            assert residual(opened) < 1e-4
            ends.append([opened.get("planet[1].left_transmission_error"), opened.get("planet[1].right_pairs")])
    np.testing.assert_allclose(ends, [ends[0]] * 3, rtol=1e-5)


@pytest.mark.parametrize("step", [1e-5, 1e-4, 1e-3, 1e-2, 1e-1])
def test_the_communication_step_does_not_change_the_trajectory(run, step):
    output = ["left.speed", "right.speed", "planet[1].left_normal_force", "solver.energy_residual"]
    record, reference = run(TURN, stop=0.5, step=step, output=output), run(TURN, stop=0.5, step=5e-4, output=output)
    common = np.isin(np.round(record["time"], 9), np.round(reference["time"], 9))
    common_reference = np.isin(np.round(reference["time"], 9), np.round(record["time"], 9))
    assert np.count_nonzero(common) >= 6
    for side in SIDES:
        late = record["time"][common] > 0.005
        np.testing.assert_allclose(record[f"{side}.speed"][common][late],
                                   reference[f"{side}.speed"][common_reference][late], rtol=3e-6)
    assert abs(record["solver.energy_residual"][-1]) < 1e-2


def test_irregular_communication_steps_give_the_same_end(open_fmu):
    ends = []
    for seed in [1, 2, 3]:
        random = np.random.default_rng(seed)
        with open_fmu() as opened:
            for name, value in TURN.items():
                opened.set(name, np.radians(value[0]) if isinstance(value, tuple) else value)
            opened.initialise()
            time = 0.0
            while time < 0.3:
                step = min(10.0 ** random.uniform(-6.0, -1.3), 0.3 - time)
                opened.fmu.doStep(time, step)
                time += step
            ends.append([opened.get(f"{side}.speed") for side in SIDES])
    np.testing.assert_allclose(ends, [ends[0]] * 3, rtol=3e-6)


def test_an_undamped_turn_keeps_its_energy_and_better_at_tighter_tolerance(run):
    for start in ["equilibrium", "rolling"]:
        shares = []
        for tolerance in [1e-4, 1e-6, 1e-8]:
            values = TURN | {"scene.start": start, "contact.damping": 0.0, "solver.relative_tolerance": tolerance}
            record = run(values, step=1e-4, output=["solver.energy_residual", "power.in", "power.out"])
            turnover = np.sum(np.abs(record["power.in"]) + np.abs(record["power.out"])) * 1e-4
            shares.append(abs(record["solver.energy_residual"][-1]) / turnover)
        assert shares[1] < 1e-6 and shares[2] < shares[1] < shares[0] and shares[2] < 0.1 * shares[0], (start, shares)


@pytest.mark.parametrize("extra", [1.0, 20.0])
def test_a_small_imbalance_is_held_by_the_teeth(open_fmu, extra):
    with open_fmu() as opened:
        started(opened, scene__start="rolling", left__load_torque=theory.LOAD + extra)
        steps(opened, 0.6)
        for side in SIDES:
            assert opened.get(f"{side}.speed") == pytest.approx(CARRIER, rel=1e-5)
        assert abs(opened.get("planet[1].spin_angle")) < 0.1


def test_a_large_imbalance_rolls_and_the_lighter_side_is_faster(open_fmu):
    with open_fmu() as opened:
        started(opened, scene__start="rolling", left__load_torque=theory.LOAD + 60.0)
        steps(opened, 0.05)
        assert opened.get("right.speed") > CARRIER + 10.0
        assert opened.get("left.speed") < CARRIER - 10.0
        assert opened.get("planet[1].spin_speed") < -10.0
        assert residual(opened) < 1e-3


def test_the_ideal_differential_accelerates_by_its_closed_form(open_fmu):
    ratio, planet, side = theory.PLANET_TEETH / theory.SIDE_TEETH, 2e-5, 9e-5
    with open_fmu() as opened:
        started(opened, scene__gear_contact="ideal", inertia__from_geometry=False, inertia__planet=planet,
                inertia__side_gear=side, left__load_torque=theory.LOAD + 1.0)
        steps(opened, 0.1)
        spin = -ratio / (2.0 * ratio**2 * side + theory.PLANETS * planet)
        assert opened.get("planet[2].spin_speed") == pytest.approx(0.1 * spin, rel=1e-10)
        assert opened.get("right.acceleration") == pytest.approx(-ratio * spin, rel=1e-10)
        assert opened.get("left.speed") + opened.get("right.speed") == pytest.approx(2.0 * CARRIER, rel=1e-12)


@pytest.mark.parametrize("planet, side, count", [(9, 14, 4), (11, 15, 2), (10, 18, 3), (10, 18, 4)])
@pytest.mark.parametrize("start", ["equilibrium", "rolling"])
def test_other_teeth_and_phases_carry_the_load_too(open_fmu, planet, side, count, start):
    with open_fmu() as opened:
        started(opened, scene__start=start, geometry__planet_teeth=planet, geometry__side_teeth=side,
                geometry__planet_count=count)
        steps(opened, 0.4)
        for s in SIDES:
            assert opened.get(f"{s}.speed") == pytest.approx(CARRIER, rel=1e-5)
            torque = opened.get(f"{s}.tangential_force") * theory.MODULE * side / 2.0
            assert torque == pytest.approx(theory.LOAD, rel=1e-5)
        assert residual(opened) < 1e-3


def test_a_torque_driven_carrier_in_balance_keeps_its_speed(open_fmu):
    with open_fmu() as opened:
        started(opened, scene__carrier_drive="torque", carrier__torque_command=2.0 * theory.LOAD)
        steps(opened, 0.2)
        assert_straight(opened)
        # and accelerates as one body when the torque grows
        opened.set("carrier.torque_command", 2.0 * theory.LOAD + 100.0)
        before = opened.get("carrier.speed")
        steps(opened, 0.3, begin=0.2)
        gained = opened.get("carrier.speed") - before
        assert opened.get("left.speed") - before == pytest.approx(gained, rel=1e-3)
        assert 100.0 * 0.1 / gained == pytest.approx(0.02 + 2 * 9e-5, rel=0.05)


def test_one_wheel_on_ice_accelerates_by_the_inertias_of_its_ends(open_fmu):
    with open_fmu() as opened:
        started(opened, scene__start="rolling", inertia__left_end=1.0, inertia__right_end=1.0, left__load_torque=0.0)
        steps(opened, 0.2)
        # carrier imposed: ω_L + ω_R stays, and I (ω̇_L − ω̇_R) = T_R but for the light gears
        difference = opened.get("left.speed") - opened.get("right.speed")
        assert difference == pytest.approx(theory.LOAD * 0.2, rel=2e-3)
        assert opened.get("left.speed") + opened.get("right.speed") == pytest.approx(2.0 * CARRIER, rel=2e-2)
        assert residual(opened) < 1e-3


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_efficiency_stays_below_one_in_driving_and_in_overrun(run, sign):
    values = TURN | {f"{side}.load_torque": sign * theory.LOAD for side in SIDES}
    record = run(values, output=["efficiency", "power.loss", "power.in", "power.out"])
    assert np.all(record["power.loss"] >= 0.0)
    assert np.all(record["efficiency"] <= 1.0)
    settled = record["efficiency"][record["time"] > 0.05]
    assert np.min(settled) > 0.99
    # over whole mesh cycles what goes in comes out, less the loss
    cycles = record[(record["time"] > 0.14 - 1e-9)][:-1]
    balance = np.mean(cycles["power.in"]) - np.mean(cycles["power.out"]) - np.mean(cycles["power.loss"])
    assert abs(balance) < 1e-4 * np.mean(np.abs(cycles["power.out"]))


def test_a_tooth_that_would_jump_is_an_error_with_time_and_place(open_fmu):
    with open_fmu() as opened:
        opened.initialise()
        opened.fmu.doStep(0.0, 1e-3)
        opened.set("right.load_torque", 5e6)
        with pytest.raises(FMICallException) as failure:
            opened.fmu.doStep(1e-3, 1e-3)
        assert failure.value.status == DISCARD
        message = opened.log[-1]
        assert "a tooth would jump between planet[1] and the right side gear" in message and "t = 0.001" in message


def test_a_load_that_no_tooth_can_carry_is_refused_at_the_start(open_fmu):
    for load in [0.7e6, 1.5e6, 1e8]:
        with open_fmu() as opened:
            for side in SIDES:
                opened.set(f"{side}.load_torque", load)
            with pytest.raises(FMICallException) as refusal:
                opened.initialise()
            assert refusal.value.status == ERROR
            assert "left.load_torque" in opened.log[-1] and "working depth" in opened.log[-1]


def test_an_hour_of_driving_drifts_neither_in_speed_nor_in_force(open_fmu):
    with open_fmu() as opened:
        opened.initialise()
        steps(opened, 3600.0, step=0.1)
        assert_straight(opened)
        assert opened.get("carrier.angle") == pytest.approx(3600.0 * CARRIER, rel=1e-12)
    with open_fmu() as opened:
        for name, value in TURN.items():
            opened.set(name, np.radians(value[0]) if isinstance(value, tuple) else value)
        opened.initialise()
        steps(opened, 1800.0, step=0.18)
        # after ten thousand whole mesh periods the teeth stand as at the start
        assert opened.get("planet[1].spin_angle") == pytest.approx(1800.0 * np.radians(200.0), rel=1e-11)
        assert opened.get("left.tangential_force") == pytest.approx(theory.TANGENTIAL_FORCE, rel=1e-6)
        ratio = theory.PLANET_TEETH / theory.SIDE_TEETH
        wind_up = opened.get("carrier.angle") + ratio * opened.get("planet[1].spin_angle") - opened.get("left.angle")
        assert wind_up == pytest.approx(theory.half_play() + theory.largest_wind_up(), abs=1e-5)
