"""Exports the gears to other programs: solids as STEP, meshes as STL, 3MF and GLB, drawings as DXF. All use one dictionary, the
`shape` in the answer about gears."""

from collections.abc import Collection
from importlib.util import find_spec
from itertools import product
from typing import Any

from ..extras import require
from ..values import FileName
from ..writing import in_folder, write_whole

GEARS = ("planet", "side_gear")
PARTS = (*GEARS, "assembly")
MESHES = ("stl", "3mf", "glb")
KINDS = ("step", *MESHES, "dxf")
EXTRA = "cad"


def available() -> bool:
    """True if the packages of the extra are installed."""
    return all(find_spec(name) for name in ("OCP", "ezdxf", "trimesh"))


def step(shape: dict[str, Any], part: str = "assembly", solids: dict[str, Any] | None = None) -> bytes:
    """Solid of one gear, or of all gears and pins of the differential, as STEP in millimetres. `solids` caches gears of the shape
    for other parts."""
    require("OCP.gp", EXTRA)
    from .step_file import step

    return step(shape, part, {} if solids is None else solids)


def mesh(shape: dict[str, Any], part: str = "assembly", kind: str = "glb") -> bytes:
    """Mesh of one gear, or of all gears and pins of the differential: STL and 3MF in millimetres, GLB in metres."""
    for module in ("trimesh", "lxml", "networkx") if kind == "3mf" else ("trimesh",):
        require(module, EXTRA)
    from .mesh_file import mesh

    return mesh(shape, part, kind)


def drawing(shape: dict[str, Any], part: str) -> bytes:
    """Drawing of a gear as DXF in millimetres: outlines at heel and toe as curves in space, and the section with dimensions."""
    require("ezdxf", EXTRA)
    from .dxf_file import drawing

    return drawing(shape, part)


def write(found: dict[str, Any], folder: FileName, kinds: Collection[str] = (), parts: Collection[str] = PARTS) -> list[str]:
    """Writes the files of an answer about gears, and files of `kinds` for `parts`. All are created before the first is written.
    Returns their names."""
    files = {name: content.encode() for name, content in found["files"].items()}
    solids: dict[str, Any] = {}
    for part, kind in product(parts, kinds):
        if kind == "step":
            files[f"{part}.step"] = step(found["shape"], part, solids)
        elif kind in MESHES:
            files[f"{part}.{kind}"] = mesh(found["shape"], part, kind)
        elif part in GEARS:
            files[f"{part}.dxf"] = drawing(found["shape"], part)
    with in_folder(folder) as stage:
        for name, content in files.items():
            write_whole(stage / name, content)
    return list(files)
