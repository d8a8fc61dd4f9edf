"""Natural frequencies of a scene: it is linearised at the equilibrium of its start, by the FMU's own Jacobian.

A pair of complex eigenvalues λ of ẋ = A x is a vibration with the undamped natural frequency |λ|/2π and the damping ratio −Re λ/|λ|.
Real eigenvalues are motions that decay without swinging, and zeros are rigid rotation."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..scene import Scene
from .linear import RIGID, motions
from .unit import all_states

# speeds of bodies among the states, and names of the bodies. Speeds of pinion and propeller shaft are referred to the carrier; planets spin
# relative to it
SHAFT = "propeller shaft"
BODIES = {"propeller.carrier_speed": SHAFT, "pinion.carrier_speed": "pinion", "carrier.speed": "carrier",
          **{f"{side}.{speed}": f"{side} {body}" for side in ("left", "right")
             for speed, body in (("speed", "side gear"), ("end_speed", "wheel end"))}}
PLANET = re.compile(r"planet\[\d\]\.(spin|pin)_speed")
PLANETS = {"spin": "planets", "pin": "pins"}
# forces of gears that are loaded
LOADS = {"differential": ("left.normal_force", "right.normal_force"), "final drive": ("carrier.torque",)}
# begin of the FMU's warning about a start without equilibrium
NO_EQUILIBRIUM = "scene.start: no equilibrium"
# rounding of an eigenvalue that is 0, over the largest eigenvalue, and of a damping ratio that is 0
ROUNDING, UNDAMPED = 1e-7, 1e-9


@dataclass(frozen=True)
class Vibration:
    """Vibration with a natural `frequency` [Hz] and a `damping` ratio, negative if it grows. `shape`: speed of each body over the speed of
    the body that moves most, the latter first; negative if it moves against this body."""

    frequency: float
    damping: float
    shape: dict[str, float]


@dataclass(frozen=True)
class Vibrations:
    """Vibrations of a scene, the slowest first. `decaying`, `growing`: number of motions that decay, or grow, without swinging.
    `unloaded`: gears whose teeth are not loaded, and therefore have no stiffness. `rests`: true if the start is an equilibrium."""

    found: list[Vibration]
    decaying: int
    growing: int
    unloaded: list[str]
    rests: bool


def vibrations(scene: Scene) -> Vibrations:
    """Vibrations about the equilibrium at the start of a scene. Raises `DifferentialError` if the FMU has none."""
    with scene.fmu.open() as instance:
        scene._initialise(instance, {"scene.start": "equilibrium"})
        system = all_states(instance)
        names = [unknown.variable.derivative.name for unknown in instance.fmu.description.derivatives]
        unloaded = [gears for gears, forces in LOADS.items() if not all(instance.read(forces))]
        rests = not any(text.startswith(NO_EQUILIBRIUM) for text in instance.messages)
    return Vibrations(*vibrations_of(system.a, names), unloaded, rests)


def vibrations_of(a: np.ndarray, names: Sequence[str]) -> tuple[list[Vibration], int, int]:
    """Vibrations of ẋ = A x with states of these `names`, and numbers of motions that decay and that grow without swinging."""
    values, vectors = motions(a)
    rigid = max(RIGID, ROUNDING * float(np.abs(values).max(initial=0.0)))
    found = []
    for value, vector in zip(values, vectors.T):
        if value.imag > 0.0 and abs(value) >= rigid:
            damping = -float(value.real) / abs(value)
            found.append(Vibration(float(abs(value)) / (2.0 * np.pi), damping if abs(damping) > UNDAMPED else 0.0, _shape(names, vector)))
    single = values.real[(values.imag == 0.0) & (abs(values) >= rigid)]
    return sorted(found, key=lambda one: one.frequency), int(np.sum(single < 0.0)), int(np.sum(single > 0.0))


def _shape(names, vector):
    speeds: dict[str, list[complex]] = {}
    for name, speed in zip(names, vector.tolist()):
        planet = PLANET.fullmatch(name)
        body = BODIES.get(name) or (PLANETS[planet[1]] if planet else None)
        if body:
            speeds.setdefault(body, []).append(speed)
    # planets of a group move equally or in turn: the fastest one counts
    of_body = {body: max(several, key=abs) for body, several in speeds.items()}
    largest = max(map(abs, of_body.values()))
    # bodies that move nearly equally keep their order
    bodies = sorted(of_body, key=lambda body: -round(abs(of_body[body]) / largest, 2))
    return {body: float((of_body[body] / of_body[bodies[0]]).real) for body in bodies}
