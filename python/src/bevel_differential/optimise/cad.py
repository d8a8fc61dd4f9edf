"""A chosen design for other programs: a scene file, and the gears as solids, meshes and drawings."""

import json
import shlex
import subprocess
from pathlib import Path

from .. import cad
from ..values import DifferentialError, FileName
from .design_task import DesignRow
from .problem import Problem
from .quantities import Catalogue


def scene_text(problem: Problem, row: DesignRow, description: str) -> str:
    """The problem's scene with the design in it, as a scene file."""
    scene, fmu = problem.scene, problem.scene.fmu
    values = {**scene.values, **problem.complete(row.values)}
    lines = [f"description = {_text(description)}", f"stop_time = {scene.stop!r}", f"step = {scene.step!r}",
             f"outputs = [{', '.join(map(_text, scene.outputs))}]", "", "[set]"]
    lines += [f"{name} = {_toml(fmu.variable(name), value)}" for name, value in values.items()]
    for time, changes in scene.changes:
        lines += ["", "[[at]]", f"time = {time!r}"]
        lines += [f"{name} = {_toml(fmu.variable(name), fmu.variable(name).number(value))}" for name, value in changes.items()]
    for name, times, numbers, period in scene.tables:
        lines += ["", "[[table]]", f"input = {_text(name)}", f"time = {list(times)!r}", f"value = {list(numbers)!r}"]
        lines += [f"period = {period!r}"] if period else []
    return "\n".join(lines) + "\n"


def settings(problem: Problem, row: DesignRow) -> dict[str, str]:
    """What is set for the design's gears."""
    catalogue = Catalogue(problem.scene.fmu)
    starts = catalogue.starts()
    values = {**problem.scene.values, **problem.complete(row.values)}
    wanted = {name: value for name, value in values.items() if name.startswith("geometry.") and value != starts[name]}
    if values.get("effects.backlash") is False:
        wanted["effects.backlash"] = False
    return {name: _toml(catalogue.variable(name), value).strip('"') for name, value in wanted.items()}


def command_line(problem: Problem, row: DesignRow, folder: FileName) -> str:
    """The command that answers with them, as a line for the shell, at the top of the repository."""
    return shlex.join(["cargo", "run", "--release", "--", *_arguments(settings(problem, row), folder)])


def write_gears(program: FileName, problem: Problem, row: DesignRow, folder: FileName) -> bool:
    """Writes solids, meshes and drawings; whether the check with fillets finds the gears free of interference."""
    shape, free = _answer(program, settings(problem, row), Path(folder))
    cad.write(shape, folder, ("step", "glb", "dxf"))
    return free


def _answer(program: FileName, wanted: dict[str, str], folder: Path) -> tuple[dict, bool]:
    """The gears as data, and whether they turn freely, by `program`."""
    try:
        done = subprocess.run([str(program), *_arguments(wanted, folder)], capture_output=True, text=True, check=False)
    except OSError as error:
        raise DifferentialError(f"{program}: {error}; name the program fmu-build by --program") from None
    if done.returncode:
        raise DifferentialError(f"{program} geometry: {done.stderr.strip() or done.stdout.strip()}")
    shape = json.loads((folder / "shape.json").read_text(encoding="utf-8"))
    return shape, "INTERFERENCE" not in (folder / "interference.txt").read_text(encoding="utf-8")


def _arguments(wanted: dict[str, str], folder: FileName) -> list[str]:
    return ["geometry", *(word for name, value in wanted.items() for word in ("--set", f"{name}={value}")), "--out", str(folder)]


def _toml(variable, value) -> str:
    if variable.literals:
        return _text(next(literal for literal, number in variable.literals.items() if number == value))
    return str(value).lower() if variable.kind == "Boolean" else repr(value)


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
