"""Static equilibria of a scene, found only from its accelerations, without the FMU's start and without energies.

The FMU is opened for model exchange, with gears at rest against each other, and returns the accelerations at positions chosen
here. Torques are inertias times accelerations. Positions creep along the torques (scipy's BDF) until these balance or a planet has
rolled too far. Newton's method with differences then refines the result."""

import ctypes

import numpy as np
from fmpy.fmi2 import fmi2EventInfo
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

# number of positions in the states, and indices of some: sides, carrier, seats, planets, pins, ends, pinion, propeller shaft
BODIES, SIDES, SEATS, PLANETS, PINS = 17, [0, 1], [3, 4], [5, 6, 7, 8], [9, 10, 11, 12]
# arm of the forces on seats [m]
ARM = 0.04
# balance relative to the loads
BALANCED = 1e-6


class Statics:
    """Torques of a scene on its free bodies as a function of their positions. Half-shafts transmit the loads, and are left out."""

    def __init__(self, fmu, values):
        values = {**values, "scene.start": "rolling", "effects.half_shaft": False}
        self.loads = np.array([values["left.load_torque"], values["right.load_torque"]])
        self.load = np.max(np.abs(self.loads))
        self.ratio = values["geometry.planet_teeth"] / values["geometry.side_teeth"]
        count = values["geometry.planet_count"]
        spins = [] if values.get("scene.planet_spin") == "imposed" else PLANETS[:count]
        structure = [*SEATS, *PINS[:count]] if values.get("effects.pin_compliance") else []
        self.free = [*SIDES, *spins, *structure]
        inertia = np.full(BODIES, values["inertia.planet"])
        inertia[SIDES] = [values["inertia.side_gear"] + values.get(f"inertia.{side}_end", 0.0) for side in ("left", "right")]
        # pins have the inertia of a planet across its axis, nearly that about its axis; seats the mass of a gear, about half a kilogram
        inertia[SEATS] = 0.5 * ARM
        self.inertia = inertia[self.free]
        # displacement by a torque per unit of time, similar to the compliance of teeth
        self.mobility = np.array([ARM if i in SEATS else 1.0 for i in self.free]) * 1e-3 / self.load
        self.spins = [self.free.index(i) for i in spins]
        self.instance = fmu.open("ModelExchange").initialise(values)
        raw = self.raw = self.instance.raw
        raw.fmi2NewDiscreteStates(raw.component, fmi2EventInfo())
        raw.enterContinuousTimeMode()
        self.states, self.rates = (ctypes.c_double * (2 * BODIES))(), (ctypes.c_double * (2 * BODIES))()
        raw.getContinuousStates(self.states, 2 * BODIES)
        self.carrier = self.states[BODIES + 2]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.instance.close()

    def torques(self, x):
        """Torques at the positions `x`, relative to the larger load."""
        for i, position in zip(self.free, x):
            self.states[i] = position
        self.raw.setContinuousStates(self.states, 2 * BODIES)
        self.raw.getDerivatives(self.rates, 2 * BODIES)
        return self.inertia * [self.rates[BODIES + i] for i in self.free] / self.load

    def carried(self, spins, farthest):
        """Largest fraction of the loads that both sides can carry, with planets at one of the `spins`, and with side gears turned by up to
        `farthest` [rad] against them."""
        def part(spin, angle):
            x = np.zeros(len(self.free))
            x[self.spins] = spin
            x[SIDES] = np.array([1.0, -1.0]) * self.ratio * spin - np.sign(self.loads) * angle
            return np.min(1.0 + self.torques(x)[SIDES] * self.load / self.loads)

        return max(part(spin, angle) for spin in spins for angle in np.linspace(0.0, farthest, 200))

    def pressed(self, spin):
        """Positions with all planets at `spin` [rad] and each side at the angle where its teeth carry its load; None if they cannot."""
        x = np.zeros(len(self.free))
        x[self.spins] = spin
        for s, sign in zip(SIDES, (1.0, -1.0)):
            x[s] = rolled = sign * self.ratio * spin
            against = -np.sign(self.loads[s])

            def excess(angle, s=s, rolled=rolled, against=against):
                x[s] = rolled + against * angle
                return -against * self.torques(x)[s]

            reach = 1e-3 * 2.0 ** np.arange(8)
            apart = next((-angle for angle in [0.0, *reach] if excess(-angle) < 0.0), None)
            touching = next((angle for angle in reach if excess(angle) > 0.0), None)
            if apart is None or touching is None:
                return None
            x[s] = rolled + against * brentq(excess, apart, touching, xtol=1e-12)
        return x

    def equilibrium(self, spin, most):
        """Equilibrium that creep reaches from planets at `spin`, with none of them beyond `most` [rad]; None if it reaches none."""
        x = self.pressed(spin)
        if x is None:
            return None
        for _ in range(3):
            torques = self.torques(x)
            if np.max(np.abs(torques)) < BALANCED:
                return x
            rolled = lambda _, x: most - max((abs(x[k]) for k in self.spins), default=0.0)  # noqa: E731
            rolled.terminal = True
            crept = solve_ivp(lambda _, x: self.mobility * self.load * self.torques(x), (0.0, 1e8), x, method="BDF", rtol=1e-6,
                              atol=1e-9, events=rolled)
            x = crept.y[:, -1]
            if crept.status == 1:
                return None
            x = self.polished(x)
        return x if np.max(np.abs(self.torques(x))) < BALANCED else None

    def polished(self, x):
        """Refines `x` by Newton's method, as long as each step halves the torques."""
        torques = self.torques(x)
        for _ in range(20):
            steps = np.where(np.isin(self.free, SEATS), 1e-10, 1e-8)
            slopes = np.array([(self.torques(x + h) - self.torques(x - h)) / (2.0 * step)
                               for step, h in zip(steps, np.diag(steps))]).T
            trial = x - np.linalg.lstsq(slopes, torques, rcond=1e-10)[0]
            found = self.torques(trial)
            if not np.max(np.abs(found)) < 0.5 * np.max(np.abs(torques)):
                break
            x, torques = trial, found
        return x
