"""Longest stable communication step of this differential, coupled to hosts at its ports.

`coupling(scene, [Host.spring("left", 9000.0, 12.0, 1.0)]).limit`. The differential is linearised at the operating point by its own
Jacobian. One communication step of differential, hosts and master is then a matrix, and its eigenvalues decide. With `other_unit`, a host is
another differential, such as a driven axle behind the centre differential.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..points import TimeValue, duration
from ..scene import Scene
from ..values import DifferentialError, FileName
from ..warned import warn
from .host import TORQUE, Host
from .limit import Mode, departure, growth, limit, longest, mode
from .linear import Linear
from .masters import GAUSS_SEIDEL, HELD, HOST, INPUTS, JACOBI, LINES, MASTERS, ROLLBACK, UNIT, Exchange
from .unit import UNLOADED, at_ports, linearised, other_unit

__all__ = ["GAUSS_SEIDEL", "HELD", "HOST", "JACOBI", "LINES", "ROLLBACK", "UNIT", "Apparent", "Coupling", "Exchange", "Host", "Linear", "Mode",
           "coupling", "growth", "linearised", "longest", "other_unit", "stability"]

# step at which the port's answer is given if no step is too long [s]
USUAL = 1e-3


@dataclass(frozen=True)
class Apparent:
    """Answer of a port to a torque that grows as exp(t/h): `inertia`, torque by acceleration [kg.m2], and `stiffness`, torque by angle
    [N.m/rad]. A motion that is fast compared with the step moves along; a slow one does not."""

    inertia: float
    stiffness: float


@dataclass(frozen=True)
class Coupling:
    """Stability of a coupling. `unit`: the linearised differential; `exchange`: the coupling under the requested master; `limit`: the
    longest step [s] up to which all steps are stable, 0 if none is, infinite if all are."""

    unit: Linear
    exchange: Exchange
    limit: float

    def growth(self, step: float) -> float:
        """Factor by which a disturbance grows in each step of `step` [s]; above 1, the coupling is unstable."""
        return growth(self.exchange, step)

    @property
    def departure(self) -> float:
        """Rate [1/s] at which a disturbance grows however short the steps are, because the teeth do not rest at the operating point; 0 if
        they do. This growth does not count for the limit."""
        return departure(self.exchange)

    @property
    def step(self) -> float:
        """Longest stable step [s], or a usual one if no or every step is stable."""
        return self.limit if 0.0 < self.limit < math.inf else USUAL

    def mode(self) -> Mode | None:
        """Motion that loses stability first; None if none does."""
        # just above the limit, so that the growing motion is the largest
        return None if math.isinf(self.limit) else mode(self.exchange, 1.001 * self.limit or USUAL)

    def doubling(self, step: float) -> float:
        """Time in which the fastest motion doubles in steps of `step` [s], s; infinite if no motion grows."""
        factor = self.growth(step)
        return step * math.log(2.0) / math.log(factor) if factor > 1.0 else math.inf

    def apparent(self) -> dict[str, Apparent]:
        """Apparent inertia and stiffness of each port at the longest step; the torques of other ports are constant."""
        found, rate = {}, 1.0 / self.step
        answers = self.unit.transfer(rate)
        for i, (host, rows) in enumerate(zip(self.exchange.hosts, self.exchange.rows)):
            answer = answers[rows, i][-1]
            # both the host's torque and that of a port driven by speed resist the motion
            stiffness = -answer * rate if host.reads == TORQUE else -rate / answer
            found[host.port] = Apparent(float(stiffness / rate**2), float(stiffness))
        return found

    def under(self, master: str, inputs: str) -> "Coupling":
        """Same coupling under another master."""
        return stability(self.unit, self.exchange.hosts, master, inputs, self.exchange.first, self.exchange.ramp)

    def limits(self) -> dict[tuple[str, str], float]:
        """Longest stable step [s] of each master, with held inputs and with lines."""
        found = {}
        for master in MASTERS:
            for inputs in INPUTS:
                found[master, inputs] = self.under(master, inputs).limit
        return found


def coupling(scene: Scene | FileName, hosts: Sequence[Host], master: str = JACOBI, inputs: str = HELD, *, first: str = UNIT,
             at: TimeValue = 0.0) -> Coupling:
    """Stability of a scene whose ports `hosts` drive, over its communication step.

    `master`: `jacobi`, `gauss-seidel` or `rollback`; `inputs`: `held` or on `lines`; `first`: `unit` or `host`, whichever steps first
    under Gauss-Seidel. The operating point is the scene at the time `at` (s, or text such as "10 ms"), by default its start. Other
    inputs of the scene keep their values there."""
    scene = scene if isinstance(scene, Scene) else Scene.load(scene)
    ports = [host.port for host in hosts]
    twice = next((port for port in ports if ports.count(port) > 1), None)
    if twice or not hosts:
        raise DifferentialError(f"{twice}: it has two hosts; give each port one" if twice else "no port has a host; give at least one")
    time = duration("at", at)
    unit, loaded = at_ports(scene, hosts, time)
    warn(scene.warnings)
    if not loaded:
        warn([UNLOADED.format(time=time)])
    return stability(unit, hosts, master, inputs, first, bool(scene.value("solver.input_ramp")))


def stability(unit: Linear, hosts: Sequence[Host], master: str = JACOBI, inputs: str = HELD, first: str = UNIT,
              ramp: bool = False) -> Coupling:
    """Stability of a linear unit with hosts; see `coupling`. `ramp`: true if the unit spreads held inputs over the step."""
    exchange = Exchange(unit, hosts, master, inputs, first, ramp)
    return Coupling(unit, exchange, limit(exchange))
