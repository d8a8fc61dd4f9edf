"""SSP archives of the drivetrain example: those of SSP 1.0 and 2.0 describe the same system, which exists in the FMU."""

import zipfile

import pytest
from fmpy.ssp.ssd import read_ssd
from ssp_archives import content, parameters, system, written

VALUES, DESCRIPTION = "resources/left_wheel.ssv", "SystemStructure.ssd"


@pytest.fixture(scope="module")
def archives(fmu_file, tmp_path_factory):
    """archives[contact, version]: an archive with the FMU under test."""
    return {(contact, version): file for contact in parameters.CONTACT for version, file in
            written(tmp_path_factory.mktemp(contact), parameters.structure(contact), fmu_file).items()}


@pytest.mark.parametrize("contact", parameters.CONTACT)
def test_archives_of_both_versions_describe_the_same_system(archives, contact):
    first, second = (content.read(archives[contact, version]) for version in system.VERSIONS)
    assert (first["versions"], second["versions"]) == ({"1.0"}, {"2.0"})
    assert content.differences(first, second) == []


@pytest.mark.parametrize("contact", parameters.CONTACT)
@pytest.mark.parametrize("version", system.VERSIONS)
def test_archives_contain_the_parts_connections_and_start_values_of_the_example(archives, contact, version):
    found = content.read(archives[contact, version])
    assert {part: source for part, (_, source, _) in found["components"].items()} == \
        {part: f"resources/{name}.fmu" for part, name in parameters.PARTS.items()}
    assert found["connections"] == parameters.CONNECTIONS
    assert {key: float(value) for key, (_, value) in found["start values"].items()} == parameters.settings(contact)
    ends = dict.fromkeys(parameters.CONNECTIONS, ("input", "Real")) | \
        dict.fromkeys(parameters.CONNECTIONS.values(), ("output", "Real"))
    assert found["connectors"] == ends
    assert float(found["times"]["stopTime"]) == parameters.END


def test_connectors_and_start_values_are_variables_of_the_unit(archives, fmu):
    found = content.read(archives["tooth", "2.0"])
    connectors = {name: kind for (part, name), (kind, _) in found["connectors"].items() if part == "differential"}
    assert connectors == {name: fmu.variables[name].causality for name in connectors}
    names = {name for part, name in found["start values"] if part == "differential"}
    assert names and all(fmu.variables[name].causality in ("input", "parameter") for name in names)


def test_fmpy_reads_the_archive_of_ssp_1_0(archives):
    # validates by its schema of SSP 1.0
    read = read_ssd(str(archives["tooth", "1.0"]))
    assert [part.name for part in read.system.elements] == list(parameters.PARTS)
    assert len(read.system.connections) == len(parameters.CONNECTIONS)


@pytest.mark.parametrize("name, before, after, place", [
    (DESCRIPTION, '<ssd:Component name="engine"', '<ssd:Component name="motor"', "components"),
    (DESCRIPTION, "resources/Vehicle.fmu", "resources/Engine.fmu", "components"),
    (DESCRIPTION, 'name="torque" kind="output"', 'name="torque" kind="parameter"', "connectors"),
    (DESCRIPTION, "<ssc:Real/>", "<ssc:Float64/>", "connectors"),
    (DESCRIPTION, 'endConnector="left_force"', 'endConnector="lift"', "connections"),
    (DESCRIPTION, 'source="resources/left_wheel.ssv"', 'source="resources/right_wheel.ssv"', "start values"),
    (DESCRIPTION, 'stopTime="0.6"', 'stopTime="0.7"', "times"),
    (VALUES, 'value="0.15"', 'value="0.16"', "start values"),
    (VALUES, "<ssv:Real", "<ssv:Float64", "start values"),
    (VALUES, 'name="friction"', 'name="fraction"', "start values"),
])
def test_the_comparison_finds_a_change_of_any_kind(archives, tmp_path, name, before, after, place):
    file, changed = archives["ideal", "2.0"], tmp_path / "changed.ssp"
    with zipfile.ZipFile(file) as archive, zipfile.ZipFile(changed, "w") as target:
        for each in archive.namelist():
            text = archive.read(each)
            if each == name:
                assert before.encode() in text
                text = text.replace(before.encode(), after.encode(), 1)
            target.writestr(each, text)
    found = content.differences(content.read(file), content.read(changed))
    assert found and any(each.startswith(place) for each in found)
