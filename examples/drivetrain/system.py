"""Packs all parts into one archive by the standard SSP, 1.0 or 2.0. Both versions have the same elements in the same namespaces."""

import zipfile
from xml.sax.saxutils import quoteattr

# versions of the standard. Most hosts read only the first one
VERSIONS = ("1.0", "2.0")
SPACES = ('xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" '
          'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues" '
          'xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"')
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'


def archive_file(folder, name, version):
    """Path of the archive `name`. Archives of SSP 1.0 have no version in their name."""
    return folder / f"{name}{'' if version == VERSIONS[0] else f'_ssp{version}'}.ssp"


def write_ssp(file, fmus, system, version):
    """Writes the archive of a `Structure`: the FMUs in resources, connectors, connections, and the values of each part. The description
    and the values state `version`."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(set(system.parts.values())):
            archive.write(fmus[name], f"resources/{name}.fmu")
        for part in system.parts:
            if values := system.of(part):
                archive.writestr(f"resources/{part}.ssv", parameter_set(values, version))
        archive.writestr("SystemStructure.ssd", structure(system, version))


def parameter_set(values, version):
    rows = "".join(f"    <ssv:Parameter name={quoteattr(name)}><ssv:{kind(value)} value=\"{text(value)}\"/></ssv:Parameter>\n"
                   for name, value in values.items())
    return (f'{HEAD}<ssv:ParameterSet {SPACES} version="{version}" name="initialValues">\n  <ssv:Parameters>\n{rows}'
            "  </ssv:Parameters>\n</ssv:ParameterSet>\n")


def kind(value):
    return "Boolean" if isinstance(value, bool) else "Integer" if isinstance(value, int) else "Real"


def text(value):
    return str(value).lower() if isinstance(value, bool) else repr(value)


def structure(system, version):
    parts = "".join(component(system, part) for part in system.parts)
    lines = "".join(
        f'      <ssd:Connection startElement="{source}" startConnector={quoteattr(output)} '
        f'endElement="{part}" endConnector={quoteattr(name)}/>\n'
        for (part, name), (source, output) in system.connections.items())
    return (f'{HEAD}<ssd:SystemStructureDescription {SPACES} version="{version}" name={quoteattr(system.name)}>\n'
            f'  <ssd:System name={quoteattr(system.name)} description={quoteattr(system.description)}>\n'
            f"    <ssd:Elements>\n{parts}    </ssd:Elements>\n    <ssd:Connections>\n{lines}    </ssd:Connections>\n"
            f'  </ssd:System>\n  <ssd:DefaultExperiment startTime="0.0" stopTime="{system.end}"/>\n'
            "</ssd:SystemStructureDescription>\n")


def component(system, part):
    inputs = [name for owner, name in system.connections if owner == part]
    outputs = dict.fromkeys(output for owner, output in system.connections.values() if owner == part)
    rows = "".join(f'          <ssd:Connector name={quoteattr(name)} kind="{kind}"><ssc:Real/></ssd:Connector>\n'
                   for kind, names in (("input", inputs), ("output", outputs)) for name in names)
    binding = ""
    if system.of(part):
        binding = (f'        <ssd:ParameterBindings>\n          <ssd:ParameterBinding source="resources/{part}.ssv"/>\n'
                   "        </ssd:ParameterBindings>\n")
    return (f'      <ssd:Component name="{part}" type="application/x-fmu-sharedlibrary" '
            f'source="resources/{system.parts[part]}.fmu">\n        <ssd:Connectors>\n{rows}        </ssd:Connectors>\n{binding}'
            "      </ssd:Component>\n")
