"""Motion of the wheels: that of the ends of half-shafts which have inertia, otherwise that of the side gears."""

import numpy as np
import pytest
from driving import SIDES

SHAFTS = {"effects.half_shaft": True, "inertia.left_end": 1.0, "inertia.right_end": 1.0}
UNEQUAL = {"left.load_torque": 700.0, "right.load_torque": 835.0}
# a car of 1455 kg on ice at the left and asphalt at the right: grip of both driven wheels, tyre stiffness by slip [N]
RADIUS, MASS, STIFFNESS, BEGIN = 0.334, 1455.0, 2.5e4, 5.0
GRIP = np.array([0.1, 0.9]) * MASS / 4.0 * 9.81
CAR = SHAFTS | {"scene.carrier_drive": "torque", "carrier.torque_command": 0.0, "carrier.speed_command": BEGIN / RADIUS,
                "left.load_torque": 0.0, "right.load_torque": 0.0, "inertia.carrier": 0.28, "effects.wheel_brake": True}


def wheel(driven, kind="speed"):
    return np.array(driven.read([f"{side}.wheel_{kind}" for side in SIDES]))


def gear(driven, kind="speed"):
    return np.array(driven.read([f"{side}.{kind}" for side in SIDES]))


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
def test_a_wheel_behind_a_half_shaft_is_its_end(drive, contact):
    driven = drive(SHAFTS | UNEQUAL | {"scene.gear_contact": contact})
    driven.set({"left.load_torque": 250.0})
    lag = 0.0
    for _ in range(40):
        driven.step(5e-4)
        ends = driven.read([f"{side}.end_speed" for side in SIDES])
        twists = driven.read([f"{side}.twist" for side in SIDES])
        assert np.array_equal(wheel(driven), ends)
        assert wheel(driven, "angle") == pytest.approx(gear(driven, "angle") - twists, rel=1e-13)
        lag = max(lag, np.max(np.abs(wheel(driven) - gear(driven))))
    # wheel and gear differ enough for the test
    assert lag > 0.1


@pytest.mark.parametrize("without", [{}, {"effects.half_shaft": True}, {"inertia.left_end": 1.0, "inertia.right_end": 1.0}],
                         ids=["bare", "massless ends", "rigid shafts"])
@pytest.mark.parametrize("contact", ["ideal", "tooth"])
def test_a_wheel_without_a_separate_end_is_the_side_gear(drive, contact, without):
    driven = drive({"scene.gear_contact": contact} | without)
    for _ in range(5):
        driven.step(1e-3)
        assert np.array_equal(wheel(driven), gear(driven)) and np.array_equal(wheel(driven, "angle"), gear(driven, "angle"))


def test_a_wheel_that_is_driven_by_speed_has_the_speed_of_its_command(drive):
    driven = drive({"scene.left_drive": "speed", "left.speed_command": 52.0, "carrier.speed_command": 50.0})
    driven.step(1e-3)
    assert wheel(driven)[0] == 52.0 and wheel(driven)[1] == gear(driven)[1]
    # the wheel follows its command immediately, like the carrier
    driven.set({"left.speed_command": 53.0})
    assert wheel(driven)[0] == 53.0 and gear(driven)[0] != 53.0


@pytest.mark.parametrize("scene", [SHAFTS | UNEQUAL, UNEQUAL | {"inertia.left_end": 1.0, "inertia.right_end": 1.0},
                                   {"scene.left_drive": "speed", "left.speed_command": 52.0, "carrier.speed_command": 50.0}],
                         ids=["shafts", "rigid", "imposed"])
def test_angles_of_wheels_are_the_integrals_of_their_speeds(drive, scene):
    driven, turned = drive(scene | {"contact.damping": 2e3}), np.zeros(2)
    begin, speed = wheel(driven, "angle"), wheel(driven)
    for _ in range(4000):
        driven.step(5e-6)
        speed, before = wheel(driven), speed
        turned += 0.5 * 5e-6 * (before + speed)
    assert wheel(driven, "angle") - begin == pytest.approx(turned, rel=1e-7)


def test_a_host_that_integrates_reads_the_same_wheels_and_their_derivatives(fmu):
    with fmu.open("ModelExchange") as opened:
        opened.initialise(SHAFTS | UNEQUAL)
        opened.raw.newDiscreteStates()
        opened.raw.enterContinuousTimeMode()
        assert np.array_equal(wheel(opened), opened.read([f"{side}.end_speed" for side in SIDES]))
        names = ["left.end_speed", "left.shaft_twist", "left.relative_angle", "carrier.angle"]
        outputs = ["left.wheel_speed", "left.wheel_angle"]
        slopes = [opened.raw.getDirectionalDerivative([fmu.variable(out).reference for out in outputs],
                                                      [fmu.variable(name).reference], [1.0]) for name in names]
    # ω_wheel is a state; φ_wheel = θ_carrier + α − twist
    assert np.array(slopes).T.tolist() == [[1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 1.0, 1.0]]


def test_the_rate_of_a_wheels_angle_is_its_speed(drive, fmu):
    driven = drive(SHAFTS | UNEQUAL)
    driven.step(1e-3)
    references = [fmu.variable(f"left.wheel_{kind}").reference for kind in ("angle", "speed")]
    rates = driven.raw.getRealOutputDerivatives(references, [1, 1])
    assert rates[0] == pytest.approx(wheel(driven)[0], rel=1e-12)
    assert rates[1] == pytest.approx(driven["der(left.end_speed)"], rel=1e-9)


def speeds_for_tyres(fmu):
    """Names of the speed outputs whose description recommends them for brakes and tyres, left and right."""
    found = [v.name for v in fmu.variables.values() if v.causality == "output" and v.unit == "rad/s"
             and "tyre" in v.description and "brake" in v.description]
    return sorted(found)


def traction_control(fmu, names, step):
    """Launch on ice with tyres by slip and a brake that slows the faster wheel. Returns rows of time, tyre torques, brake torque, shaft
    torques and wheel speeds."""
    rows, speed = [], BEGIN
    with fmu.open() as opened:
        opened.initialise(CAR)
        opened.set({"carrier.torque_command": 600.0})
        for _ in range(round(0.6 / step)):
            seen = np.array(opened.read(names))
            force = GRIP * np.tanh(STIFFNESS * (RADIUS * seen - speed) / max(speed, 1.0) / GRIP)
            brake = min(40.0 * max(seen[0] - seen[1], 0.0), 2000.0)
            opened.set({"left.load_torque": RADIUS * force[0], "right.load_torque": RADIUS * force[1], "left.brake_torque": brake})
            opened.step(step)
            speed += step * force.sum() / MASS
            rows.append([opened.time, *(RADIUS * force), brake, *opened.read([f"{side}.shaft_torque" for side in SIDES]), *seen])
    return np.array(rows)


@pytest.mark.parametrize("step", [1e-3, 2.5e-4])
def test_a_controller_that_is_closed_on_the_wheels_speed_works(fmu, step):
    names = speeds_for_tyres(fmu)
    assert names == ["left.wheel_speed", "right.wheel_speed"]
    time, *tyres, brake, left, right, fast, slow = traction_control(fmu, names, step).T
    # under drive no tyre drags, and the wheel on ice transmits its full grip
    assert np.min(tyres) >= -1e-9 and tyres[0][-1] == pytest.approx(RADIUS * GRIP[0], rel=1e-3)
    # the wheel on asphalt gets the torques of the brake and of the ice: T_left = T_ice + T_brake + J ω̇ = T_right
    accelerated = np.gradient(fast, time)[-2]
    assert left[-2] == pytest.approx(tyres[0][-2] + brake[-2] + accelerated, rel=0.02)
    assert left[-1] == pytest.approx(right[-1], rel=1e-3) and 0.0 < fast[-1] - slow[-1] < 10.0


def test_the_same_controller_on_the_side_gears_brakes_under_drive(fmu):
    # shows the need for the wheel outputs: behind a shaft the side gear is another body, and the loop through both is unstable
    _, *tyres, _, _, _, _, _ = traction_control(fmu, ["left.speed", "right.speed"], 1e-3).T
    assert np.min(tyres) < -1000.0
