"""The gears for other programs: solids as STEP, meshes as STL, 3MF and GLB, drawings as DXF, curves as text. All are made from one
dictionary, the `shape` that the library answers with."""

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..extras import needed
from ..values import DifferentialError, FileName

GEARS = ("planet", "side_gear")
PARTS = (*GEARS, "assembly")
MESHES = ("stl", "3mf", "glb")
KINDS = ("step", *MESHES, "dxf", "txt")


def step(shape: dict, part: str = "assembly") -> bytes:
    """The solid of a gear, or all gears and pins of the differential, as STEP in millimetres."""
    needed("OCP.gp", "cad")
    from .step_file import step

    return step(shape, part)


def mesh(shape: dict, part: str = "assembly", kind: str = "glb") -> bytes:
    """The same as facets; STL and 3MF in millimetres, GLB in metres."""
    for module in ("trimesh", "lxml", "networkx") if kind == "3mf" else ("trimesh",):
        needed(module, "cad")
    from .mesh_file import mesh

    return mesh(shape, part, kind)


def drawing(shape: dict, part: str) -> bytes:
    """Outlines at heel and toe as curves in space, and the section of a gear with its dimensions, as DXF in millimetres."""
    needed("ezdxf", "cad")
    from .dxf_file import drawing

    return drawing(shape, part)


def curves(shape: dict, part: str) -> dict[str, bytes]:
    """Flanks and outlines of a gear at heel and toe by name: a line per point, x y z in millimetres."""
    from .xyz_file import curves

    return curves(shape, part)


def write(shape: dict, folder: FileName, kinds: Iterable[str] = ("step",), parts: Iterable[str] = PARTS) -> list[Path]:
    """Writes files of these kinds for these parts, all made before the first is written; where they are."""
    kinds, parts, folder = list(kinds), list(parts), Path(folder)
    for given, known in ((kinds, KINDS), (parts, PARTS)):
        for name in given:
            if name not in known:
                raise DifferentialError(f"{name}: must be one of {', '.join(known)}")
    made = dict(file for part in parts for kind in kinds for file in _files(shape, part, kind))
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in made.items():
        (folder / name).write_bytes(content)
    return [folder / name for name in made]


def _files(shape: dict, part: str, kind: str) -> Iterator[tuple[str, bytes]]:
    if kind == "step":
        yield f"{part}.step", step(shape, part)
    elif kind in MESHES:
        yield f"{part}.{kind}", mesh(shape, part, kind)
    elif part in GEARS:
        if kind == "dxf":
            yield f"{part}.dxf", drawing(shape, part)
        else:
            yield from ((f"{name}.txt", text) for name, text in curves(shape, part).items())
