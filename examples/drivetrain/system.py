"""Builds the other parts with pythonfmu and packs all parts into one archive by the standard SSP 1.0."""

import shutil
import sys
import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

from pythonfmu.builder import FmuBuilder

from parameters import CONNECTIONS, END, PARTS, settings

HERE = Path(__file__).parent
# files in each of these FMUs: the base class of the parts, and the package's equations of tyre, motor and body
SHARED = [HERE / "parts" / "part.py", HERE.parents[1] / "python/src/bevel_differential/vehicle/equations.py"]
# pythonfmu imports a part to describe it. The folder is last on the path because it also contains a part.py
sys.path.append(str(SHARED[1].parent))
# file of each class that pythonfmu builds
SOURCES = {"Engine": "engine.py", "FinalDrive": "final_drive.py", "Wheel": "wheel.py", "Vehicle": "vehicle.py"}
SPACES = ('xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" '
          'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" '
          'xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"')
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'


def make_parts(differential, folder):
    """FMUs by class, in `folder`; `differential` is the FMU of this program."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for source in SOURCES.values():
        FmuBuilder.build_FMU(str(HERE / "parts" / source), dest=str(folder), project_files=SHARED,
                             canGetAndSetFMUstate="true")
    shutil.copyfile(differential, folder / "BevelDifferential.fmu")
    return {name: folder / f"{name}.fmu" for name in set(PARTS.values())}


def write_ssp(file, fmus, contact):
    """Writes the archive: the FMUs in resources, connectors, connections, and the values of each part."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, fmu in sorted(fmus.items()):
            archive.write(fmu, f"resources/{name}.fmu")
        bound = []
        for part in PARTS:
            values = {variable: value for (owner, variable), value in settings(contact).items() if owner == part}
            if values:
                archive.writestr(f"resources/{part}.ssv", parameter_set(part, values))
                bound.append(part)
        archive.writestr("SystemStructure.ssd", structure(bound))


def parameter_set(part, values):
    rows = "".join(f"    <ssv:Parameter name={quoteattr(name)}><ssv:{kind(value)} value=\"{value!r}\"/></ssv:Parameter>\n"
                   for name, value in values.items())
    return (f'{HEAD}<ssv:ParameterSet {SPACES} version="1.0" name="initialValues">\n  <ssv:Parameters>\n{rows}'
            "  </ssv:Parameters>\n</ssv:ParameterSet>\n")


def kind(value):
    return "Integer" if isinstance(value, int) else "Real"


def structure(bound):
    parts = "".join(component(part, part in bound) for part in PARTS)
    lines = "".join(
        f'      <ssd:Connection startElement="{source}" startConnector={quoteattr(output)} '
        f'endElement="{part}" endConnector={quoteattr(name)}/>\n'
        for (part, name), (source, output) in CONNECTIONS.items())
    return (f'{HEAD}<ssd:SystemStructureDescription {SPACES} version="1.0" name="drivetrain">\n'
            '  <ssd:System name="drivetrain" description="Launch of a car with a differential on split friction">\n'
            f"    <ssd:Elements>\n{parts}    </ssd:Elements>\n    <ssd:Connections>\n{lines}    </ssd:Connections>\n"
            f'  </ssd:System>\n  <ssd:DefaultExperiment startTime="0.0" stopTime="{END}"/>\n'
            "</ssd:SystemStructureDescription>\n")


def component(part, bound):
    inputs = [name for owner, name in CONNECTIONS if owner == part]
    outputs = dict.fromkeys(output for owner, output in CONNECTIONS.values() if owner == part)
    rows = "".join(f'          <ssd:Connector name={quoteattr(name)} kind="{kind}"><ssc:Real/></ssd:Connector>\n'
                   for kind, names in (("input", inputs), ("output", outputs)) for name in names)
    binding = ""
    if bound:
        binding = (f'        <ssd:ParameterBindings>\n          <ssd:ParameterBinding source="resources/{part}.ssv"/>\n'
                   "        </ssd:ParameterBindings>\n")
    return (f'      <ssd:Component name="{part}" type="application/x-fmu-sharedlibrary" '
            f'source="resources/{PARTS[part]}.fmu">\n        <ssd:Connectors>\n{rows}        </ssd:Connectors>\n{binding}'
            "      </ssd:Component>\n")
