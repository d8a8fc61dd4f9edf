"""Hosts that are coupled to the FMU, and the exchange that they would have without a cut.

A host reads angle and speed of a port and answers with a torque. Its own motion is integrated along the port's motion, which is a cubic
between communication points if the torques are constant or linear and the gears are ideal. The exact energy is the integral of the
host's torque along this motion."""

from dataclasses import dataclass, field

LOADS = {"carrier": "carrier.torque_command", "left": "left.load_torque", "right": "right.load_torque"}
MOTION = {"carrier": ("carrier.angle", "carrier.speed"), "left": ("left.wheel_angle", "left.wheel_speed"),
          "right": ("right.wheel_angle", "right.wheel_speed")}
ERRORS = [f"coupling.{name}.energy_error" for name in LOADS]
# steps by which the outputs lag
LAG = 2
FREE = {"scene.gear_contact": "ideal", "scene.carrier_drive": "torque", "inertia.carrier": 1.0, "inertia.left_end": 1.0,
        "inertia.right_end": 1.0, **dict.fromkeys(LOADS.values(), 0.0)}
ADVISED = FREE | {"effects.coupling_advice": True}
# parts of a step of Runge and Kutta's method
PARTS = 8


@dataclass
class Host:
    """Spring and damper between a port and an inertia that drags and that a torque drives; `sign` -1 = drives the carrier."""

    stiffness: float
    damping: float
    inertia: float
    drag: float = 0.0
    driven: object = field(default=lambda time: 0.0)
    sign: float = 1.0
    speed: float | None = None

    def start(self, angle, speed):
        self.time, self.state = 0.0, (angle, speed if self.speed is None else self.speed, 0.0)

    def torque(self, angle, speed):
        return self.sign * (self.stiffness * (angle - self.state[0]) + self.damping * (speed - self.state[1]))

    def rates(self, time, state, motion):
        """Rates of angle and speed of the inertia and of the energy exchanged."""
        angle, speed = motion(time - self.time)
        torque = self.stiffness * (angle - state[0]) + self.damping * (speed - state[1])
        return state[1], (torque - self.drag * state[1] + self.driven(time)) / self.inertia, self.sign * torque * speed

    def advance(self, size, before, after):
        """Moves along a step, and returns the energy exchanged in it."""
        state, part, energy = self.state, size / PARTS, self.state[2]
        motion = cubic(size, before, after)
        for k in range(PARTS):
            time = self.time + k * part
            first = self.rates(time, state, motion)
            second = self.rates(time + part / 2, moved(state, part / 2, first), motion)
            third = self.rates(time + part / 2, moved(state, part / 2, second), motion)
            fourth = self.rates(time + part, moved(state, part, third), motion)
            state = tuple(x + part / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(state, first, second, third, fourth))
        self.time, self.state = self.time + size, state
        return state[2] - energy


def moved(state, by, rates):
    return tuple(x + by * rate for x, rate in zip(state, rates))


def cubic(size, before, after):
    """Angle and speed along the cubic through angles and speeds at both ends of a step."""
    (start, first), (end, last) = before, after
    slope = (end - start) / size
    two, three = (3 * slope - 2 * first - last) / size, (first + last - 2 * slope) / size**2
    return lambda t: (start + t * (first + t * (two + t * three)), first + t * (2 * two + 3 * t * three))


@dataclass
class Coupled:
    """A coupled run: outputs of the effect after each step, exact energies that the cuts have created, messages of the FMU."""

    ratio: list = field(default_factory=list)
    advice: list = field(default_factory=list)
    errors: dict = field(default_factory=dict)
    exact: dict = field(default_factory=dict)
    messages: list = field(default_factory=list)

    @property
    def warnings(self):
        return [message for message in self.messages if "coupling.energy_ratio" in message]


def couple(fmu, hosts, size, stop, *, delay=0, lines=False, values=None):
    """Couples `hosts`, by port, in steps of `size` up to `stop`. With `lines`, torques continue their last change."""
    ports, run = list(hosts), Coupled()
    with fmu.open() as instance:
        instance.initialise(ADVISED | {"coupling.host_delay": float(delay)} | (values or {}))
        shown = [name for port in ports for name in MOTION[port]]
        port = instance.port([LOADS[name] for name in ports], [*shown, *ERRORS, "coupling.energy_ratio", "coupling.step_advice"])
        now = motions(ports, port.read())
        for name, host in hosts.items():
            host.start(*now[name])
            run.errors[name], run.exact[name] = [], [0.0]
        answers = [{name: host.torque(*now[name]) for name, host in hosts.items()}] * 2
        given = answers[0]
        for _ in range(round(stop / size)):
            before, given = given, answers[-1 - delay]
            rates = [(given[name] - before[name]) / size for name in ports] if lines else None
            row = port.step([given[name] for name in ports], size, rates)
            after = motions(ports, row)
            for k, (name, host) in enumerate(hosts.items()):
                unit = received(given[name], rates[k] if lines else 0.0, size, now[name], after[name])
                created = host.advance(size, now[name], after[name]) - unit
                run.exact[name].append(run.exact[name][-1] + (-created if name == "carrier" else created))
                run.errors[name].append(row[2 * len(ports) + list(LOADS).index(name)])
            run.ratio.append(row[-2])
            run.advice.append(row[-1])
            now = after
            answers = [answers[-1], {name: host.torque(*now[name]) for name, host in hosts.items()}]
        run.messages = instance.messages
    return run


def motions(ports, row):
    return {name: (row[2 * k], row[2 * k + 1]) for k, name in enumerate(ports)}


def received(torque, rate, size, before, after):
    """Integral of a linear torque along the cubic of a step."""
    (start, first), (end, last) = before, after
    # ∫ t ω dt = h φ(h) - ∫ φ dt
    return torque * (end - start) + rate * (size * end - 0.5 * size * (start + end) - size**2 * (first - last) / 12)
