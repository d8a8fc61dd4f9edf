"""Side gears that press the plates of their clutch packs: locking values in closed form, and a published table."""

import math

import numpy as np
import pytest
import theory

from bevel_differential import Clutch, Differential, DifferentialError

# tan of the pressure angle of the start values
TANGENT = math.tan(theory.PRESSURE_ANGLE)
# wheels at imposed speeds, so that both packs slip
TURN = {"scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed", "carrier.torque_command": 400.0,
        "left.speed_command": 52.0, "right.speed_command": 48.0, "half_shaft.left_damping": 200.0, "half_shaft.right_damping": 200.0,
        "effects.limited_slip": True}
# ramp angle from the plane of rotation [deg], rubbing faces on each side, locking value [%]
FACES_AND_RAMPS = [(80, 2, 13), (60, 2, 19), (80, 4, 25), (45, 2, 27), (80, 6, 38), (60, 4, 39), (30, 2, 39), (45, 4, 53), (60, 6, 58)]


def settled(fmu, values, stop=0.3):
    """Shaft torques of both wheels at the end."""
    with Differential(TURN | values, fmu=fmu.file) as turn:
        record = turn.run(outputs=["left.shaft_torque", "right.shaft_torque"], stop=stop, step=1e-3)
        return np.array([record[f"{side}.shaft_torque"][-20:].mean() for side in ("left", "right")])


def locking_value(torques):
    return (torques[1] - torques[0]) / torques.sum()


@pytest.mark.parametrize("angle, faces, published", FACES_AND_RAMPS)
def test_published_locking_values_of_ramps_and_gears_follow_from_two_ratios(fmu, angle, faces, published):
    # friction times mean radius over the radius of the ramps, and this radius times tan(alpha) over R
    over_ramp, over_cone = 0.0846, 0.569
    ramp_radius = over_cone * theory.RESULTANT / TANGENT
    values = {"scene.gear_contact": "lumped", "limited_slip.pressed_by": "both_sides",
              "limited_slip.torque_coefficient": faces * over_ramp / math.tan(math.radians(angle)),
              "limited_slip.thrust_arm": faces * over_ramp * ramp_radius}
    found = 100.0 * locking_value(settled(fmu, values))
    assert found == pytest.approx(published, abs=0.5)
    assert found == pytest.approx(faces * (100.0 * over_ramp * over_cone + 100.0 * over_ramp / math.tan(math.radians(angle))), rel=1e-5)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("pressed_by", ["own_side", "both_sides"])
def test_thrust_presses_alike_in_drive_and_coast(fmu, pressed_by, sign):
    """Under the mesh torques Q, packs with the coefficient k and the arm a move k L + a |Q| tan(alpha)/R, whatever the coast ratio."""
    kappa, arm, coast = 0.15, 0.02, 0.4
    values = {"scene.gear_contact": "lumped", "limited_slip.pressed_by": pressed_by, "limited_slip.torque_coefficient": kappa,
              "limited_slip.coast_ratio": coast, "limited_slip.thrust_arm": arm, "carrier.torque_command": sign * 400.0}
    left, right = settled(fmu, values)
    share = kappa * (1.0 if sign > 0.0 else coast) + arm * TANGENT / theory.RESULTANT
    # without friction in the gears, both mesh torques are half of the carrier's
    assert (left, right) == pytest.approx((200.0 * (sign - share), 200.0 * (sign + share)), rel=1e-5)


def test_without_thrust_the_locking_value_is_the_coefficient(fmu):
    values = {"scene.gear_contact": "lumped", "limited_slip.torque_coefficient": 0.31, "limited_slip.pressed_by": "both_sides"}
    assert locking_value(settled(fmu, values, 0.6)) == pytest.approx(0.31, abs=1e-6)


def test_plates_take_the_place_of_the_washers_of_side_gears(fmu):
    """Friction of planets is the same with and without plates, so that only washers of the side gears differ."""
    base = {"scene.gear_contact": "lumped", "effects.thrust_friction": True, "limited_slip.preload": 20.0}
    planets_only = settled(fmu, base | {"thrust_friction.side_washer_radius": 0.0})
    washers = settled(fmu, base)
    arm = 0.01
    plates = settled(fmu, base | {"limited_slip.thrust_arm": arm})
    alone, with_washers, with_plates = map(locking_value, (planets_only, washers, plates))
    by_plates = arm * TANGENT / theory.RESULTANT
    assert with_plates - alone == pytest.approx(by_plates, rel=0.02)
    # the washers would add their coefficient times their radius
    assert with_washers - alone == pytest.approx(0.05 * 0.022 * TANGENT / theory.RESULTANT, rel=0.02)
    with Differential(TURN | base | {"limited_slip.thrust_arm": arm, "thrust_friction.side_washer_area": 1e-3}, fmu=fmu.file) as turn:
        turn.run(outputs=["left.speed"], stop=0.01, step=1e-3)
        assert any("thrust_friction.side_washer_area" in text and "limited_slip.thrust_arm" in text for text in turn.warnings)


def test_teeth_have_a_little_less_thrust_because_their_normal_turns(run):
    arm, slip = 0.02, 10.0
    # period of the meshes: a planet's tooth passes
    period = 2.0 * math.pi / (slip * theory.SIDE_TEETH)
    values = {"contact.law": "line", "limited_slip.thrust_arm": arm, "left.speed_command": 50.0 + slip, "right.speed_command": 50.0 - slip}
    points = 40
    record = run(TURN | values, 10 * period, period / points, ["left.shaft_torque", "right.shaft_torque"])
    mean = np.array([record[f"{side}.shaft_torque"][-2 * points:].mean() for side in ("left", "right")])
    share = locking_value(mean) / (arm * TANGENT / theory.RESULTANT)
    assert 0.88 < share < 0.97


@pytest.mark.parametrize("contact", ["ideal", "solid"])
def test_gears_without_thrust_refuse_the_arm(fmu, contact):
    with pytest.raises(DifferentialError, match=f"limited_slip.thrust_arm.*scene.gear_contact = {contact}"):
        settled(fmu, {"scene.gear_contact": contact, "limited_slip.thrust_arm": 0.02}, 1e-3)


def test_packs_that_lock_themselves_by_thrust_are_reported(fmu):
    arm = 0.5 * theory.RESULTANT / TANGENT
    values = TURN | {"scene.gear_contact": "lumped", "limited_slip.torque_coefficient": 0.6}
    for thrust_arm, warned in ((arm, True), (0.5 * arm, False)):
        with Differential(values | {"limited_slip.thrust_arm": thrust_arm}, fmu=fmu.file) as axle:
            axle.run(outputs=["left.speed"], stop=1e-3, step=1e-3)
            assert warned == any("1.1 with thrust_arm is 1 or more" in text for text in axle.warnings)


def test_plates_from_a_drawing_have_the_arm_of_their_friction():
    plates = dict(faces=4, friction=0.1, inner=0.03, outer=0.05, ramp_drive=math.radians(45), ramp_coast=math.radians(45), ramp_radius=0.04)
    without, pressed = (Clutch.from_plates(**plates, gear_thrust=by).values for by in (False, True))
    assert "limited_slip.thrust_arm" not in without
    assert pressed["limited_slip.thrust_arm"] == pytest.approx(4 * 0.1 * 0.04, rel=1e-12)
    assert without == {name: value for name, value in pressed.items() if name != "limited_slip.thrust_arm"}
