"""Car: motor, this differential, two tyres and the body, coupled step by step."""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..drive_port import PORT, PORT_SPEED, SPEED, TORQUE, drive_ratio, port_command, port_inertia, port_value
from ..fmu import Fmu
from ..inputs import prolonged, times_of_rows
from ..instance import Instance
from ..off_outputs import OffOutputs
from ..plot import plot
from ..points import SAME, TimeValue, duration, span
from ..start_values import Accepted, checked, in_short
from ..values import DifferentialError, FileName, Number, Value, variable_suggestion
from ..warned import warn
from .equations import motor_torque
from .motion import Motion
from .parts import Body, Motor, Tyre
from .signals import Course, Requests, course, speed_value

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# signals to the differential, and back; with a final drive, the torque acts on its port
LOADS = (TORQUE, "left.load_torque", "right.load_torque")
SPEEDS = (PORT_SPEED, "left.wheel_speed", "right.wheel_speed")
# units of the recorded outputs of the parts
UNITS = {"motor.torque": "N.m", "motor.speed": "rad/s", "left_tyre.force": "N", "right_tyre.force": "N", "left_tyre.slip": "",
         "right_tyre.slip": "", "body.speed": "m/s", "body.lateral_speed": "m/s", "body.yaw_rate": "rad/s",
         "body.lateral_acceleration": "m/s2", "body.steer": "rad"}
# outputs that `run` records by default
DEFAULT_OUTPUTS = ("motor.torque", "left.shaft_torque", "right.shaft_torque", "left.wheel_speed", "right.wheel_speed", "body.speed")
# requests that a controller sets in addition to inputs of the differential
REQUESTS = ("motor.request", "body.steer")

# fraction of the times of a wheel on its tyre up to which no step needs a closer look
SAFE = 0.25
# speeds at which the stability of a step is checked, by the speed at which the damping of the tyres is halved: from standstill, where
# damping is largest, to where there is none
WALKS = (0.0, 1.0, 2.0, 3.0, 4.0, 8.0)

# receives the time (s) and the recorded outputs by name; returns the values to set, by name
Controller = Callable[[float, dict[str, Number]], Mapping[str, Value] | None]


class Car:
    """Car with this differential in its driven axle.

    `differential`: parameters as for `Differential`. The car sets the drives: torques at all three shafts, the motor's inertia at the
    carrier in addition to `inertia.carrier`, and the wheels' inertia at the half-shafts. With effects.final_drive, the motor turns the
    pinion or its propeller shaft, by a gear that has the rest of its ratio. Parts have the start values of a passenger car. `unset` lists parameters that nobody gave; if any part was given, the first run warns of them. `accept_start_values` as for
    `Differential`; True also accepts those of the parts.

    >>> from bevel_differential.vehicle import Car, Tyre
    >>> car = Car({"contact.law": "line"}, left=Tyre(friction=0.15))
    >>> record = car.run(request=100.0, stop=0.2)
    >>> bool(record["left.wheel_speed"][-1] > record["right.wheel_speed"][-1])
    True
    """

    def __init__(self, differential: Mapping[str, Value] | None = None, *, motor: Motor | None = None, left: Tyre | None = None,
                 right: Tyre | None = None, body: Body | None = None, accept_start_values: Accepted = False,
                 fmu: FileName | Fmu | None = None):
        self.fmu = Fmu.of(fmu)
        self.accept_start_values = checked(self.fmu, accept_start_values)
        self.motor, self.body = motor or Motor(), body or Body()
        self.tyres = (left or Tyre(), right or Tyre())
        self._given = self._checked(differential or {})
        self._is_warned = accept_start_values is True or motor is left is right is body is None

    def run(self, outputs: Sequence[str] = DEFAULT_OUTPUTS, stop: TimeValue = 1.0, step: TimeValue = 5e-4, *, request: Course = 0.0,
            steer: Course = 0.0, speed: float | str = 0.0, controller: Controller | None = None) -> np.ndarray:
        """Simulates from 0 to `stop` in communication steps of `step` (s, or text such as "1 ms"). Records `outputs` of the
        differential and of the parts (`UNITS`) at each, SI. Between them, it stops at the points of `request` and `steer` without a
        record; a jump is recorded twice, before and after it.

        `request`: torque of the motor, N.m; `steer`: angle of the front wheels, rad, positive to the left. Each is a number, a pair (times,
        values) or a function of time. `speed`: speed of the car at the start, m/s, or text such as "54 km/h". The motor then starts with
        the part of the torque `request` that it can give at that speed, without a lag. `controller(time, values)` is called before each
        communication step with the recorded outputs, and returns the values to set: inputs and tunable parameters of the differential, `motor.request`,
        `body.steer`. Returns a structured array with a field "time"."""
        stop, step = duration("stop", stop), span("step", step)
        self._warn_unset()
        self._check_step(step)
        requests = Requests({"request": request, "steer": steer})
        names = self._recorded(outputs)
        begin = speed_value(speed)
        motion = Motion(self.motor, self.tyres, self.body, begin)
        steps = requests.steps(stop, step)
        rows = []
        with self.fmu.open() as instance:
            loads = [port_command(self._value, name) for name in LOADS]
            run = _Run(instance, motion, loads, drive_ratio(self._value), [name for name in names if name not in UNITS], step)
            ask, turn = requests.within(steps[0], 0.0).values()
            run.start(self._start(motion, begin, ask(0.0)), begin / self._radius(), stop)
            values = run.values(turn(0.0))
            rows.append([values[name] for name in names])
            wanted: Mapping[str, Value] = {}
            commanded: dict[str, Value] = {}
            for before, row in pairwise(steps):
                time = float(before["end"])
                ask, turn = requests.within(row, time).values()
                if row["jumps"]:
                    values = run.values(turn(time))
                    rows.append([values[name] for name in names])
                if before["recorded"]:
                    wanted = (controller(time, {name: values[name] for name in names}) if controller else None) or {}
                    instance.set({name: value for name, value in wanted.items() if name not in REQUESTS})
                    commanded |= {name: value for name, value in wanted.items() if name not in REQUESTS and value}
                asked = dict(zip(REQUESTS, (ask, turn)))
                asked.update((name, course(name, value)) for name, value in wanted.items() if name in REQUESTS)
                run.step(time, float(row["end"]) - time, [asked[name] for name in REQUESTS])
                if row["recorded"]:
                    values = run.values(turn(float(row["end"])))
                    rows.append([values[name] for name in names])
            values_of_run = self.fmu.numbers({**self._start(motion, begin, 0.0), **commanded})
            off = OffOutputs.of(self.fmu, names, {variable.name: value for variable, value in values_of_run})
            warn([*prolonged(steps), *in_short(instance.messages, self.accept_start_values), *off.texts])
        columns = zip(times_of_rows(steps).tolist(), rows)
        return np.array([(time, *values) for time, values in columns], [("time", np.float64), *((name, np.float64) for name in names)])

    def plot(self, record: np.ndarray, file: FileName | None = None, title: str = "", caption: str = "") -> "Figure":
        """Draws a record, with a panel for each unit; see `Differential.plot`."""
        return plot(_Names(self.fmu), record, title, caption, file)

    @property
    def unset(self) -> dict[str, float]:
        """Parameters of motor, tyres and body that nobody gave, with their start values, which are those of a passenger car."""
        parts = zip(("motor", "left_tyre", "right_tyre", "body"), (self.motor, *self.tyres, self.body))
        return {f"{name}.{parameter}": value for name, part in parts for parameter, value in part.unset.items()}

    def _warn_unset(self):
        """Warns once of parameters that nobody gave, if any part of the car was given."""
        unset = self.unset
        if unset and not self._is_warned:
            listed = ", ".join(f"{name} = {value:g}" for name, value in unset.items())
            warn([f"these values of a passenger car influence this car, and nobody set them (SI units): {listed}"])
        self._is_warned = True

    def _checked(self, given):
        own = ("scene.carrier_drive", "scene.left_drive", "scene.right_drive", "scene.start", "scene.planet_spin", *LOADS, SPEED,
               *PORT.values(), "inertia.left_end", "inertia.right_end")
        for name in given:
            if name in own:
                raise DifferentialError(f"{name}: the car sets it; what acts on the shafts are motor, tyres and body")
        self.fmu.numbers(given)
        return dict(given)

    def _start(self, motion, speed, request):
        left, right = self.tyres
        begin, ratio = speed / self._radius(), drive_ratio(self._value)
        if speed:
            motion.x[0] = motor_torque(self.motor, request, self.motor.ratio * begin)
        start = {port_command(self._value, SPEED): port_value(self._value, SPEED, begin)} if speed else {}
        body = port_inertia(self._value)
        return {**self._given, **start, body: self._value(body) + self.motor.inertia * (self.motor.ratio / ratio) ** 2,
                "scene.carrier_drive": "torque", "scene.left_drive": "torque", "scene.right_drive": "torque",
                "scene.start": "equilibrium" if speed else "rest",
                "inertia.left_end": left.inertia, "inertia.right_end": right.inertia}

    def _radius(self):
        """Mean radius of the tyres, m."""
        left, right = self.tyres
        return 0.5 * (left.radius + right.radius)

    def _value(self, name):
        """Value of a parameter of the differential, given or by default."""
        variable = self.fmu.variable(name)
        return variable.number(self._given.get(name, variable.start))

    def _recorded(self, outputs):
        names = list(outputs)
        for name in names:
            if name not in UNITS and name not in self.fmu.variables:
                raise DifferentialError(f"{name}: neither the differential nor the car has it"
                                        f"{variable_suggestion(name, [*self.fmu.variables, *UNITS])}")
        twice = next((name for name in names if names.count(name) > 1), None)
        if twice:
            raise DifferentialError(f"{twice}: it is recorded twice; name each output once")
        return names

    def longest_step(self) -> float:
        """Longest step [s] that is stable at all speeds, as the differential and the tyres are coupled in `run`: the differential with both
        wheels, linearised at rest, and tyres without slip on a body of constant speed; see `bevel_differential.coupling`."""
        # imported here, because runs with usual steps do not need it
        from ..coupling import GAUSS_SEIDEL, HOST, LINES, linearised, stability

        motion = Motion(self.motor, self.tyres, self.body, 0.0)
        with self.fmu.open() as instance:
            loads = [port_command(self._value, name) for name in LOADS]
            instance.initialise(self._start(motion, 0.0, 0.0) | dict.fromkeys(loads, 0.0))
            unit = linearised(instance, LOADS[1:], SPEEDS[1:])
        walk = max(tyre.walk for tyre in self.tyres)
        return min(stability(unit, [_host(side, tyre, part * walk) for side, tyre in zip(("left", "right"), self.tyres)],
                             GAUSS_SEIDEL, LINES, HOST).limit for part in WALKS)

    def _check_step(self, step):
        # far below these times of a wheel on its tyre, every step is stable
        times = [time for tyre in self.tyres for time in _times(tyre)]
        if step > SAFE * min(times):
            longest = self.longest_step()
            if step > longest:
                raise DifferentialError(f"step = {step:g} s: the car is stable with steps up to {longest:.3g} s, because tyres and "
                                        "differential exchange speeds and torques only once in a step; use a shorter one")


def _host(side, tyre, speed):
    """Tyre around no slip at a speed of the body [m/s], as a host that reads the wheel's speed."""
    from ..coupling import Host

    # `patch_rate` and `tyre_force` of a patch that adheres, with its slip as state
    return Host.of(side, [[-speed / tyre.relaxation]], [[tyre.radius / tyre.relaxation]], [[tyre.radius * tyre.slip_stiffness]],
                   [[tyre.radius**2 * tyre.damping / (1.0 + (speed / tyre.walk) ** 2)]], "speed")


def _times(tyre):
    """Times [s] of a wheel on its tyre at standstill: inertia by damping, and the inverse frequency."""
    return tyre.inertia / (tyre.radius**2 * tyre.damping), math.sqrt(tyre.inertia * tyre.relaxation / tyre.slip_stiffness) / tyre.radius


class _Run:
    """One run: from step to step, the differential receives lines of torque, and the parts receive lines of speed. The parts refer
    speed and torque of the motor to the carrier, over the `ratio` of a final drive; `loads`: names of the torques."""

    def __init__(self, instance: Instance, motion: Motion, loads: list[str], ratio: float, names: list[str], communication_step: float):
        self.instance, self.motion, self.names, self.names_of_loads, self.ratio = instance, motion, names, loads, ratio
        self.port = instance.port(loads, [*SPEEDS, *names])
        # times and speeds: the last point that is a communication step or more ago, and all points since then
        self.past: list[tuple[float, list[float]]] = []
        self.communication_step = communication_step * (1.0 - SAME)
        self.read: list[Number] = []

    def start(self, values, at, stop):
        """Starts with carrier and wheels at the speed `at`, rad/s."""
        self.instance.initialise(values | dict(zip(self.names_of_loads, self._loads([at] * 3))), stop)
        self._keep(0.0, self.port.read())

    def _loads(self, speeds):
        drive, *sides = self.motion.loads(speeds)
        return [drive / self.ratio, *sides]

    def _keep(self, time, outputs):
        self.past.append((time, [outputs[0] / self.ratio, *outputs[1:3]]))
        # a line through points that are close together would be a rounding error
        while len(self.past) > 2 and time - self.past[1][0] >= self.communication_step:
            self.past.pop(0)
        self.read = outputs[3:]

    def values(self, steer):
        return dict(zip(self.names, self.read)) | self.motion.outputs(self.past[-1][1], steer)

    def step(self, time, size, asked):
        """Advances the parts first, along the line through the speeds of the last communication step. The torques at both ends of the step are then known."""
        (since, before), (_, now) = self.past[0], self.past[-1]
        slopes = [(b - a) / (time - since or 1.0) for a, b in zip(before, now)]

        def line(t):
            return [value + slope * t for value, slope in zip(now, slopes)]

        begin = self._loads(now)
        self.motion.advance(size, line, *(lambda t, of=of: of(time + t) for of in asked))
        end = self._loads(line(size))
        if not all(map(math.isfinite, end)):
            raise DifferentialError(f"at {time:g} s: the tyres' loads are not numbers; use shorter steps, or check the parameters",
                                    kind="failed")
        self._keep(time + size, self.port.do_step(begin, time, size, [(b - a) / size for a, b in zip(begin, end)]))


class _Names:
    """Variables of the differential and of the parts, for `plot`."""

    def __init__(self, fmu):
        self.fmu = fmu

    def variable(self, name):
        return _Output(name) if name in UNITS else self.fmu.variable(name)


class _Output:
    kind = "Real"

    def __init__(self, name):
        self.name, self.unit = name, UNITS[name]
        self.description = name

    def shown(self, values):
        return self.unit, values
