"""Host at one port of the unit: spring and damper with an inertia behind them, an inertia with a damper, or any linear system."""

import math
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ..values import DifferentialError, suggestion
from .linear import Linear

PORTS = ("carrier", "left", "right")
# signals that a host may read, and the number of its inputs that may be given
READS = {"speed": (1,), "angle": (1, 2), "both": (2,), "torque": (1,)}
# an inertia without spring at a port that is driven by speed reads its torque
TORQUE = "torque"


@dataclass(frozen=True)
class Host:
    """Host at the port `carrier`, `left` or `right`, linear around its operating point.

    `law` has the inputs that `reads` names: the port's `speed` [rad/s], its `angle` [rad], `both` (angle, speed), or the `torque` [N.m]
    that a port driven by speed exerts. A second input of an `angle` host is the backward difference of the angle [rad/s]. The output is
    the torque with which the host resists the port [N.m], or the speed of a port driven by speed [rad/s].

    `sampled`: with held inputs, the law is evaluated only at communication points, and the host's inertia holds the resulting torque
    as the unit does. `law` is then integrated exactly only along lines. Otherwise, it is always integrated exactly."""

    port: str
    reads: str
    law: Linear
    words: str = "given by its matrices"
    sampled: Linear | None = None

    def __post_init__(self) -> None:
        if self.port not in PORTS:
            raise DifferentialError(f"{self.port}: it is no port{suggestion(self.port, PORTS)}; known: {', '.join(PORTS)}")
        if self.reads not in READS:
            raise DifferentialError(f"reads={self.reads}: it is one of {', '.join(READS)}")
        if self.law.b.shape[1] not in READS[self.reads] or self.law.c.shape[0] != 1:
            counts = " or ".join(map(str, READS[self.reads]))
            raise DifferentialError(f"{self.port}: a host that reads {self.reads} has {counts} inputs and one output")

    @classmethod
    def of(cls, port: str, a: Any, b: Any, c: Any, d: Any, reads: str) -> Self:
        """Host ẋ = A x + B u, output C x + D u."""
        return cls(port, reads, Linear.of(a, b, c, d))

    @classmethod
    def spring(cls, port: str, stiffness: float, damping: float, inertia: float = math.inf, reads: str = "speed") -> Self:
        """Spring [N.m/rad] and damper [N.m.s/rad] between the port and an inertia [kg.m2]; without inertia, a wall."""
        k, c, j = stiffness, damping, inertia
        words = f"spring {k:g} N.m/rad, damper {c:g} N.m.s/rad, {'a wall' if math.isinf(j) else f'inertia {j:g} kg.m2'}, reads {reads}"
        wall = math.isinf(j)
        if reads == "speed":
            # states: twist, speed of the inertia
            law = Linear.of([[0.0]], [[1.0]], [[k]], [[c]]) if wall else Linear.of(
                [[0.0, -1.0], [k / j, -c / j]], [[1.0], [c / j]], [[k, -c]], [[c]])
            return cls(port, reads, law, words)
        if reads == TORQUE:
            raise DifferentialError(f"{port}: a host with spring and damper reads speed, angle or both")
        # states: angle and speed of the inertia
        empty = np.zeros((0, 0))
        law = Linear.of(empty, empty, empty, [[k, c]]) if wall else Linear.of(
            [[0.0, 1.0], [-k / j, -c / j]], [[0.0, 0.0], [k / j, c / j]], [[-k, -c]], [[k, c]])
        free = Linear.of(empty, empty, empty, [[0.0]]) if wall else Linear.of(
            [[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0 / j]], [[0.0, 0.0]], [[0.0]])
        return cls(port, reads, law, words, free)

    @classmethod
    def inertia(cls, port: str, inertia: float, damping: float = 0.0) -> Self:
        """Inertia [kg.m2] that reads the torque of a port driven by speed and returns its speed. A damper [N.m.s/rad] to the ground, such
        as a tyre that slips, brakes it."""
        damper = f", damper {damping:g} N.m.s/rad to the ground" if damping else ""
        law = Linear.of([[-damping / inertia]], [[1.0 / inertia]], [[1.0]], [[0.0]])
        return cls(port, TORQUE, law, f"inertia {inertia:g} kg.m2{damper}, reads torque")

    @classmethod
    def parse(cls, text: str) -> Self:
        """Host from text such as "left:k=9000,c=12,J=1,reads=speed" or, at a port driven by speed, "left:J=1,c=30". SI units."""
        port, _, rest = text.partition(":")
        given = {}
        for item in filter(None, rest.split(",")):
            name, sign, value = (each.strip() for each in item.partition("="))
            if not sign or name not in ("k", "c", "J", "reads") or name in given:
                raise DifferentialError(f"{text}: write PORT:k=9000,c=12,J=1,reads=speed, each once")
            given[name] = value if name == "reads" else _positive(text, name, value)
        reads = given.pop("reads", "speed" if "k" in given else TORQUE)
        if "k" not in given:
            if "J" not in given or reads != TORQUE:
                raise DifferentialError(f"{text}: give k, c and reads for a spring with a damper, or J and c at a port driven by speed")
            return cls.inertia(port, given["J"], given.get("c", 0.0))
        return cls.spring(port, given["k"], given.get("c", 0.0), given.get("J", math.inf), reads)

    @property
    def outputs(self) -> list[str]:
        """Outputs of the unit that the host needs."""
        angle, speed = f"{self.port}.angle", f"{self.port}.speed"
        if self.port != "carrier":
            angle, speed = f"{self.port}.wheel_angle", f"{self.port}.wheel_speed"
        torque = "carrier.torque" if self.port == "carrier" else f"{self.port}.shaft_torque"
        return [torque] if self.reads == TORQUE else [speed] if self.reads == "speed" else [angle, speed]

    def hears(self, new: np.ndarray, old: np.ndarray, size: float) -> tuple[np.ndarray, np.ndarray]:
        """Inputs at the communication point with the outputs `new` of the unit, and their slopes from the last point, whose outputs are
        `old`, over `size` [s]. An `angle` host uses only the angle: its speed is the slope of the angle."""
        slope = (new - old) / size
        if self.reads == "angle":
            new, slope = np.stack([new[0], slope[0]]), np.stack([slope[0], 0.0 * slope[0]])
        count = self.law.b.shape[1]
        return new[:count], slope[:count]


def _positive(text, name, value):
    try:
        number = float(value)
    except ValueError:
        number = math.nan
    if not (math.isfinite(number) and (number > 0.0 or name == "c" and number == 0.0)):
        raise DifferentialError(f"{text}: {name} is a number above 0, SI")
    return number
