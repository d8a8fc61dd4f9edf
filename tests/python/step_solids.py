"""Solids of STEP files, read by Open CASCADE: parts, masses, faces. The imports of this module need the extra `cad`."""

import io

import numpy as np


def read_step(data):
    """Shape in a file."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    assert reader.ReadStream("gears", io.BytesIO(data)) == IFSelect_RetDone
    reader.TransferRoots()
    return reader.OneShape()


def parts_of(shape, kind):
    """Yields the solids, shells or faces of a shape, according to `kind`."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found = TopExp_Explorer(shape, getattr(TopAbs_ShapeEnum, f"TopAbs_{kind}"))
    while found.More():
        yield found.Current()
        found.Next()


def weighed(solid):
    """Volume [mm³], moments of inertia about the axis and across it at the apex [mm⁵], height of the centre [mm]."""
    from OCP.BRepGProp import BRepGProp
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, found, 1e-6, True, False)
    about = [found.MomentOfInertia(gp_Ax1(gp_Pnt(), gp_Dir(*axis))) for axis in ((0, 0, 1), (1, 0, 0), (0, 1, 0))]
    return found.Mass(), *about, found.CentreOfMass().Z()


def ruled_faces(solid, each):
    """Yields a grid of `each` by `each` points for every spline surface whose lines pass through the apex."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.gp import gp_Pnt, gp_Vec
    from OCP.TopoDS import TopoDS

    splines = []
    for face in map(TopoDS.Face, parts_of(solid, "FACE")):
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_BSplineSurface:
            continue
        low, high = surface.FirstUParameter(), surface.LastUParameter()
        ends = surface.FirstVParameter(), surface.LastVParameter()
        point, along, across = gp_Pnt(), gp_Vec(), gp_Vec()
        surface.D1((low + high) / 2.0, sum(ends) / 2.0, point, along, across)
        if abs(along.Crossed(across).Normalized().Dot(gp_Vec(point.XYZ()).Normalized())) < 1e-6:
            splines.append((BRep_Tool.Surface_s(face), low, high, *ends))
    for surface, low, high, start, end in splines:
        yield np.array([[surface.Value(u, v).Coord() for u in np.linspace(low, high, each)] for v in np.linspace(start, end, each)])


def centre_of(solid):
    """Centre of mass of a solid [mm]."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, found)
    return found.CentreOfMass().Coord()


def near_faces(one, other, within):
    """Faces of two solids that may be closer than `within` to the other solid, by their bounding boxes, as two shapes."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRep import BRep_Builder
    from OCP.BRepBndLib import BRepBndLib
    from OCP.TopoDS import TopoDS_Compound

    faces, corners = [list(parts_of(solid, "FACE")) for solid in (one, other)], []
    for each in faces:
        boxes = [Bnd_Box() for _ in each]
        for face, box in zip(each, boxes, strict=True):
            BRepBndLib.Add_s(face, box)
        corners.append([np.array([[at.X(), at.Y(), at.Z()] for at in ends]) for ends in
                        ([box.CornerMin() for box in boxes], [box.CornerMax() for box in boxes])])
    (low, high), (low_other, high_other) = corners
    near = np.all((low[:, None] - within < high_other) & (low_other - within < high[:, None]), axis=2)
    shapes = []
    for each, chosen in zip(faces, (near.any(axis=1), near.any(axis=0)), strict=True):
        builder, whole = BRep_Builder(), TopoDS_Compound()
        builder.MakeCompound(whole)
        for k in np.flatnonzero(chosen):
            builder.Add(whole, each[k])
        shapes.append(whole)
    return shapes
