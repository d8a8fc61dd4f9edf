"""Host that lets the processor trap invalid operations, divisions by zero and overflows: python trapping_host.py FMU FMU3.

Prints the name of each scene before its calls, so that the last line names the scene of a trap."""

import ctypes
import sys
import warnings
from contextlib import contextmanager

from bevel_differential import Fmu
from effects_list import effects
from fmi3 import Unit3

INVALID, DIVISION, OVERFLOW = 1, 4, 8
STEP, STEPS = 5e-4, 4
LOADS = {"left.load_torque": 200.0, "right.load_torque": 150.0, "carrier.speed_command": 30.0}
LAWS = ("impact", "line", "line_weber")
TOGETHER = ("limited_slip", "half_shaft", "thrust_friction", "tooth_friction", "warm_up", "pin_compliance", "tooth_errors", "mesh_history",
            "strength", "bearing_drag")
"""Effects that one scene combines."""


def scenes(fmu):
    """Scenes by name: all levels, laws, methods and effects, most of them unloaded and loaded."""
    levels = {level: {"scene.gear_contact": level} for level in ("ideal", "lumped", "tooth", "solid")}
    plain = {**levels, **{law: {"contact.law": law} for law in LAWS},
             "given stiffness": {"scene.gear_contact": "lumped", "contact.mesh_stiffness_from_geometry": False},
             **{method: {"solver.method": method} for method in ("fixed_step", "radau")}}
    for effect in effects(fmu):
        for level in effect.contact:
            law = {"contact.law": "line"} if level == "tooth" else {}
            example = {} if level == "solid" and effect.name == "tooth_errors" else effect.example
            on = example | effect.inputs | ({effect.switch: True} if effect.switch else {})
            plain[f"{effect.name}, {level}"] = levels[level] | law | on
    plain["together"] = {"contact.law": "line", **{f"effects.{name}": True for name in TOGETHER}}
    for name, values in plain.items():
        yield name, values
        yield f"{name}, loaded", values | LOADS


@contextmanager
def traps():
    """Enables the traps."""
    which = INVALID | DIVISION | OVERFLOW
    libm = ctypes.CDLL("libm.so.6")
    libm.feenableexcept(which)
    try:
        yield
    finally:
        libm.fedisableexcept(which)


def main(file, file3):
    warnings.simplefilter("ignore")
    fmu = Fmu.of(file)
    for name, values in scenes(file):
        print(name, flush=True)
        with fmu.open() as instance:
            instance.set(values)
            with traps():
                instance.initialise()
                for _ in range(STEPS):
                    instance.step(STEP)
    for kind in ("ModelExchange", "CoSimulation"):
        print(f"FMI 3.0, {kind}", flush=True)
        with traps(), Unit3(file3, kind) as unit:
            unit.initialise({"effects.bearing_drag": True, "contact.law": 2})
    print("complete")


if __name__ == "__main__":
    main(*sys.argv[1:])
