"""Drawings of a gear as DXF by ezdxf, in millimetres.

The outlines of all teeth at heel and toe are around the origin. They are curves in space, seen along the axis, from which other
programs can build models. Next to them is the section through the axis with its dimensions."""

import io
import math

import ezdxf
import numpy as np
from ezdxf.enums import TextEntityAlignment
from ezdxf.math import global_bspline_interpolation

MM = 1e3
STYLE = {"dimtxt": 2.2, "dimasz": 2.2, "dimexe": 1.0, "dimexo": 0.5, "dimgap": 0.8, "dimdec": 3, "dimadec": 4, "dimtad": 1,
         "dimdsep": ord(".")}
# distance from the axis of the view to the apex of the section, in cone distances; distance between dimension lines [mm]
BESIDE, APART = 1.6, 7.0
LAYERS = {"heel": ("CONTINUOUS", 7), "toe": ("CONTINUOUS", 4), "section": ("CONTINUOUS", 7), "gap": ("DASHED", 8),
          "centre": ("CENTER", 1), "dimensions": ("CONTINUOUS", 3)}


def drawing(shape, part):
    """File as bytes; `part` is planet or side_gear."""
    document = ezdxf.new("R2010", setup=True)
    document.units = ezdxf.units.MM
    document.header["$LTSCALE"] = 10.0
    for name, (line, colour) in LAYERS.items():
        document.layers.add(name, linetype=line, color=colour)
    space = document.modelspace()
    gear = next(gear for gear in shape["gears"] if gear["name"] == part)
    toe, heel = (MM * shape[name] for name in ("inner_cone", "outer_cone"))
    for name, cone in (("heel", heel), ("toe", toe)):
        _outline(space, gear, cone, name)
    _section(space, gear, toe, heel)
    text = io.StringIO()
    document.write(text)
    return text.getvalue().encode()


def _outline(space, gear, cone, layer):
    """Draws the outline of all teeth at this cone distance."""
    on, pitch = {"layer": layer}, math.tau / gear["teeth"]
    foot, flank = np.array(gear["foot"]), np.array(gear["flank"])
    low, high = (math.atan2(point[1], point[0]) for point in (foot[0], flank[-1]))
    for tooth in range(gear["teeth"]):
        turn = tooth * pitch
        turned = np.array([[math.cos(turn), math.sin(turn), 0.0], [-math.sin(turn), math.cos(turn), 0.0], [0.0, 0.0, 1.0]])
        for side in (1.0, -1.0):
            placed = [cone * (points * [1.0, side, 1.0]) @ turned for points in (foot, flank)]
            for points in placed:
                if len(points) > 1:
                    space.add_spline(dxfattribs=on).apply_construction_tool(global_bspline_interpolation(points))
            if np.linalg.norm(placed[0][-1] - placed[1][0]) > 1e-6:
                space.add_line(placed[0][-1], placed[1][0], dxfattribs=on)
        for start, end, polar in ((-high, high, gear["tip"]), (low, pitch - low, gear["root"])):
            if end - start > 1e-9:
                at = (0.0, 0.0, cone * math.cos(polar))
                space.add_arc(at, cone * math.sin(polar), *np.degrees([turn + start, turn + end]), dxfattribs=on)
    if gear["bore"]:
        space.add_circle((0.0, 0.0, cone * math.cos(gear["root"])), MM * gear["bore"] / 2.0, dxfattribs=on)


def _section(space, gear, toe, heel):
    """Draws the section through the middle of a tooth and, dashed, of a gap. The apex is left, the axis points to the right."""
    root, tip, pitch, bore = gear["root"], gear["tip"], gear["pitch"], MM * gear["bore"] / 2.0
    left = BESIDE * heel

    def at(cone, polar, up=1.0):
        return left + cone * math.cos(polar), up * cone * math.sin(polar)

    apex, top = (left, 0.0), heel * math.sin(tip)
    for up in (1.0, -1.0):
        (a, x), (b, y) = at(toe, root, up), at(heel, root, up)
        blank = [(a, up * bore), (a, x), at(toe, tip, up), at(heel, tip, up), (b, y), (b, up * bore)]
        space.add_lwpolyline(blank, close=True, dxfattribs={"layer": "section"})
        space.add_line((a, x), (b, y), dxfattribs={"layer": "gap"})
        space.add_line(apex, at(1.05 * heel, pitch, up), dxfattribs={"layer": "centre"})
    space.add_line((left - 3.0, 0.0), (left + heel * math.cos(min(root, pitch, tip)) + 3.0, 0.0), dxfattribs={"layer": "centre"})

    right = left + heel * math.cos(root)
    across = [(heel * math.sin(tip), at(heel, tip), at(heel, tip, -1.0)),
              (heel * math.sin(root), at(heel, root), at(heel, root, -1.0)),
              (bore, (right, bore), (right, -bore))]
    dimensions = []
    for index, (radius, one, other) in enumerate(sorted(across), 1):
        if radius:
            dimensions.append(space.add_linear_dim((right + APART * index, 0.0), other, one, angle=90, text="%%c<>",
                                                   **_style()))
    along = [at(toe, tip), at(toe, root), at(heel, tip), at(heel, root)]
    for index, point in enumerate(sorted(along, key=lambda point: point[0]), 1):
        dimensions.append(space.add_linear_dim((left, -top - APART * index), apex, (point[0], -point[1]), **_style()))
    for start, index in ((at(toe, tip), 1), (apex, 2)):
        dimensions.append(space.add_aligned_dim(start, at(heel, tip), distance=APART * index, **_style()))
    for index, polar in enumerate(sorted((root, pitch, tip)), 1):
        reach = toe * (0.15 + 0.25 * index)
        dimensions.append(space.add_angular_dim_3p((left + reach * math.cos(polar / 2), reach * math.sin(polar / 2)), apex,
                                                   (right, 0.0), at(heel, polar), **_style()))
    for dimension in dimensions:
        dimension.render()
    title = f"{gear['name'].replace('_', ' ')}, {gear['teeth']} teeth: mm, deg"
    space.add_text(title, height=3.5, dxfattribs={"layer": "dimensions"}).set_placement(
        (left, top + 3.0 * APART), align=TextEntityAlignment.LEFT)


def _style():
    return {"override": dict(STYLE), "dimstyle": "Standard", "dxfattribs": {"layer": "dimensions"}}
