"""Solids of gears and pins by Open CASCADE, in millimetres: the faces of one tooth, copied around the axis and sewn together.

All faces of a tooth are cones whose apex is the pitch apex. Tip and root land are cones about the gear's axis. A flank is a
ruled surface from a spline through points of the involute at the toe to the same spline, enlarged, at the heel. A fillet is such
a surface too. Heel and toe are planes within the root circles. Outside the root circles, they are cones about the axis under the
tip land and under the fillet. Between these cones, under the flank, they are surfaces of straight lines in planes through the
axis."""

import math

import numpy as np
from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeSolid,
    BRepBuilderAPI_MakeVertex,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_Sewing,
    BRepBuilderAPI_Transform,
)
from OCP.BRepLib import BRepLib
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
from OCP.collections import Array1_double, Array1_int, Array2_gp_Pnt, HArray1_double, HArray1_gp_Pnt
from OCP.Geom import Geom_BSplineSurface, Geom_ConicalSurface, Geom_CylindricalSurface
from OCP.GeomAPI import GeomAPI_Interpolate
from OCP.gp import gp_Ax1, gp_Ax2, gp_Ax3, gp_Circ, gp_Dir, gp_Pln, gp_Pnt, gp_Trsf
from OCP.TopoDS import TopoDS

from ..values import DifferentialError

MM = 1e3
# largest gap that sewing closes, relative to the cone distance: splines through the same points differ from arcs by nanometres
SEAM = 1e-6
# distance within which Open CASCADE treats points as equal [mm]
POINT = 1e-7
# azimuths [rad] and unit vectors that differ by less are equal
ROUNDING = 1e-9
AXIS, ACROSS = gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)


def gear_solid(shape, i):
    """Gear `i` of the shape, 0 planet and 1 side gear, in its own frame."""
    gear, cones = shape["gears"][i], [MM * shape[name] for name in ("inner_cone", "outer_cone")]
    foot, flank = np.array(gear["foot"]), np.array(gear["flank"])
    sewing, teeth = BRepBuilderAPI_Sewing(SEAM * cones[1]), gear["teeth"]
    faces = [face for side in (1.0, -1.0) for face in _side(gear, cones, foot * [1, side, 1], flank * [1, side, 1])]
    faces += _lands(gear, cones, foot, flank)
    for tooth in range(teeth):
        turn = gp_Trsf()
        turn.SetRotation(gp_Ax1(gp_Pnt(), AXIS), tooth * math.tau / teeth)
        for face in faces:
            sewing.Add(BRepBuilderAPI_Transform(face, turn, True).Shape())
    for face in _blank(gear, cones, _azimuth(np.array([foot[0], foot[-1], flank[-1]]))):
        sewing.Add(face)
    sewing.Perform()
    if sewing.NbFreeEdges() or sewing.NbMultipleEdges():
        raise DifferentialError(f"the faces of the {gear['name']} cannot be sewn: {sewing.NbFreeEdges()} open edges", kind="failed")
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(sewing.SewedShape())).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid


def pins_solid(shape):
    """All pins as one body in the frame of the assembly: a rod, a cross or a star."""
    solid = None
    for start, end in MM * np.array(shape["pins"]["rods"]):
        along = gp_Ax2(_point(start), gp_Dir(*(end - start)))
        rod = BRepPrimAPI_MakeCylinder(along, MM * shape["pins"]["radius"], float(np.linalg.norm(end - start))).Solid()
        solid = BRepAlgoAPI_Fuse(solid, rod).Shape() if solid else rod
    return solid


def _side(gear, cones, foot, flank):
    """Faces on one side of a tooth, from the middle of a gap to the tip."""
    root, base = gear["root"], _polar(flank[:1])[0]
    arcs = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(flank, axis=0), axis=1)))
    yield _ruled(*(cone * flank for cone in cones), arcs)
    yield from (_ruled(cone * _on_circle(root, flank), cone * flank, arcs) for cone in cones)
    # the cone from the root circle to the start of the flank cuts rays at these fractions of the cone distance
    share = math.cos((base - root) / 2) / np.cos(_polar(foot) - (base + root) / 2)
    edge = foot * share[:, None]
    if len(foot) > 1:
        even = np.arange(len(foot)) / (len(foot) - 1)
        yield _ruled(*(cone * edge for cone in cones), even)
        yield from (_ruled(cone * _on_circle(root, foot), cone * edge, even) for cone in cones)
    if np.linalg.norm(foot[-1] - flank[0]) > ROUNDING:
        corners = BRepBuilderAPI_MakePolygon(*(_point(p) for p in (cones[0] * edge[-1], cones[0] * flank[0],
                                                                   cones[1] * flank[0], cones[1] * edge[-1])), True)
        yield BRepBuilderAPI_MakeFace(corners.Wire(), True).Face()


def _lands(gear, cones, foot, flank):
    """Tip land with its ends, and the root land next to it if there is one."""
    root, tip = gear["root"], gear["tip"]
    (middle, end), pitch = _azimuth(np.array([foot[0], flank[-1]])), math.tau / gear["teeth"]
    yield _cone((cones[0], tip), (cones[1], tip), -end, end)
    yield from (_cone((cone, root), (cone, tip), -end, end) for cone in cones)
    if pitch - 2.0 * middle > ROUNDING:
        yield _cone((cones[0], root), (cones[1], root), middle, pitch - middle)


def _blank(gear, cones, corners):
    """Planes of toe and heel, with corners at these azimuths of each tooth, and the bore."""
    pitch, radius = math.tau / gear["teeth"], MM * gear["bore"] / 2.0
    of_tooth = np.sort(np.append(corners, -corners))
    around = (of_tooth + pitch * np.arange(gear["teeth"])[:, None]).ravel()
    around = around[np.diff(around, prepend=around[-1] - math.tau) > ROUNDING]
    heights = [cone * math.cos(gear["root"]) for cone in cones]
    for cone, height in zip(cones, heights, strict=True):
        at, rim = gp_Pnt(0, 0, height), cone * math.sin(gear["root"])
        vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(rim * math.cos(a), rim * math.sin(a), height)).Vertex() for a in around]
        circle, wire = gp_Circ(gp_Ax2(at, AXIS, ACROSS), rim), BRepBuilderAPI_MakeWire()
        for pair in zip(vertices, vertices[1:] + vertices[:1], strict=True):
            wire.Add(BRepBuilderAPI_MakeEdge(circle, *pair).Edge())
        face = BRepBuilderAPI_MakeFace(gp_Pln(at, AXIS), wire.Wire(), True)
        if radius:
            hole = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(at, gp_Dir(0, 0, -1), ACROSS), radius)).Edge()
            face.Add(BRepBuilderAPI_MakeWire(hole).Wire())
        yield face.Face()
    if radius:
        yield BRepBuilderAPI_MakeFace(Geom_CylindricalSurface(gp_Ax3(), radius), 0.0, math.tau, *heights, POINT).Face()


def _ruled(low, high, at):
    """Face of straight lines between cubic splines through the points `low` and `high`, both with the parameters `at`."""
    curves = [_spline(points, at) for points in (low, high)]
    count = curves[0].NbPoles()
    poles, ends, twice = Array2_gp_Pnt(1, count, 1, 2), Array1_double(1, 2), Array1_int(1, 2)
    for j, curve in enumerate(curves, 1):
        for k in range(1, count + 1):
            poles.SetValue(k, j, curve.Pole(k))
        ends.SetValue(j, j - 1.0)
        twice.SetValue(j, 2)
    knots, multiplicities, degree = curves[0].Knots(), curves[0].Multiplicities(), curves[0].Degree()
    surface = Geom_BSplineSurface(poles, knots, ends, multiplicities, twice, degree, 1, False, False)
    return BRepBuilderAPI_MakeFace(surface, POINT).Face()


def _spline(points, at):
    through, parameters = HArray1_gp_Pnt(1, len(points)), HArray1_double(1, len(points))
    for k, (point, parameter) in enumerate(zip(points, at, strict=True), 1):
        through.SetValue(k, _point(point))
        parameters.SetValue(k, float(parameter))
    interpolation = GeomAPI_Interpolate(through, parameters, False, POINT)
    interpolation.Perform()
    return interpolation.Curve()


def _cone(start, end, low, high):
    """Face of a cone about the axis, between two points (cone distance, polar angle) and two azimuths."""
    (a, x), (b, y) = sorted(((r * math.cos(polar), r * math.sin(polar)) for r, polar in (start, end)))
    surface = Geom_ConicalSurface(gp_Ax3(gp_Pnt(0, 0, a), AXIS, ACROSS), math.atan2(y - x, b - a), x)
    return BRepBuilderAPI_MakeFace(surface, low, high, 0.0, math.hypot(y - x, b - a), POINT).Face()


def _on_circle(polar, points):
    """Points on the circle at the polar angle `polar` that have the azimuths of `points`."""
    azimuth = _azimuth(points)
    ring = math.sin(polar)
    return np.stack([ring * np.cos(azimuth), ring * np.sin(azimuth), np.full(len(points), math.cos(polar))], axis=1)


def _azimuth(points):
    return np.arctan2(points[:, 1], points[:, 0])


def _polar(points):
    return np.arctan2(np.hypot(points[:, 0], points[:, 1]), points[:, 2])


def _point(vector):
    return gp_Pnt(*map(float, vector))
