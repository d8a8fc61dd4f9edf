"""Losses of the final drive: torque at the port in all quadrants, friction that holds, efficiency, and heat."""

import numpy as np
import pytest
from final_drive_reference import port_torque
from final_drive_scenes import DRIVEN, RATIO, UNLOADED, loads, turning_inertia

SAME = 1e-9
# relative to the energy turned over, of the solver at its default tolerance
BALANCE = 1e-6
AMBIENT = 290.0
FRICTION, DRIVE, COAST, VISCOUS = 2.5, 0.04, 0.07, 0.012
LOSSES = {"final_drive.friction_torque": FRICTION, "final_drive.drive_loss": DRIVE, "final_drive.coast_loss": COAST,
          "final_drive.viscous": VISCOUS}
QUADRANTS = [(speed, torque) for speed in (90.0, -90.0) for torque in (1500.0, -1500.0)]
BOTH = pytest.mark.parametrize("elastic", [False, True])
EACH = pytest.mark.parametrize("speed, torque", QUADRANTS)


def scene(elastic, contact="ideal"):
    return {"effects.final_drive": True, "final_drive.elastic_mesh": elastic, "scene.gear_contact": contact}


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
@pytest.mark.parametrize("losses", [LOSSES, {"final_drive.friction_torque": FRICTION}, {"final_drive.viscous": VISCOUS},
                                    {"final_drive.drive_loss": DRIVE, "final_drive.coast_loss": COAST}])
@BOTH
@EACH
def test_a_steady_pinion_needs_the_torque_of_a_hand_calculation(started, contact, elastic, losses, speed, torque):
    friction, drive, coast, viscous = (losses.get(name, 0.0) for name in LOSSES)
    expected = port_torque(speed, torque, RATIO, friction, (drive, coast), viscous)
    opened = started(scene(elastic, contact) | loads(torque) | losses | {"pinion.speed_command": speed})
    opened.step(0.3)
    assert opened.get("carrier.torque") == pytest.approx(torque, rel=SAME)
    assert opened.get("pinion.torque") == pytest.approx(expected, rel=SAME)
    assert opened.get("propeller.torque") == pytest.approx(expected, rel=SAME)
    assert opened.get("power.in") == pytest.approx(expected * speed, rel=SAME)


@EACH
@pytest.mark.parametrize("port", [1.5, -0.7])
def test_a_rigid_final_drive_accelerates_with_the_torque_that_friction_leaves(fmu, started, speed, torque, port):
    pinion, more = 0.004, {"inertia.left_end": 2.0, "inertia.right_end": 2.0}
    inertia, command = turning_inertia(fmu, more), port * torque / RATIO
    opened = started(scene(False) | DRIVEN | loads(torque) | LOSSES | more | {
        "inertia.pinion": pinion, "pinion.speed_command": speed, "pinion.torque_command": command})
    opened.step(0.005)
    now, acceleration = opened.get("pinion.speed"), opened.get("carrier.acceleration")
    ring, s = opened.get("carrier.torque"), np.sign(now)
    assert s == np.sign(speed)
    # T (1 + s c1 sgn T) = i (T_p - s c0 - d omega_p) - i^2 J_p a, and T = J a + load
    solutions = []
    for way, loss in ((1.0, DRIVE), (-1.0, COAST)):
        factor = 1.0 + s * way * loss
        a = (RATIO * (command - s * FRICTION - VISCOUS * now) - factor * torque) / (factor * inertia + RATIO**2 * pinion)
        if way * (inertia * a + torque) > 0.0:
            solutions.append(a)
    assert len(solutions) == 1
    assert acceleration == pytest.approx(solutions[0], rel=SAME)
    assert ring == pytest.approx(inertia * solutions[0] + torque, rel=SAME)


@pytest.mark.parametrize("drive, coast", [(0.98, 0.98), (0.9, 0.95)])
@BOTH
def test_an_efficiency_gives_the_coefficient_of_drive_and_of_overrun(started, elastic, drive, coast):
    values = {"final_drive.drive_loss": 1.0 / drive - 1.0, "final_drive.coast_loss": 1.0 - coast}
    for torque, wanted in ((800.0, drive), (-800.0, coast)):
        opened = started(scene(elastic) | loads(torque) | values | {"pinion.speed_command": 100.0})
        opened.step(0.3)
        assert opened.get("efficiency") == pytest.approx(wanted, rel=SAME)


@BOTH
@pytest.mark.parametrize("load", [600.0, -600.0])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_friction_holds_a_shaft_at_rest_up_to_its_limit(started, elastic, load, way):
    limit, stiffness = FRICTION + (DRIVE if load > 0.0 else COAST) * abs(load) / RATIO, 1e4
    still = LOSSES | {"final_drive.viscous": 0.0, "final_drive.holding_stiffness": stiffness, "scene.start": "rest"}
    for share in (0.5, 0.97, 1.03):
        command = load / RATIO + way * share * limit
        opened = started(scene(elastic) | DRIVEN | loads(load) | still | {"pinion.torque_command": command,
                                                                          "pinion.speed_command": 0.0})
        opened.step(1.0)
        before = opened.get("pinion.angle")
        opened.step(1.0)
        speed, angle = opened.read(["pinion.speed", "pinion.angle"])
        if share < 1.0:
            assert abs(speed) < 1e-6 and abs(angle - before) < 1e-6
        else:
            assert way * speed > 1.0


@BOTH
def test_a_pinion_that_rolls_out_stops_and_stays(fmu, started, elastic):
    opened = started(scene(elastic) | DRIVEN | UNLOADED | {"final_drive.friction_torque": FRICTION, "pinion.torque_command": 0.0,
                                                           "pinion.speed_command": 50.0})
    opened.step(2.0)
    before = opened.get("pinion.angle")
    opened.step(1.0)
    assert abs(opened.get("pinion.speed")) < 1e-6
    assert opened.get("pinion.angle") == pytest.approx(before, abs=1e-6)
    if not elastic:
        # angle of a steady deceleration; with lash, the carrier overtakes the pinion and its blows cost energy
        inertia = turning_inertia(fmu) / RATIO**2 + 0.003
        assert before == pytest.approx(0.5 * inertia * 50.0**2 / FRICTION, rel=1e-3)


@BOTH
@EACH
def test_the_loss_warms_the_oil(started, elastic, speed, torque):
    loss = (port_torque(speed, torque, RATIO, FRICTION, (DRIVE, COAST), VISCOUS) - torque / RATIO) * speed
    warm = scene(elastic) | loads(torque) | LOSSES | {"pinion.speed_command": speed, "effects.warm_up": True,
                                                      "warm_up.ambient_temperature": AMBIENT, "oil.temperature": AMBIENT}
    opened = started(warm)
    opened.step(600.0)
    heat = opened.get("heat.final_drive")
    assert heat == pytest.approx(600.0 * loss, rel=1e-6)
    assert opened.get("warm_up.stored") + opened.get("warm_up.given_off") == pytest.approx(heat, rel=1e-6)
    steady = started(warm | {"scene.start": "steady_heat"})
    # start values: 30 W/K from oil to case, 10 W/K and 0.1 W·s/(K·rad) from case to ambient
    case = AMBIENT + loss / (10.0 + 0.1 * abs(speed) / RATIO)
    assert steady.get("temperature.case") == pytest.approx(case, rel=1e-5)
    assert steady.get("temperature.oil") == pytest.approx(case + loss / 30.0, rel=1e-5)


@BOTH
@EACH
def test_heat_equals_work(started, elastic, speed, torque):
    opened = started(scene(elastic) | loads(torque) | LOSSES | {"pinion.speed_command": speed})
    opened.step(0.3)
    begin = np.array(opened.read(["heat.final_drive", "pinion.angle"]))
    opened.step(1.0)
    heat, angle = opened.read(["heat.final_drive", "pinion.angle"]) - begin
    lost = port_torque(speed, torque, RATIO, FRICTION, (DRIVE, COAST), VISCOUS) - torque / RATIO
    assert angle == pytest.approx(speed, rel=SAME)
    assert heat == pytest.approx(lost * speed, rel=SAME)
    assert opened.get("power.loss") == pytest.approx(lost * speed, rel=SAME)
    assert abs(opened.get("solver.energy_residual")) < BALANCE * abs(torque * speed / RATIO)


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
@pytest.mark.parametrize("drive", ["torque", "speed"])
@BOTH
def test_the_ledger_closes_while_the_shaft_stops_and_turns_back(fmu, started, contact, elastic, drive):
    values = scene(elastic, contact) | loads(80.0) | LOSSES | {
        "scene.carrier_drive": drive, "scene.start": "rest", "pinion.speed_command": 0.0, "inertia.left_end": 0.1,
        "inertia.right_end": 0.1}
    turned_over, step = 0.0, 1e-3
    opened = started(values)
    for k in range(400):
        course = np.sin(2.0 * np.pi * k / 200.0)
        opened.set({"pinion.torque_command": 60.0 * course} if drive == "torque" else {"pinion.speed_command": 20.0 * course})
        before = np.abs(opened.read(["power.in", "power.out"]))
        opened.step(step)
        turned_over += 0.5 * step * np.sum(before + np.abs(opened.read(["power.in", "power.out"])))
    heats = [name for name in fmu.variables if name.startswith("heat.")]
    turned_over += sum(opened.read(heats))
    assert opened.get("heat.final_drive") > 1.0
    assert abs(opened.get("solver.energy_residual")) < BALANCE * turned_over


@pytest.mark.parametrize("load", [300.0, -300.0])
def test_friction_of_an_elastic_mesh_follows_its_torque_while_it_swings(started, load):
    pinion, speed = 0.004, 60.0
    names = ["pinion.torque", "carrier.torque", "pinion.speed", "der(pinion.carrier_speed)"]
    opened = started(scene(True) | DRIVEN | loads(load) | LOSSES | {
        "inertia.pinion": pinion, "pinion.speed_command": speed, "pinion.torque_command": load / RATIO, "final_drive.damping": 300.0,
        "inertia.left_end": 0.5, "inertia.right_end": 0.5})
    seen = []
    for k in range(60):
        # blows to both sides of the lash
        opened.set({"pinion.torque_command": load / RATIO + (40.0 if k % 20 < 10 else -3.0 * load / RATIO)})
        opened.step(2.3e-4)
        seen.append(opened.read(names))
    port, ring, turning, acceleration = np.array(seen).T
    assert turning.min() > 5.0 and ring.min() < -10.0 and ring.max() > 10.0
    expected = [port_torque(*each, RATIO, FRICTION, (DRIVE, COAST), VISCOUS) for each in zip(turning, ring)]
    off = port - pinion * RATIO * acceleration - np.array(expected)
    assert np.abs(off).max() < SAME * (np.abs(port).max() + np.abs(ring).max())
