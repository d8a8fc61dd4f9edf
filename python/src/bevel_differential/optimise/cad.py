"""A chosen design for other programs: a scene file, and the gears."""

import json

from .. import cad
from ..answers import ask, assignments
from ..values import FileName
from .design_task import DesignRow
from .problem import Problem


def scene_text(problem: Problem, row: DesignRow, description: str) -> str:
    """The problem's scene with the design in it, as a scene file."""
    scene = problem.scene
    held = scene.contents({**scene.values, **problem.complete(row.values)})
    lines = [*_entries({**held, "description": description}, "description", "stop_time", "step", "outputs"), "", "[set]",
             *_entries(held["set"])]
    for kind in ("at", "table"):
        for entry in held[kind]:
            lines += ["", f"[[{kind}]]", *_entries(entry)]
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


def _entries(table, *names):
    """Lines of a table: what JSON writes of numbers, texts, truths and lists is TOML as well."""
    return [f"{name} = {json.dumps(table[name], ensure_ascii=False)}" for name in names or table]
