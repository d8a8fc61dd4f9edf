"""The car around the differential: against all its equations at once, in the mirror, and with wrong values."""

from math import atan, pi, sin, tanh

import numpy as np
import pytest
from bevel_differential.command import main
from bevel_differential.vehicle import UNITS, Body, Car, Motor, Tyre
from bevel_differential.vehicle.equations import motor_torque
from refusals import refused, warnings_about
from scipy.integrate import solve_ivp

# ideal gears with the inertias of the reference: carrier, side gear, two planets (kg.m2), too light to affect the carrier; ratio of
# their teeth
CARRIER, SIDE, PLANET, RATIO = 0.05, 1.2e-4, 1e-9, 10 / 14
IDEAL = {"scene.gear_contact": "ideal", "inertia.from_geometry": False, "inertia.carrier": CARRIER, "inertia.side_gear": SIDE,
         "inertia.planet": PLANET, "geometry.planet_count": 2, "geometry.planet_teeth": 10, "geometry.side_teeth": 14}
LEFT, RIGHT = Tyre(friction=0.3), Tyre()
OUTPUTS = ["motor.torque", "left.wheel_speed", "right.wheel_speed", "left_tyre.slip", "right_tyre.slip", "body.speed",
           "body.lateral_speed", "body.yaw_rate"]
END = 0.6


def request(time):
    return 150.0 * sin(pi * min(time, 0.2) / 0.4) ** 2


def steer(time):
    return 0.05 * sin(pi * min(time, 0.4) / 0.8) ** 2


def magic(tyre, slip):
    """Pacejka's formula with E = 0."""
    peak = tyre.friction * tyre.load
    return peak * sin(tyre.shape * atan(tyre.slip_stiffness / (tyre.shape * peak) * slip))


def patch(deflection, stiffness, limit, rocking):
    """Adhering fraction of a patch and its slip, with `rocking` added, from the deflection in relaxation lengths: from two thirds of the
    deflection 3 F_max/C of a sliding brush on, the sliding fraction grows with a square up to 1."""
    most = 3.0 * limit / stiffness
    adheres = 1.0 - min(max(3.0 * abs(deflection) / most - 2.0, 0.0), 1.0) ** 2
    return adheres, deflection / max(adheres, 0.01 * abs(deflection)) + rocking


def deflecting(creep, speed, deflection, adheres, relaxation):
    return ((adheres if creep * deflection > 0.0 else 1.0) * creep - abs(speed) * deflection) / relaxation


def rocking(time, motion, speed, relaxation):
    """Slip from the damping over stiffness `time` (s) against `motion` of the body, halved at 0.5 m/s."""
    return time * motion / relaxation / (1.0 + 4.0 * speed**2)


def allowed(motor, carrier):
    """Largest torque of the motor: its peak, or its power divided by its speed."""
    return min(motor.peak, motor.peak * motor.knee / max(motor.ratio * carrier, 1e-9))


def reference(speed, motor, body):
    """Solves all equations as one system, with variable steps at 1e-10 and Willis' equation as a constraint."""
    mass_matrix = np.array([[CARRIER + motor.inertia * motor.ratio**2 + 2 * SIDE + LEFT.inertia + RIGHT.inertia,
                             RATIO * (LEFT.inertia - RIGHT.inertia)],
                            [RATIO * (LEFT.inertia - RIGHT.inertia),
                             RATIO**2 * (2 * SIDE + LEFT.inertia + RIGHT.inertia) + 2 * PLANET]])
    wheelbase, g = body.front + body.rear, 9.80665
    limits = body.grip * body.mass * g * body.rear / wheelbase, body.grip * body.mass * g * body.front / wheelbase

    def rates(time, y):
        torque, carrier, spin, s_l, s_r, v, w, r, front, rear = y
        wheels = carrier + RATIO * spin, carrier - RATIO * spin
        centres = v - 0.5 * body.track * r, v + 0.5 * body.track * r
        forces, slips, lateral, sideways = [], [], [], []
        for tyre, omega, centre, u in zip((LEFT, RIGHT), wheels, centres, (s_l, s_r)):
            creep = tyre.radius * omega - centre
            fading = tyre.damping / (1.0 + (centre / tyre.walk) ** 2)
            adheres, slip = patch(u, tyre.slip_stiffness, tyre.friction * tyre.load, rocking(0.003, -centre, centre, tyre.relaxation))
            forces.append(magic(tyre, slip + fading / tyre.slip_stiffness * creep))
            slips.append(deflecting(creep, centre, u, adheres, tyre.relaxation))
        delta = steer(time)
        for u, stiffness, limit, creep in ((front, body.front_stiffness, limits[0], v * delta - w - body.front * r),
                                           (rear, body.rear_stiffness, limits[1], body.rear * r - w)):
            adheres, slip = patch(u, stiffness, limit, rocking(0.015, creep, v, body.relaxation))
            lateral.append(limit * tanh(stiffness * slip / limit))
            sideways.append(deflecting(creep, v, u, adheres, body.relaxation))
        y_front, y_rear = lateral
        load_l, load_r = (tyre.radius * force for tyre, force in zip((LEFT, RIGHT), forces))
        limit = allowed(motor, carrier)
        drive = motor.ratio * min(torque, limit)
        alpha = np.linalg.solve(mass_matrix, [drive - load_l - load_r, RATIO * (load_r - load_l)])
        against = body.drag * v * abs(v) + body.rolling * body.mass * g * tanh(v / body.breakaway)
        return [(min(request(time), limit) - torque) / motor.lag, *alpha, *slips, (sum(forces) - y_front * delta - against) / body.mass + w * r,
                (y_front + y_rear) / body.mass - v * r,
                (body.front * y_front - body.rear * y_rear + 0.5 * body.track * (forces[1] - forces[0])) / body.yaw_inertia,
                *sideways]

    begin = [0.0, speed / LEFT.radius, 0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0, 0.0]
    y = solve_ivp(rates, (0.0, END), begin, "LSODA", rtol=1e-10, atol=1e-12).y[:, -1]
    wheels = y[1] + RATIO * y[2], y[1] - RATIO * y[2]
    slips = [patch(u, tyre.slip_stiffness, tyre.friction * tyre.load, 0.0)[1] for u, tyre in zip(y[3:5], (LEFT, RIGHT))]
    return dict(zip(OUTPUTS, [min(y[0], allowed(motor, y[1])), *wheels, *slips, y[5], y[6], y[7]]))


@pytest.mark.parametrize("speed", [0.0, 15.0])
def test_the_coupled_car_converges_with_the_square_of_the_step_to_all_equations_at_once(fmu_file, speed):
    car = Car(IDEAL, left=LEFT, right=RIGHT, fmu=fmu_file)
    expected = reference(speed, car.motor, car.body)
    errors = {}
    for step in (2e-3, 1e-3, 5e-4):
        record = car.run(OUTPUTS, END, step, request=request, steer=steer, speed=speed)
        errors[step] = max(abs(record[name][-1] - value) / max(abs(value), 0.01 * np.abs(record[name]).max())
                           for name, value in expected.items())
    assert errors[5e-4] < 1e-3, errors
    assert errors[2e-3] / errors[5e-4] > 10.0, errors


def test_the_mirrored_car_moves_the_mirrored_way(fmu_file):
    tyres = Tyre(friction=0.3), Tyre(inertia=1.2)
    names = ["left.wheel_speed", "right.wheel_speed", "left_tyre.force", "right_tyre.force", "body.speed", "body.yaw_rate",
             "body.lateral_speed"]
    one, other = (Car(IDEAL, left=a, right=b, fmu=fmu_file).run(names, 0.5, 1e-3, request=100.0, steer=turn, speed=8.0)
                  for a, b, turn in ((*tyres, 0.02), (*tyres[::-1], -0.02)))
    for name in ("body.yaw_rate", "body.lateral_speed"):
        assert np.allclose(one[name], -other[name], rtol=1e-9, atol=1e-12)
    for a, b in (("left.wheel_speed", "right.wheel_speed"), ("left_tyre.force", "right_tyre.force")):
        for name, twin in ((a, b), (b, a)):
            assert np.allclose(one[name], other[twin], rtol=1e-9, atol=1e-9)


def test_a_slow_turn_follows_the_geometry_of_the_axles(fmu_file):
    """Without slip, the driven axle follows a circle with the radius wheelbase divided by steering angle."""
    car = Car(IDEAL, body=Body(rolling=0.0, drag=0.0), fmu=fmu_file)
    record = car.run(["body.speed", "body.yaw_rate", "left.wheel_speed", "right.wheel_speed"], 6.0, 2e-3, steer=0.05, speed=1.0)
    speed, yaw, left, right = (record[name][-1] for name in record.dtype.names[1:])
    assert yaw == pytest.approx(speed * 0.05 / (car.body.front + car.body.rear), rel=5e-3)
    assert (right - left) * car.tyres[0].radius == pytest.approx(yaw * car.body.track, rel=2e-3)


def test_a_controller_sets_inputs_and_requests(fmu_file):
    seen = []

    def controller(time, values):
        seen.append((time, values["body.speed"]))
        return {"motor.request": 80.0, "left.brake_torque": 100.0}

    car = Car(IDEAL | {"effects.wheel_brake": True}, fmu=fmu_file)
    outputs = ["body.speed", "motor.torque", "left.shaft_torque", "left_tyre.force"]
    record = car.run(outputs, 1.0, 1e-3, controller=controller)
    assert len(seen) == 1000 and seen[0] == (0.0, 0.0)
    assert record["motor.torque"][-1] == pytest.approx(80.0, rel=0.02)
    free = car.run(outputs, 1.0, 1e-3, request=80.0)
    assert 0.0 < record["body.speed"][-1] < free["body.speed"][-1]


PEAK, KNEE = 250.0, 500.0
LIMITED = {"ratio": 9.0, "inertia": 0.03, "peak": PEAK, "knee": KNEE, "lag": 0.03}


@pytest.mark.parametrize("turns", [0.0, 0.5, 1.0, 1.6, 4.0])
@pytest.mark.parametrize("asked", [25.0, 125.0, PEAK, 1e4])
@pytest.mark.parametrize("signs", [(1, 1), (-1, 1), (1, -1), (-1, -1)])
def test_a_motor_gives_the_request_up_to_its_torque_and_its_power_in_all_four_quadrants(turns, asked, signs):
    """The peak torque is the limit below the knee, and the power of the knee above it."""
    given = motor_torque(Motor(**LIMITED), signs[0] * asked, signs[1] * turns * KNEE)
    limit = PEAK if turns <= 1.0 else PEAK / turns
    assert given == pytest.approx(signs[0] * min(asked, limit), rel=1e-15)


@pytest.mark.parametrize("request_", [1e4, PEAK, -PEAK])
@pytest.mark.parametrize("speed", [0.0, 10.0, 30.0, -30.0])
def test_the_power_of_the_motor_is_never_above_its_limit_and_reaches_it(fmu_file, request_, speed):
    """The limit applies from the first instant, in driving, braking and both directions, although the torque has a lag."""
    # little friction, so that the wheels spin up faster than the lag
    tyre = Tyre(friction=0.1 if speed == 0.0 else 0.9)
    car = Car(IDEAL, motor=Motor(**LIMITED), left=tyre, right=tyre, fmu=fmu_file)
    record = car.run(["motor.torque", "motor.speed"], 0.6, 1e-3, request=request_, speed=speed)
    torque, turns = record["motor.torque"], record["motor.speed"]
    power, limit = np.abs(torque * turns), PEAK * KNEE
    assert np.abs(torque).max() <= PEAK * (1.0 + 1e-12) and power.max() <= limit * (1.0 + 1e-12)
    assert np.all(np.sign(torque[1:]) == np.sign(request_))
    if abs(speed) == 30.0:
        # 30 m/s correspond to 808 rad/s of the motor
        assert power[0] == pytest.approx(limit, rel=1e-12) and torque[0] == pytest.approx(limit / (9.0 * 30.0 / 0.334) * np.sign(request_))
    if speed == 0.0:
        assert np.abs(turns).max() > 1.2 * KNEE and power[-1] == pytest.approx(limit, rel=1e-9)


def test_a_moving_car_begins_with_the_requested_torque_below_the_limit(fmu_file):
    car = Car(IDEAL, motor=Motor(**LIMITED), fmu=fmu_file)
    record = car.run(["motor.torque"], 0.05, 1e-3, request=25.0, speed=30.0)
    assert record["motor.torque"] == pytest.approx(np.full(len(record), 25.0), rel=1e-12)


def test_constant_power_above_the_knee(fmu_file):
    car = Car(IDEAL, motor=Motor(peak=100.0, knee=100.0), left=Tyre(), fmu=fmu_file)
    record = car.run(["motor.torque", "motor.speed"], 0.3, 1e-3, request=100.0, speed="144km/h")
    power = record["motor.torque"] * record["motor.speed"]
    # the speed falls, and the torque rises behind it with its lag
    assert power[0] == pytest.approx(100.0 * 100.0, rel=1e-12) and power == pytest.approx(np.full(len(record), 100.0 * 100.0), rel=1e-3)


@pytest.mark.parametrize("make, message", [
    (lambda fmu: Tyre(radius=-0.3), "Tyre.radius = -0.3: it is a finite number above 0 m"),
    (lambda fmu: Body(mass=float("nan")), "Body.mass = nan: it is a finite number in kg"),
    (lambda fmu: Motor(lag="slow"), "Motor.lag = 'slow': \"slow\" does not begin with a number"),
    (lambda fmu: Car({"left.load_torque": 3.0}, fmu=fmu), "left.load_torque: the car sets it"),
    (lambda fmu: Car({"contact.lawn": "line"}, fmu=fmu), "contact.lawn: there is no such variable"),
    (lambda fmu: Car(fmu=fmu).run(["body.sped"]), "body.sped: neither the differential nor the car has it (did you mean body.speed"),
    (lambda fmu: Car(fmu=fmu).run(["body.speed"] * 2), "body.speed: it is recorded twice"),
    (lambda fmu: Car(fmu=fmu).run(step="20 ms"), "step = 0.02 s: the car is stable with steps up to "),
    (lambda fmu: Car(fmu=fmu).run(request=([0, 1], [2])), "request: 2 times for 1 values"),
    (lambda fmu: Car(fmu=fmu).run(speed="fast"), "speed = 'fast': \"fast\" does not begin with a number"),
    (lambda fmu: Car(fmu=fmu).run(steer="left"), "steer = 'left': it is a finite number"),
])
def test_impossible_values_are_refused_by_name(fmu_file, make, message):
    with refused(message):
        make(fmu_file)


def test_every_output_of_a_record_is_drawn(fmu_file, tmp_path):
    car = Car(IDEAL, fmu=fmu_file)
    record = car.run(list(UNITS), 0.05, 1e-3, request=50.0)
    assert record.dtype.names == ("time", *UNITS)
    car.plot(record, tmp_path / "car.png")
    assert (tmp_path / "car.png").stat().st_size > 10_000


def test_the_command_copies_all_examples_and_never_overwrites_files(tmp_path, capsys):
    assert main(["examples", "--out", str(tmp_path)]) == 0
    assert {file.parent.name for file in tmp_path.rglob("*.*")} == {"design", "four_wheel_drive", "vehicle"}
    assert (tmp_path / "vehicle" / "launch.py").is_file() and (tmp_path / "design" / "study_gears.toml").is_file()
    assert main(["examples", "--out", str(tmp_path)]) != 0
    assert "are there already" in capsys.readouterr().err


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("speed", [0.0, 10.0])
def test_nothing_that_the_car_sets_is_without_influence(fmu_file, contact, speed):
    car = Car({"scene.gear_contact": contact}, fmu=fmu_file)
    assert not warnings_about("changes nothing", lambda: car.run(["body.speed"], stop=0.01, speed=speed))


@pytest.mark.parametrize("final", [{}, {"effects.propeller_shaft": True, "propeller_shaft.stiffness": 1e6, "propeller_shaft.damping": 100.0},
                                   {"final_drive.elastic_mesh": True, "final_drive.backlash": 0.0}])
def test_a_car_with_a_final_drive_moves_as_one_whose_motor_turns_the_carrier(fmu_file, final):
    """The ratio of the motor includes the final drive, so bodies of nearly no inertia and stiff springs change next to nothing."""
    light = {"inertia.pinion": 1e-6, "inertia.propeller_end": 1e-6, "effects.final_drive": True}
    names = ["body.speed", "motor.speed", "motor.torque", "left.shaft_torque"]
    plain, driven = (Car(IDEAL | values, left=LEFT, right=RIGHT, fmu=fmu_file).run(
        [*names, "propeller.speed", "propeller.torque"], 1.0, 1e-3, request=100.0, speed=5.0) for values in ({}, light | final))
    for name in names:
        assert driven[name][500:] == pytest.approx(plain[name][500:], rel=2e-3), name
    assert driven["propeller.speed"] == pytest.approx(4.1 / 9.0 * driven["motor.speed"], rel=1e-9)
    assert driven["propeller.torque"][1:-1] == pytest.approx(9.0 / 4.1 * driven["motor.torque"][1:-1], rel=0.02)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_short_request_gives_the_same_speed_at_any_step(fmu_file, sign):
    pulse = [0.0, 0.01005, 0.0102, 0.01035], [0.0, 0.0, sign * 200.0, 0.0]
    car = Car({"scene.gear_contact": "ideal"}, fmu=fmu_file)
    records = [car.run(["body.speed"], 0.02, step, request=pulse) for step in (5e-4, 2e-4)]
    assert [len(record) for record in records] == [41, 101]
    speeds = [record["body.speed"][-1] for record in records]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-3) and sign * speeds[1] > 0.0


def test_a_jump_of_the_steering_angle_has_two_rows(fmu_file):
    car = Car({"scene.gear_contact": "ideal"}, fmu=fmu_file)
    record = car.run(["body.steer"], 0.005, 1e-3, request=50.0, speed=10.0, steer=([0.0, 0.0025, 0.0025], [0.0, 0.0, 0.01]))
    assert record["time"] == pytest.approx([0.0, 0.001, 0.002, 0.0025, 0.0025, 0.003, 0.004, 0.005])
    assert record["body.steer"].tolist() == [0.0] * 4 + [0.01] * 4
