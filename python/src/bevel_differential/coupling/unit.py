"""The unit, linearised at an operating point: its own directional derivatives, all degrees of freedom and all ports together. Another
unit, such as a driven axle, can be its host."""

from collections.abc import Sequence

import numpy as np

from ..drive_port import PORT
from ..instance import Instance
from ..points import TimeValue, duration
from ..scene import Scene
from ..values import DifferentialError
from ..warned import warn
from .host import TORQUE, Host
from .linear import Linear

# warning about an operating point
UNLOADED = ("the teeth are not loaded at {time:g} s, so the ports turn freely in the backlash; set scene.start = equilibrium, or name "
            "another time")
# input of each port by drive, with the sign of the host's resisting torque or of its speed
INPUTS = {("carrier", "torque"): ("carrier.torque_command", -1.0), ("carrier", "speed"): ("carrier.speed_command", 1.0),
          **{(side, drive): (f"{side}.{name}", 1.0) for side in ("left", "right")
             for drive, name in (("torque", "load_torque"), ("speed", "speed_command"))}}
# output torques with which a port drives its host; the carrier's torque is what the host exerts
SIGNS = {"carrier.torque": -1.0, "propeller.torque": -1.0}
# with a final drive, the host of the carrier turns the port of the drive
AT_PORT = {**PORT, **{f"carrier.{name}": f"propeller.{name}" for name in ("angle", "speed", "torque")}}


def all_states(instance: Instance, inputs: Sequence[str] = (), outputs: Sequence[str] = ()) -> Linear:
    """An instance at its present state with all states, in the order of the FMU, and with respect to these inputs and outputs."""
    rates = [unknown.variable for unknown in instance.fmu.description.derivatives]
    known = [*(rate.derivative.valueReference for rate in rates), *(variable.reference for variable in instance.fmu.named(inputs))]
    unknown = [*(rate.valueReference for rate in rates), *(variable.reference for variable in instance.fmu.named(outputs))]
    slopes = np.array([instance.raw.getDirectionalDerivative(unknown, [each], [1.0]) for each in known]).T
    n = len(rates)
    return Linear(slopes[:n, :n], slopes[:n, n:], slopes[n:, :n], slopes[n:, n:])


def linearised(instance: Instance, inputs: Sequence[str], outputs: Sequence[str]) -> Linear:
    """An instance at its present state, with respect to these inputs and outputs. States that do not matter to them are left out."""
    return all_states(instance, inputs, outputs).reduced()


def other_unit(port: str, scene: Scene, at: TimeValue = 0.0) -> Host:
    """Host that is another unit, at the time `at` (s, or text such as "10 ms") of its scene. The half-shaft at `port`, which is driven by speed, is its propeller
    shaft: it exerts its torque on the drive of the other unit, and returns the speed there. Loads in the scene are constant."""
    if scene.value("scene.carrier_drive") != scene.fmu.variable("scene.carrier_drive").number("torque"):
        raise DifferentialError(f"{port}: the drive of the other unit, {scene.name}, receives a torque; set scene.carrier_drive = torque in it")
    # a spring that reads the speed has the inputs and outputs of this exchange
    time = duration("at", at)
    unit, loaded = at_ports(scene, [Host.spring("carrier", 0.0, 0.0)], time)
    warn(scene.warnings)
    if not loaded:
        warn([f"{scene.name}: {UNLOADED.format(time=time)}"])
    # the spring's torque resists, and that of the propeller shaft drives
    return Host(port, TORQUE, Linear(unit.a, -unit.b, unit.c, -unit.d), f"the unit of {scene.name}")


def at_ports(scene: Scene, hosts: Sequence[Host], at: float) -> tuple[Linear, bool]:
    """The unit as its hosts see it at the time `at` [s] of a scene, and true if its teeth are loaded there. Inputs are the values that
    hosts return, outputs are those that they read, in the order of the hosts."""
    inputs, signs, final = [], [], scene.value("effects.final_drive")
    ideal = scene.value("scene.gear_contact") == scene.fmu.variable("scene.gear_contact").literals["ideal"]
    for host in hosts:
        variable = scene.fmu.variable(f"scene.{host.port}_drive")
        literals = {number: name for name, number in (variable.literals or {}).items()}
        drive = literals[int(scene.value(variable.name))]
        if (drive == "speed") != (host.reads == TORQUE):
            host_of = "J and c" if drive == "speed" else "k, c and J"
            raise DifferentialError(f"{host.port}: the scene drives it by {drive}, so its host has only {host_of}; set {variable.name}, or "
                                    "give another host")
        if ideal and host.port == "carrier" and drive == "speed":
            raise DifferentialError("carrier: gears without teeth follow its speed at once, so a jump of the speed has no finite torque; set "
                                    "scene.gear_contact to lumped or tooth, or drive it by torque")
        name, sign = INPUTS[host.port, drive]
        inputs.append(AT_PORT.get(name, name) if final else name)
        signs.append(sign)
    outputs = [AT_PORT.get(name, name) if final else name for host in hosts for name in host.outputs]
    scene._record(["carrier.speed"], None, at)
    instance = scene._instance()
    unit = linearised(instance, inputs, outputs)
    read = np.array([SIGNS.get(name, 1.0) for name in outputs])
    loaded = ideal or all(instance.read(["left.normal_force", "right.normal_force"]))
    return Linear(unit.a, unit.b * signs, read[:, None] * unit.c, read[:, None] * unit.d * signs), loaded
