"""Terminals of the packaged FMU: valid by the standard's schema, with existing variables that fit the drive."""

import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

FILE = "terminalsAndIcons/terminalsAndIcons.xml"
SHAFTS = ("carrier", "left", "right")
# causality of the members of a shaft's terminals
DRIVEN = {"torque_driven": {"tau": "input", "w": "output", "phi": "output"}, "speed_driven": {"tau": "output", "w": "input"}}


@pytest.fixture(scope="module")
def document(fmu_file):
    with zipfile.ZipFile(fmu_file) as archive:
        return etree.fromstring(archive.read(FILE))


@pytest.fixture(scope="module")
def terminals(document):
    """Members of each terminal by name: {terminal: {member: (variable, kind)}}."""
    return {terminal.get("name"): {member.get("memberName"): (member.get("variableName"), member.get("variableKind")) for member in terminal}
            for terminal in document.iter("Terminal")}


def test_the_file_is_valid_by_the_standard_s_schema(document):
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd")))
    schema.assertValid(document)
    changed = etree.fromstring(etree.tostring(document))
    changed.set("fmiVersion", "2.0")
    assert not schema.validate(changed)


def test_names_and_descriptions_are_complete(document, terminals):
    assert len(terminals) == len(list(document.iter("Terminal")))
    assert all(terminal.get("description") and terminal.get("matchingRule") == "plug" for terminal in document.iter("Terminal"))
    # two members with the same name would be a single connection
    assert all(len(terminals[terminal.get("name")]) == len(terminal) for terminal in document.iter("Terminal"))


@pytest.mark.parametrize("shaft", SHAFTS)
@pytest.mark.parametrize("drive", DRIVEN)
def test_a_shaft_has_the_inputs_of_its_drive(terminals, fmu, shaft, drive):
    members = terminals[f"{shaft}_{drive}"]
    assert {name: fmu.variable(variable).causality for name, (variable, _) in members.items()} == DRIVEN[drive]
    assert {name: fmu.variable(variable).unit for name, (variable, _) in members.items()} == {
        name: unit for name, unit in (("tau", "N.m"), ("w", "rad/s"), ("phi", "rad")) if name in members}
    # power enters at the carrier and leaves at the sides
    assert members["tau"][1] == ("inflow" if shaft == "carrier" else "outflow")
    assert {kind for name, (_, kind) in members.items() if name != "tau"} == {"signal"}


def test_every_input_is_in_one_terminal_and_nothing_is_calculated_by_the_host(terminals, fmu):
    members = [variable for terminal in terminals.values() for variable, _ in terminal.values()]
    causalities = {variable: fmu.variable(variable).causality for variable in members}
    assert set(causalities.values()) == {"input", "output"}
    inputs = [variable.name for variable in fmu.variables.values() if variable.causality == "input"]
    assert sorted(variable for variable in members if causalities[variable] == "input") == sorted(inputs)


@pytest.mark.parametrize("drive, causes", [("torque_driven", "torque"), ("speed_driven", "speed")])
def test_signs_are_those_of_the_descriptions(terminals, run, drive, causes):
    """In both drives of the carrier, the power that flows into the carrier flows out of the sides."""
    carrier = terminals[f"carrier_{drive}"]
    sides = [terminals[f"{side}_torque_driven"] for side in ("left", "right")]
    values = {"scene.carrier_drive": causes, "left.load_torque": 800.0, "right.load_torque": 800.0, "carrier.torque_command": 1600.0,
              "scene.gear_contact": "ideal"}
    record = run(values, stop=0.05)[-1]

    def member(terminal, name):
        variable = terminal[name][0]
        return values.get(variable, record[variable] if variable in record.dtype.names else record["carrier.speed"])

    into = member(carrier, "tau") * member(carrier, "w")
    out = sum(member(side, "tau") * member(side, "w") for side in sides)
    assert into > 0.0 and into == pytest.approx(out, rel=1e-9)
