"""A chosen design for other programs: a scene file, and the gears as curves and solids by the command `geometry`."""

import shlex
import subprocess
from pathlib import Path

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


def arguments(problem: Problem, row: DesignRow, folder: FileName) -> list[str]:
    """Arguments of the command `geometry` for the design's gears."""
    catalogue = Catalogue(problem.scene.fmu)
    starts = catalogue.starts()
    values = {**problem.scene.values, **problem.complete(row.values)}
    wanted = {name: value for name, value in values.items() if name.startswith("geometry.") and value != starts[name]}
    if values.get("effects.backlash") is False:
        wanted["effects.backlash"] = False
    told = ["geometry"]
    for name, value in wanted.items():
        told += ["--set", f"{name}={_toml(catalogue.variable(name), value).strip(chr(34))}"]
    return [*told, "--out", str(folder)]


def command_line(problem: Problem, row: DesignRow, folder: FileName) -> str:
    """The same as a line for the shell, at the top of the repository."""
    return shlex.join(["cargo", "run", "--release", "--", *arguments(problem, row, folder)])


def write_gears(program: FileName, problem: Problem, row: DesignRow, folder: FileName) -> bool:
    """Writes curves and solids by `program`; whether its check with fillets finds the gears free of interference."""
    folder = Path(folder)
    try:
        done = subprocess.run([str(program), *arguments(problem, row, folder)], capture_output=True, text=True, check=False)
    except OSError as error:
        raise DifferentialError(f"{program}: {error}; name the program fmu-build by --program") from None
    if done.returncode:
        raise DifferentialError(f"{program} geometry: {done.stderr.strip() or done.stdout.strip()}")
    return "INTERFERENCE" not in (folder / "interference.txt").read_text(encoding="utf-8")


def _toml(variable, value) -> str:
    if variable.literals:
        return _text(next(literal for literal, number in variable.literals.items() if number == value))
    return str(value).lower() if variable.kind == "Boolean" else repr(value)


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
