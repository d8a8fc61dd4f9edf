"""Random coupled runs: hosts with wheels, tyres or springs at both sides, masters, and the same run in steps of at most 0.1 ms.

A wheel with a tyre integrates the shaft torque of a side driven by speed. A tyre alone reads the speed of a wheel that is inside the unit
and answers with a torque; so does a spring with an inertia behind it. All hosts integrate their own equations in steps of at most 0.1 ms."""

import random
from dataclasses import dataclass, field
from math import ceil, isfinite, tanh

import numpy as np

SIDES = ("left", "right")
FINE = 1e-4
STOP = 0.4
# smallest speed of the slip of a tyre, m/s, and scale of a brake that holds a wheel, rad/s
SLOW, HELD = 1.0, 0.05
# torque at which a run has diverged, N.m
DIVERGED = 1e7


@dataclass
class Tyre:
    """Tyre on a car; `torque` is the longitudinal force times the radius."""

    friction: float
    load: float
    radius: float
    slip_stiffness: float

    def torque(self, speed, car):
        limit = self.friction * self.load
        return self.radius * limit * tanh(self.slip_stiffness * (speed * self.radius - car) / max(abs(car), SLOW) / limit)


@dataclass
class Wheel:
    """Wheel with a tyre and a brake, behind a side driven by speed."""

    tyre: Tyre
    inertia: float
    brake: float
    speed: float = 0.0

    def move(self, port, rates, size, car):
        """Moves along the shaft torque of the port. Returns the force on the car."""
        def rate(speed):
            return (port[0] + 0.5 * size * rates[0] - self.tyre.torque(speed, car) - self.brake * tanh(speed / HELD)) / self.inertia

        # linearly implicit, because tyres are stiff at low speed
        slope = (rate(self.speed + HELD / 100) - rate(self.speed)) / (HELD / 100)
        self.speed += size * rate(self.speed) / (1.0 - size * slope)
        return self.tyre.torque(self.speed, car) / self.tyre.radius

    def answer(self, port, car):
        return self.speed


@dataclass
class Road:
    """Tyre of a wheel that is inside the unit."""

    tyre: Tyre

    def move(self, port, rates, size, car):
        return self.answer(port, car) / self.tyre.radius

    def answer(self, port, car):
        return self.tyre.torque(port[1], car)


@dataclass
class Spring:
    """Spring and damper to an inertia with drag. It integrates the speed of the port to its angle."""

    stiffness: float
    damping: float
    inertia: float
    drag: float
    twist: float = 0.0
    speed: float = 0.0

    def move(self, port, rates, size, car):
        held = port[1] + 0.5 * size * rates[1]
        torque = self.stiffness * (self.twist + 0.5 * size * (held - self.speed)) + self.damping * (held - self.speed)
        before = self.speed
        self.speed += size * (torque - self.drag * self.speed) / self.inertia
        self.twist += size * (held - 0.5 * (before + self.speed))
        return 0.0

    def answer(self, port, car):
        return self.stiffness * self.twist + self.damping * (port[1] - self.speed)


@dataclass
class Coupling:
    """A scene with its hosts, drawn by its number."""

    number: int
    values: dict = field(default_factory=dict)

    def __post_init__(self):
        drawn = random.Random(self.number)

        def between(low, high):
            return low * (high / low) ** drawn.random()

        self.kind = drawn.choice(["wheels", "wheels", "roads", "springs"])
        self.master, self.is_line = drawn.choice([("jacobi", False), ("jacobi", False), ("jacobi", True), ("unit first", False),
                                                  ("host first", False)])
        self.step, self.car_mass = between(8e-4, 6e-3), between(600.0, 3000.0)
        self.torque = drawn.choice([1.0, -1.0]) * between(100.0, 2500.0)
        inertia, stiffness = between(0.5, 2.5), between(5e3, 3e4)
        self.values = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "inertia.carrier": between(0.1, 3.0),
                       "carrier.torque_command": 0.0, "carrier.speed_command": 0.0, "effects.coupling_advice": True,
                       "coupling.host_delay": self.delay()}
        if self.kind == "wheels":
            damping = stiffness * between(1e-4, 1.5e-3)
            for side in SIDES:
                self.values |= {f"scene.{side}_drive": "speed", f"{side}.speed_command": 0.0, f"half_shaft.{side}_stiffness": stiffness,
                                f"half_shaft.{side}_damping": damping}
        else:
            self.values |= {"scene.start": "rest"} | {f"inertia.{side}_end": inertia for side in SIDES} | {
                f"{side}.load_torque": 0.0 for side in SIDES}
        grip = drawn.choice([(0.2, 0.9), (0.9, 0.2), (0.9, 0.9), (0.15, 0.15), (0.3, 0.9)])
        brakes = drawn.choice([(0.0, 0.0), (0.0, 0.0), (3000.0, 0.0), (0.0, 3000.0)])
        load, radius = between(2500.0, 7000.0), drawn.uniform(0.28, 0.4)
        tyres = [Tyre(friction, load, radius, between(3e4, 9e4)) for friction in grip]
        springs = [(k := between(500.0, 2e4), k * between(2e-4, 5e-3), between(0.5, 50.0), drawn.uniform(0.0, 3.0)) for _ in SIDES]
        self.hosts = {"wheels": lambda: [Wheel(tyre, inertia, brake) for tyre, brake in zip(tyres, brakes)],
                      "roads": lambda: [Road(tyre) for tyre in tyres],
                      "springs": lambda: [Spring(*spring) for spring in springs]}[self.kind]

    def delay(self):
        """Delay of the host's answer, from the table of the page."""
        if self.is_line:
            return 0.0
        if self.kind == "roads":
            return 1.0 if self.master == "jacobi" else 0.0
        return 0.5 if self.master == "jacobi" else -0.5

    def inputs(self):
        return [f"{side}.{'speed_command' if self.kind == 'wheels' else 'load_torque'}" for side in SIDES]


@dataclass
class Run:
    """Torques of both sides after each step, the advice, and the time and text of the warning."""

    torques: np.ndarray
    advice: np.ndarray
    warned: float
    message: str


def run(fmu, scene, size, stop=STOP):
    """Couples the scene in steps of `size`. The torque of the carrier changes at the communication points of the scene's own step."""
    hosts, car, torques, advice, warned, said = scene.hosts(), 0.0, [], [], np.inf, ""
    shown = [f"{side}.{what}" for side in SIDES for what in ("shaft_torque", "wheel_speed")]
    with fmu.open() as instance:
        instance.initialise(scene.values)
        port = instance.port(["carrier.torque_command", *scene.inputs()], [*shown, "coupling.step_advice"])
        row = port.read()
        now = before = row[:2], row[2:4]
        given = last = [host.answer(value, car) for host, value in zip(hosts, now)]

        def answers(begin, before):
            """Answers of the hosts after a step from the values `begin`, held or on the line from `before`."""
            nonlocal car
            rates = [[(a - b) / size if scene.is_line else 0.0 for a, b in zip(*each)] for each in zip(begin, before)]
            parts = ceil(size / FINE - 1e-9)
            part = size / parts
            at = begin
            for _ in range(parts):
                force = sum(host.move(value, rate, part, car) for host, value, rate in zip(hosts, at, rates))
                at = [[a + part * rate for a, rate in zip(value, slope)] for value, slope in zip(at, rates)]
                car += part * force / scene.car_mass
            return [host.answer(value, car) for host, value in zip(hosts, at)]

        for step in range(round(stop / size)):
            if scene.master != "unit first":
                reply = answers(now, before)
            if scene.master == "host first":
                last, given = given, reply
            rates = [0.0] + [(a - b) / size for a, b in zip(given, last)] if scene.is_line else None
            grid = scene.step * int(step * size / scene.step + 1e-6)
            row = port.step([scene.torque * min(1.0, (grid + scene.step) / 0.1), *given], size, rates)
            before, now = now, (row[:2], row[2:4])
            torques.append([row[0], row[2]] if scene.kind == "wheels" else list(given))
            advice.append(row[-1])
            said = next((message for message in instance.messages if "coupling.energy_ratio" in message), "")
            if said and not np.isfinite(warned):
                warned = (step + 1) * size
            if scene.master == "unit first":
                reply = answers(now, before)
            if scene.master != "host first":
                last, given = given, reply
            if not all(map(isfinite, row)) or max(map(abs, torques[-1])) > DIVERGED:
                break
    return Run(np.array(torques), np.array(advice), warned, said)
