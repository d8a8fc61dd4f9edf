"""Content of an SSP archive, read from its XML without the code that writes it, and comparison of two archives."""

import zipfile
from xml.etree import ElementTree

SPACES = {part: f"http://ssp-standard.org/SSP1/SystemStructure{name}"
          for part, name in (("ssd", "Description"), ("ssv", "ParameterValues"), ("ssc", "Common"))}


def read(file):
    """Versions, components, connectors, connections, start values and times of the archive."""
    with zipfile.ZipFile(file) as archive:
        root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
        versions, parts, connectors, values = [root.get("version")], {}, {}, {}
        for part in root.iterfind("ssd:System/ssd:Elements/ssd:Component", SPACES):
            name = part.get("name")
            # equal checksums mean the same FMU
            parts[name] = part.get("type"), part.get("source"), archive.getinfo(part.get("source")).CRC
            for connector in part.iterfind("ssd:Connectors/ssd:Connector", SPACES):
                connectors[name, connector.get("name")] = connector.get("kind"), kind(connector)
            for binding in part.iterfind("ssd:ParameterBindings/ssd:ParameterBinding", SPACES):
                table = ElementTree.fromstring(archive.read(binding.get("source")))
                versions.append(table.get("version"))
                for value in table.iterfind("ssv:Parameters/ssv:Parameter", SPACES):
                    values[name, value.get("name")] = kind(value), value[0].get("value")
        connections = {(line.get("endElement"), line.get("endConnector")): (line.get("startElement"), line.get("startConnector"))
                       for line in root.iterfind("ssd:System/ssd:Connections/ssd:Connection", SPACES)}
        experiment = root.find("ssd:DefaultExperiment", SPACES)
        times = {name: experiment.get(name) for name in ("startTime", "stopTime")}
    return {"versions": set(versions), "components": parts, "connectors": connectors, "connections": connections,
            "start values": values, "times": times}


def kind(element):
    """Type of a connector or of a value: the name of its child element."""
    return element[0].tag.partition("}")[2]


def differences(first, second):
    """Messages about all entries, other than the versions, in which two contents differ."""
    return [f"{what} {key}: {first[what].get(key)} and {second[what].get(key)}"
            for what in first if what != "versions"
            for key in sorted(first[what].keys() | second[what].keys(), key=str)
            if first[what].get(key) != second[what].get(key)]
