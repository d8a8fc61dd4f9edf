"""Ecos, a host in C++ with fmi4c, used through ecospy. With --process, the FMU runs in a separate process (proxyfmu).

Ecos does not support enumerations: it ignores their variables and logs a warning if a value is set. Values before
initialisation are passed as a parameter set. Ecos does not enter configuration mode, so the FMU refuses structural parameters
of FMI 3.0. Only the debug log of Ecos reports this.
"""

import os
import stat
import sys
from importlib.metadata import version
from pathlib import Path

import common

ELSEWHERE = "proxyfmu://localhost?file="


def load():
    import ecospy

    # pip does not make the program executable
    proxy = Path(ecospy.__file__).parent / "binaries" / "proxyfmu"
    if os.name != "nt":
        proxy.chmod(proxy.stat().st_mode | stat.S_IXUSR)
    return version("ecospy")


def run(fmu, scene, prefix=""):
    """{communication point: values}"""
    from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure

    EcosLib.set_log_level("err")
    known = common.variables(fmu)
    with EcosSimulationStructure() as structure:
        structure.add_model("d", prefix + fmu)
        unknown = [variable.name for variable, _ in scene.start(known) if variable.kind == "Enumeration"]
        if unknown:
            raise SystemExit(f"ecos does not set {', '.join(unknown)}")
        start = {f"d::{variable.name}": value for variable, value in scene.start(known)}
        structure.add_parameter_set("start", start)
        with EcosSimulation(structure=structure, step_size=scene.step) as simulation:
            if not simulation.init(0, "start"):
                raise SystemExit(f"ecos does not initialise: {EcosLib.get_last_error()}")
            rows = common.stepped(scene, lambda name, value: simulation.set_real(f"d::{name}", value),
                                  lambda _: simulation.step(),
                                  lambda: [simulation.get_real(f"d::{name}") for name in scene.outputs])
            simulation.terminate()
    return rows


if __name__ == "__main__":
    elsewhere = "--process" in sys.argv
    sys.argv = [argument for argument in sys.argv if argument != "--process"]
    common.main(load, lambda fmu, scene: run(fmu, scene, ELSEWHERE if elsewhere else ""))
