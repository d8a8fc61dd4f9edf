"""STEP: the solid of one gear, or the differential as an assembly of named parts with its pins."""

from io import BytesIO

from OCP.gp import gp_Trsf
from OCP.IFSelect import IFSelect_RetDone
from OCP.Message import Message, Message_Gravity
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_DocumentTool

from ..values import DifferentialError
from .solid import gear_solid, pins_solid


def step(shape, part, solids):
    """File as bytes; `part` is planet, side_gear or assembly. `solids` caches gears by name; missing gears are added."""
    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)
    document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())

    def named(label, name):
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
        return label

    names = [gear["name"] for gear in shape["gears"]]
    wanted = names if part == "assembly" else [part]
    for name in wanted:
        if name not in solids:
            solids[name] = gear_solid(shape, names.index(name))
    parts = {name: named(tool.AddShape(solids[name], False), name) for name in wanted}
    if part == "assembly":
        whole = named(tool.NewShape(), "differential")
        for body in shape["bodies"]:
            placed = gp_Trsf()
            placed.SetValues(*(value for row in body["rotation"] for value in (*row, 0.0)))
            named(tool.AddComponent(whole, parts[names[body["gear"]]], TopLoc_Location(placed)), body["name"])
        if shape["pins"]:
            pins = named(tool.AddShape(pins_solid(shape), False), "pins")
            named(tool.AddComponent(whole, pins, TopLoc_Location()), "pins")
        tool.UpdateAssemblies()
    writer, stream = STEPCAFControl_Writer(), BytesIO()
    if not writer.Transfer(document) or writer.WriteStream(stream) != IFSelect_RetDone:
        raise DifferentialError(f"Open CASCADE cannot write the {part} as STEP", kind="failed")
    return stream.getvalue()
