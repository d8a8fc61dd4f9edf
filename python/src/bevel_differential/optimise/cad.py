"""A chosen design for other programs: a scene file, and the gears."""

from .. import cad
from ..answers import ask, assignments
from ..values import FileName
from .design_task import DesignRow
from .problem import Problem


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


def write_gears(problem: Problem, row: DesignRow, folder: FileName) -> bool:
    """Writes dimensions and curves of the design's gears, and with the extra `cad` solids, meshes and drawings; whether the check
    with fillets finds them free of interference."""
    kinds = ("step", "glb", "dxf") if cad.available() else ()
    found = ask({"ask": "geometry", "set": settings(problem, row), "solids": bool(kinds)})
    cad.write(found, folder, kinds)
    return not found["interference"]


def settings(problem: Problem, row: DesignRow) -> list[str]:
    """What the design's gears have otherwise than the FMU's own, each "name=value"."""
    fmu = problem.scene.fmu
    values = {**problem.scene.values, **problem.complete(row.values)}
    changed = {name: value for name, value in values.items()
               if name.startswith("geometry.") and value != fmu.variable(name).start or name == "effects.backlash" and not value}
    return assignments({name: fmu.variable(name).written(value) for name, value in changed.items()})


def _toml(variable, value) -> str:
    if variable.literals:
        return _text(next(literal for literal, number in variable.literals.items() if number == value))
    return str(value).lower() if variable.kind == "Boolean" else repr(value)


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
