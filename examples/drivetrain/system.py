"""Packs all parts into one archive by the standard SSP, 1.0 or 2.0. Both versions have the same elements in the same namespaces."""

import zipfile
from xml.sax.saxutils import quoteattr

from parameters import CONNECTIONS, END, PARTS, settings

# versions of the standard. Most hosts read only the first one
VERSIONS = ("1.0", "2.0")
SPACES = ('xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" '
          'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" '
          'xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"')
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'


def archive_file(folder, contact, version):
    """Path of the archive. Archives of SSP 1.0 have no version in their name."""
    return folder / f"drivetrain_{contact}{'' if version == VERSIONS[0] else f'_ssp{version}'}.ssp"


def write_ssp(file, fmus, contact, version):
    """Writes the archive: the FMUs in resources, connectors, connections, and the values of each part. The description and the
    values state `version`."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, fmu in sorted(fmus.items()):
            archive.write(fmu, f"resources/{name}.fmu")
        bound = []
        for part in PARTS:
            values = {variable: value for (owner, variable), value in settings(contact).items() if owner == part}
            if values:
                archive.writestr(f"resources/{part}.ssv", parameter_set(part, values, version))
                bound.append(part)
        archive.writestr("SystemStructure.ssd", structure(bound, version))


def parameter_set(part, values, version):
    rows = "".join(f"    <ssv:Parameter name={quoteattr(name)}><ssv:{kind(value)} value=\"{value!r}\"/></ssv:Parameter>\n"
                   for name, value in values.items())
    return (f'{HEAD}<ssv:ParameterSet {SPACES} version="{version}" name="initialValues">\n  <ssv:Parameters>\n{rows}'
            "  </ssv:Parameters>\n</ssv:ParameterSet>\n")


def kind(value):
    return "Integer" if isinstance(value, int) else "Real"


def structure(bound, version):
    parts = "".join(component(part, part in bound) for part in PARTS)
    lines = "".join(
        f'      <ssd:Connection startElement="{source}" startConnector={quoteattr(output)} '
        f'endElement="{part}" endConnector={quoteattr(name)}/>\n'
        for (part, name), (source, output) in CONNECTIONS.items())
    return (f'{HEAD}<ssd:SystemStructureDescription {SPACES} version="{version}" name="drivetrain">\n'
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
