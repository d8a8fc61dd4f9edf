"""Mesh files by trimesh: one gear, or the whole differential with pins. STL and 3MF are in millimetres, GLB is in metres as glTF
requires."""

import numpy as np
import trimesh
from trimesh.visual.material import PBRMaterial

# length of a metre in each kind of file
METRE = {"stl": 1e3, "3mf": 1e3, "glb": 1.0}
# edges of the polygon that approximates a pin's circle
AROUND = 128
# red, green and blue of planet, side gear and pins
COLOURS = [(0.80, 0.62, 0.35), (0.62, 0.65, 0.70), (0.40, 0.42, 0.45)]


def mesh(shape, part, kind):
    """File as bytes; `part` is planet, side_gear or assembly, `kind` is one of METRE."""
    scale, scene = METRE[kind], trimesh.Scene()
    names = [gear["name"] for gear in shape["gears"]]
    solids = [_gear(gear, colour, scale) for gear, colour in zip(shape["gears"], COLOURS, strict=False)]
    if part == "assembly":
        for body in shape["bodies"]:
            placed = np.eye(4)
            placed[:3, :3] = body["rotation"]
            i = body["gear"]
            scene.add_geometry(solids[i], node_name=body["name"], geom_name=names[i], transform=placed)
        for number, pin in enumerate(_pins(shape["pins"], scale), 1):
            scene.add_geometry(pin, node_name=f"pin_{number}", geom_name=f"pin_{number}")
    else:
        scene.add_geometry(solids[names.index(part)], node_name=part, geom_name=part)
    # without normals glTF shades facets flat
    return scene.export(file_type=kind, **({"include_normals": False} if kind == "glb" else {}))


def _gear(gear, colour, scale):
    surface = gear["mesh"]
    vertices = scale * np.array(surface["vertices"])
    return trimesh.Trimesh(vertices, np.array(surface["triangles"]), process=False, visual=_metal(colour))


def _pins(pins, scale):
    for ends in pins["rods"] if pins else []:
        rod = trimesh.creation.cylinder(scale * pins["radius"], segment=scale * np.array(ends), sections=AROUND)
        rod.visual = _metal(COLOURS[2])
        yield rod


def _metal(colour):
    return trimesh.visual.TextureVisuals(material=PBRMaterial(
        baseColorFactor=[round(255 * c) for c in colour] + [255], metallicFactor=0.85, roughnessFactor=0.4))
