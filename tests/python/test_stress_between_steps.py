"""Stresses are rated at the ends of steps whose dense output is unknown: steps of a host's solver, and fixed steps."""

import numpy as np
import pytest

CONTACT, BENDING, IDLER = 1500e6, 1000e6, 0.7
STRESSES = ["stress.contact_rated", "stress.root_planet_max", "stress.root_side_max"]
OUTPUTS = [*STRESSES, "safety.flank_min", "safety.root_min"]
LOADS = ["left.load_torque", "right.load_torque"]
BASE = {"effects.strength": True, "contact.law": "line"}
BY_TORQUE = {"scene.carrier_drive": "torque", "inertia.carrier": 0.3, "carrier.speed_command": 30.0, "carrier.torque_command": 600.0}
SHAFTS = {"effects.half_shaft": True, "inertia.left_end": 1.0, "inertia.right_end": 1.0}
TURN = {"scene.planet_spin": "imposed", "carrier.speed_command": 16.65, "spin.command": 3.5}
# parameters, and loads of both sides with a jump at 0.02 s
SCENES = {f"{contact}{name}": ({"scene.gear_contact": contact, **values}, loads)
          for contact in ("lumped", "tooth") for name, values, loads in (
              ("", {}, (0.0, 800.0)), (", by torque", BY_TORQUE, (300.0, 100.0)), (", half-shafts", BY_TORQUE | SHAFTS, (300.0, 900.0)),
              (" turn", TURN, (200.0, 900.0)), (", reversed", SHAFTS, (500.0, -500.0)))}
STOP, JUMP, STEP = 0.06, 0.02, 1e-3
WAYS = ["model exchange", "fixed_step"]


def record(run, through_fmpy, way, values, loads):
    """Record of all completed steps: fmpy completes one step per output interval."""
    before, after = loads
    if way == "fixed_step":
        tables = dict.fromkeys(LOADS, (np.array([0.0, JUMP, JUMP]), np.array([before, before, after])))
        return run(values | {"solver.method": "fixed_step", "solver.fixed_step": STEP}, STOP, STEP, OUTPUTS, tables)
    rows = [(0.0, before, before), (JUMP, before, before), (JUMP, after, after), (STOP, after, after)]
    signals = np.array(rows, dtype=[(name, float) for name in ["time", *LOADS]])
    return through_fmpy(values | dict.fromkeys(LOADS, before), STOP, fmi_type="ModelExchange", input=signals, output=OUTPUTS,
                        output_interval=STEP, relative_tolerance=1e-6)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("scene", SCENES)
def test_the_rated_stress_is_the_largest_of_the_completed_steps(run, through_fmpy, scene, way):
    values, loads = SCENES[scene]
    rows = record(run, through_fmpy, way, BASE | values, loads)
    pressure, planet, side = (rows[name].max() for name in STRESSES)
    assert pressure > 100e6
    rated = CONTACT / rows["safety.flank_min"][-1]
    assert rated == pytest.approx(pressure, rel=1e-6)
    # the safety of the roots follows from cycles, which do at most the damage of a pulsating stress of 1/Y_M times their peak
    root = BENDING / rows["safety.root_min"][-1]
    assert root <= max(planet, side) / IDLER * (1.0 + 1e-6)
    if loads[0] == 0.0:
        # the load pulsates from zero
        assert root >= max(planet, side) * (1.0 - 1e-6)


def after_jump(fmu, values, loads, steps):
    """Largest contact stress at the ends of `steps` after a jump of the loads, and the largest rated contact stress."""
    with fmu.open() as opened:
        opened.initialise(BASE | values | dict.fromkeys(LOADS, loads[0]))
        opened.step(JUMP)
        opened.set(dict.fromkeys(LOADS, loads[1]))
        pressures = []
        for step in steps:
            opened.step(step)
            pressures.append(opened.get("stress.contact_rated"))
        return max(pressures), CONTACT / opened.get("safety.flank_min")


@pytest.mark.parametrize("scene", ["lumped", "lumped turn", "tooth turn"])
def test_co_simulation_rates_the_ring_down_after_a_jump_between_communication_points(fmu, scene):
    values, loads = SCENES[scene]
    read, fine = after_jump(fmu, values, loads, [5e-7] * 160)
    seldom, coarse = after_jump(fmu, values, loads, [1e-3])
    assert fine == pytest.approx(read, rel=5e-3) and coarse == pytest.approx(fine, rel=1e-3)
    # the teeth vibrate about the load that remains
    assert fine > 1.1 * seldom
