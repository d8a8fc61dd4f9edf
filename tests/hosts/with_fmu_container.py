"""The FMU inside another FMU. FMU Manipulation Toolbox packs it into a container, a C program that imports it, and FMPy steps
the container. In the container, enumerations are Integers, and the inner FMU's name is the prefix of parameters.

The container connects scalar inputs and outputs. An array whose size is a structural parameter cannot be connected.
"""

import copy
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

import common
import with_fmpy


def load():
    import fmu_manipulation_toolbox  # noqa: F401

    with_fmpy.load()
    return version("fmu-manipulation-toolbox")


def run(fmu, scene):
    """{communication point: values}"""
    inner = common.variables(fmu)
    with tempfile.TemporaryDirectory() as folder:
        outer = contained(Path(fmu).resolve(), scene, Path(folder))
        found = common.variables(outer)
        prefix = Path(fmu).stem.lower() + "."
        # local variables of the inner FMU are not visible outside
        names = {name: next((n for n in (name, prefix + name) if n in found), None) for name in inner}
        known = {name: copy.copy(inner[name]) for name, seen in names.items() if seen}
        for name, variable in known.items():
            variable.reference = found[names[name]].reference
        return with_fmpy.stepped(outer, scene, known, scene.outputs)


def contained(fmu, scene, folder):
    """Path of a container for the same version of FMI. Its step size is the step of the scene."""
    (folder / fmu.name).write_bytes(fmu.read_bytes())
    rows = ["rule;from_fmu;from_port;to_fmu;to_port", f"FMU;{fmu.name};;;"]
    rows += [f"INPUT;;{name};{fmu.name};{name}" for name in scene.series]
    rows += [f"OUTPUT;{fmu.name};{name};;{name}" for name in scene.outputs]
    (folder / "container.csv").write_text("\n".join(rows) + "\n")
    command = [sys.executable, "-c", "from fmu_manipulation_toolbox.cli.fmucontainer import fmucontainer; fmucontainer()",
               "-fmu-directory", str(folder), "-container", f"container.csv:{scene.step!r}", "-auto-parameter", "-no-auto-output",
               "-fmi", "3" if common.is_three(str(fmu)) else "2"]
    made = subprocess.run(command, capture_output=True, text=True)
    if not (folder / "container.fmu").is_file():
        raise SystemExit(f"no container was made: {made.stdout.strip()} {made.stderr.strip()}")
    return str(folder / "container.fmu")


if __name__ == "__main__":
    common.main(load, run)
