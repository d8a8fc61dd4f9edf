"""Car with four-wheel drive: centre differential and two axles as three units, with motor, tyres and body from the package.

The half-shafts of the centre are the propeller shafts. The cuts are at their ends: speeds of the axles' pinions go to the centre, and
torques of the shafts come back. The tyres are cut, too: speeds of the wheels go to them, and torques come back. SI units.
"""

from contextlib import ExitStack
from itertools import chain
from pathlib import Path

import numpy as np
from bevel_differential import Fmu, Scene
from bevel_differential.coupling import GAUSS_SEIDEL, LINES, coupling, other_unit
from bevel_differential.vehicle import Body, Motor, Tyre
from bevel_differential.vehicle.straight import Straight

HERE = Path(__file__).parent
SIDES, AXLES = ("left", "right"), ("front", "rear")
WHEELS = tuple(f"{axle}_{side}" for axle in AXLES for side in SIDES)
# half-shaft of the centre that leads to each axle
SHAFT = dict(zip(AXLES, SIDES))

# friction of the road: ice on the left, dry on the right
FRICTION = {"left": 0.15, "right": 0.9}
LOAD = {"front": 3300.0, "rear": 3834.0}
# `inertia.carrier` of the centre contains the inertia of the motor
MOTOR, BODY = Motor(ratio=2.2), Body(mass=1455.0)
# torque of the motor over time (s, N.m): the driver releases the pedal
PEDAL = ([0.0, 0.2, 0.8, 0.9], [0.0, 100.0, 100.0, 0.0])
STOP, STEP = 1.5, 2.5e-4

CENTRE_PORT = (["carrier.torque_command", *(f"{side}.speed_command" for side in SIDES)],
               ["carrier.speed", *(f"{side}.shaft_torque" for side in SIDES)])
AXLE_PORT = (["pinion.torque_command", *(f"{side}.load_torque" for side in SIDES)],
             ["propeller.speed", *(f"{side}.wheel_speed" for side in SIDES), *(f"{side}.shaft_torque" for side in SIDES)])
# recorded values
SPEEDS = [f"{wheel}.speed" for wheel in WHEELS]
TORQUES = [f"{axle}.propeller_torque" for axle in AXLES] + [f"{wheel}.shaft_torque" for wheel in WHEELS]
NAMES = [*SPEEDS, *TORQUES, "body.speed", "motor.torque"]


def tyres(friction=FRICTION):
    """Tyres of the four wheels."""
    return [Tyre(friction=friction[side], load=LOAD[axle]) for axle in AXLES for side in SIDES]


class FourWheelDrive:
    """Three units with their road. `changes`: values by unit (`centre`, `front`, `rear`) that replace those of its scene file."""

    def __init__(self, friction=FRICTION, changes=None, fmu=None):
        fmu, changes = Fmu.of(fmu), changes or {}
        self.tyres = tyres(friction)
        files = {"centre": "centre", **{axle: f"{axle}_axle" for axle in AXLES}}
        self.scenes = {unit: Scene.load(HERE / f"{file}.toml", fmu).set(changes.get(unit, {})) for unit, file in files.items()}

    def coupling(self, master=GAUSS_SEIDEL, inputs=LINES):
        """Stability of the exchange between the units over the communication step. The tyres exchange little power, and are left out."""
        axles = [other_unit(SHAFT[axle], self.scenes[axle]) for axle in AXLES]
        return coupling(self.scenes["centre"], axles, master, inputs)

    def run(self, stop=STOP, step=STEP, pedal=PEDAL):
        """Record of a launch from rest: a structured array with `time` and `NAMES`, at each communication point."""
        with ExitStack() as opened:
            master = Master(self, opened, step, lambda time: float(np.interp(time, *pedal)))
            rows = [master.row()]
            for _ in range(round(stop / step)):
                master.step()
                rows.append(master.row())
        return np.array(rows, [(name, float) for name in ("time", *NAMES)])


class Master:
    """Steps first road and motor, then the centre, then the axles. Speeds continue along the line through the last two points, so the
    torques at both ends of a step are known when a unit receives them (Gauss-Seidel, inputs on lines)."""

    def __init__(self, car, opened, size, request):
        self.size, self.request, self.count = size, request, 0
        self.road = Straight(MOTOR, car.tyres, BODY)
        instances = {name: opened.enter_context(scene.fmu.open(name=name)) for name, scene in car.scenes.items()}
        self.ports = {name: instance.port(*(CENTRE_PORT if name == "centre" else AXLE_PORT)) for name, instance in instances.items()}
        for name, instance in instances.items():
            instance.initialise(car.scenes[name].values)
        self.found = self.before = {name: port.read() for name, port in self.ports.items()}

    @property
    def time(self):
        """Time of the last communication point, s."""
        return self.count * self.size

    def line(self, of):
        """Values at the last point and their rates, on the line through the last two points."""
        now, before = of(self.found), of(self.before)
        return now, [(a - b) / self.size for a, b in zip(now, before)]

    def step(self):
        """Takes one communication step."""
        size, time, before = self.size, self.time, self.found
        speeds, slopes = self.line(turning)
        begin = self.road.loads(speeds)
        self.road.advance(size, lambda t: [speed + slope * t for speed, slope in zip(speeds, slopes)], lambda t: self.request(time + t))
        end = self.road.loads([speed + size * slope for speed, slope in zip(speeds, slopes)])
        rates = [(b - a) / size for a, b in zip(begin, end)]
        pinions, pinion_rates = self.line(lambda found: [found[axle][0] for axle in AXLES])
        found = {"centre": self.ports["centre"].do_step([begin[0], *pinions], time, size, [rates[0], *pinion_rates])}
        for k, axle in enumerate(AXLES):
            first, last = before["centre"][1 + k], found["centre"][1 + k]
            wheels = slice(1 + 2 * k, 3 + 2 * k)
            found[axle] = self.ports[axle].do_step([first, *begin[wheels]], time, size, [(last - first) / size, *rates[wheels]])
        self.before, self.found, self.count = before, found, self.count + 1

    def row(self):
        """Time and values of `NAMES`."""
        shafts = [found[3:] for axle, found in self.found.items() if axle in AXLES]
        speeds = turning(self.found)
        return (self.time, *speeds[1:], *self.found["centre"][1:], *chain(*shafts), self.road.x[1], self.road.torque(speeds))


def turning(found):
    """Speeds of the centre's carrier and of the four wheels."""
    return [found["centre"][0], *found["front"][1:3], *found["rear"][1:3]]
