"""Drives the FMU from communication point to communication point, sums the energy turned over, and asserts the balance of the
angular momentum about the axle after every step (momentum.py).

Limits of the energy residual:

UNDAMPED  relative to the energy turned over, in scenes without losses: the requirement on the solver at its default
          tolerance of 1e-6; smooth damped scenes also meet it
BLOWS     relative to the heat, if teeth collide: the heat of an impact measures a clunk or a rattle, and must have four
          correct digits"""

import numpy as np
from bevel_differential.batches import Batches
from bevel_differential.instance import Instance
from momentum import Momentum

UNDAMPED, BLOWS = 1e-6, 1e-4
SIDES = ["left", "right"]
CARRIER = np.radians(2861.0)
# the study's turn from equilibrium, and from rolling, unloaded teeth
STEADY_TURN = {"scene.planet_spin": "imposed", "carrier.speed_command": np.radians(954.0),
               "spin.command": np.radians(200.0)}
TURN = STEADY_TURN | {"scene.start": "rolling"}
# the carrier is driven by torque, the wheels have different imposed speeds: the difference of shaft torques shows friction
BIAS = {"scene.carrier_drive": "torque", "carrier.torque_command": 1670.0, "carrier.speed_command": 50.0,
        "scene.left_drive": "speed", "scene.right_drive": "speed", "left.speed_command": 52.5, "right.speed_command": 47.5}
UNLOADED = {"left.load_torque": 0.0, "right.load_torque": 0.0}
# gears with known inertia, about three fifths of that of their solids
GIVEN = {"inertia.from_geometry": False, "inertia.side_gear": 9e-5, "inertia.planet": 2e-5}
# energy below which no energy counts as turned over [J]
LEAST = 1e-9


def put(instance, name, value):
    """Sets a value that the package would refuse, so that the FMU decides on it."""
    Batches([instance.fmu.variable(name)]).set(instance, [value])


class Drive(Instance):
    """Started scene.

    The energy turned over is the heat of all causes plus ∫(|P_in| + |P_out|) dt of drives and wheels, by the trapezoidal rule
    between communication points. Powers are read with the inputs of the step."""

    def __init__(self, fmu, values=None):
        super().__init__(fmu)
        self.initialise(values)
        self.exchanged = 0.0
        self.heats = [name for name in fmu.variables if name.startswith("heat.")]
        self.momentum = Momentum(self)

    def __getitem__(self, name):
        return self.get(name)

    def load(self, left, right=None):
        self.set({"left.load_torque": left, "right.load_torque": left if right is None else right})

    def powers(self):
        return sum(map(abs, self.read(["power.in", "power.out"])))

    def step(self, size):
        begin = self.powers()
        self.momentum.before_step()
        super().step(size)
        self.momentum.after_step(size)
        self.exchanged += 0.5 * size * (begin + self.powers())

    def to(self, stop, size, each=None):
        """Advances to the time `stop` in steps of `size`; `each(drive)` is called at every communication point."""
        begin = self.time
        for k in range(1, round((stop - begin) / size) + 1):
            # multiples of the step, so that rounding errors do not sum up
            self.step(begin + k * size - self.time)
            if each:
                each(self)
        return self

    def vibration(self, value, step, count):
        """Growth rate [1/s] and frequency [rad/s] of a vibration in `value(drive)` over the next steps, from a recurrence of its
        differences (Prony)."""
        values = []
        for _ in range(count):
            self.step(step)
            values.append(value(self))
        change = np.diff(values)
        (second, first), *_ = np.linalg.lstsq(np.column_stack([change[1:-1], change[:-2]]), change[2:], rcond=None)
        return 0.5 * np.log(-first) / step, np.arccos(0.5 * second / np.sqrt(-first)) / step

    def heat(self):
        return sum(self.read(self.heats))

    def residual(self):
        """Energy residual [J]."""
        return abs(self["solver.energy_residual"])

    def imbalance(self):
        """Energy residual over the energy turned over."""
        return self.residual() / max(self.heat() + self.exchanged, LEAST)

    def imbalance_of_blows(self):
        """Energy residual over the heat."""
        return self.residual() / max(self.heat(), LEAST)

    def work(self):
        """Effort of the integrator: steps accepted and rejected, evaluations of the tooth forces."""
        accepted, rejected, calls = self.read(["solver.steps", "solver.rejected", "solver.rhs_calls"])
        return np.array([accepted + rejected, calls])
