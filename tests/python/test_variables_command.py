"""The command `variables` and `Fmu.find`: all variables, by words and by their effect in a scene."""

import csv

import pytest
from bevel_differential import DifferentialError
from command_line import command
from refusals import refused

@pytest.fixture
def listed(monkeypatch):
    """listed(arguments): the lines that the command prints."""
    monkeypatch.delenv("COLUMNS", raising=False)
    return lambda arguments="": command(f"variables {arguments}").out.splitlines()


def test_without_words_all_variables_are_listed(listed, fmu):
    head, *lines, count = listed()
    assert head.split() == ["name", "kind", "unit", "start", "range", "description"]
    assert [line.split()[0] for line in lines] == list(fmu.variables)
    assert count == f"{len(fmu.variables)} of {len(fmu.variables)} variables"
    # columns start at the same place in all lines
    place = head.index("description")
    assert all(line[place - 1] == " " and line[place] != " " for line in lines)


def test_words_must_all_occur_in_name_or_description(listed, fmu):
    _, line, count = listed("PLANETS Equally")
    number, all_of_them = fmu.variable("geometry.planet_count"), len(fmu.variables)
    assert line.split()[:4] == ["geometry.planet_count", "parameter", str(number.start), f"{number.minimum}..{number.maximum}"]
    assert line.endswith(number.description) and count == f"1 of {all_of_them} variables"
    # a word that occurs only in descriptions
    expected = [name for name, each in fmu.variables.items() if "hertz" in f"{name} {each.description}".lower()]
    assert [line.split()[0] for line in listed("hertz")[1:-1]] == expected and len(expected) > 1
    assert listed("no such quantity")[-1].startswith(f"0 of {all_of_them} variables")


def test_values_are_in_units_that_can_be_read(listed):
    assert listed("geometry.module")[1].split()[1:6] == ["parameter", "mm", "(m)", "4.5", "0.2..100"]
    assert listed("lock.command")[1].split()[1] == "input" and listed("power.loss")[1].split()[1] == "output"
    line = listed("scene.start")[1]
    assert "one of equilibrium, rolling, rest" in line and line.split()[1:3] == ["parameter", "equilibrium"]
    assert any(line.split()[1] == "tunable" for line in listed()[1:-1])


@pytest.mark.parametrize("width", [60, 80, 120, 200])
def test_the_table_fits_the_terminal(listed, monkeypatch, width):
    whole = listed()
    monkeypatch.setenv("COLUMNS", str(width))
    lines = listed()
    assert all(len(line) <= width for line in lines)
    # nothing is lost
    assert sorted(" ".join(lines).replace(";", "").split()) == sorted(" ".join(whole).replace(";", "").split())


def test_the_file_has_si_values_that_read_back(listed, fmu, tmp_path):
    file = tmp_path / "variables.csv"
    assert listed(f"geometry --csv {file}")[-1] == f"written: {file}"
    rows = list(csv.DictReader(file.read_text(encoding="utf-8").splitlines()))
    assert len(rows) > 20
    for row in rows:
        of = fmu.variable(row["name"])
        assert (row["unit"], row["description"]) == (of.unit or "", of.description)
        if of.kind == "Real":
            ends = [float(row[key]) if row[key] else None for key in ("start", "min", "max")]
            assert ends == [of.start, of.minimum, of.maximum]
    assert {row["name"]: row["display unit"] for row in rows}["geometry.module"] == "mm"


def test_variables_that_act_in_a_scene_are_those_of_the_fmu(listed, fmu, scene_file):
    """The command omits the values for which the FMU warns that they change nothing."""
    scene = scene_file({"effects.bearing_drag": True, "scene.gear_contact": "lumped"})
    names = {line.split()[0] for line in listed(f"--acting {scene}")[1:-1]}
    assert {"bearing_drag.carrier_torque", "scene.gear_contact", "left.speed", "heat.drag", "heat.clutch"} <= names
    # clutch packs are off, but the lock heats the same output
    assert not names & {"heat.tooth_friction", "damage.planet", "limited_slip.preload", "tooth_friction.coefficient", "solid.facets"}
    assert [each.name for each in fmu.find("drag", acting=str(scene))] == [line.split()[0] for line in listed(f"drag --acting {scene}")[1:-1]]
    silent, wrong = 0, []
    for each in fmu.variables.values():
        if each.causality == "parameter" and each.kind == "Real" and each.name.partition(".")[0] in ("limited_slip", "bearing_drag"):
            with fmu.open() as instance:
                other = each.start * 1.01 if each.start else 0.5 * (each.maximum or 1.0)
                try:
                    instance.initialise({"effects.bearing_drag": True, "scene.gear_contact": "lumped", each.name: other})
                except DifferentialError:
                    continue
                if (each.name in instance.unfelt) == (each.name in names):
                    wrong.append(each.name)
                silent += each.name in instance.unfelt
    assert not wrong and silent > 10


# suggestions

def test_wrong_names_of_all_kinds_get_suggestions(fmu):
    for call, said in [
        (lambda: fmu.variable("planet.count"), "(did you mean geometry.planet_count?)"),
        (lambda: fmu.variable("carier.speed"), "(did you mean carrier.speed?)"),
        (lambda: fmu.variable("wheel.speed"), "(did you mean left.wheel_speed or right.wheel_speed?)"),
        (lambda: fmu.variable("axle.torque"), "; `bevel-differential variables torque` lists those that may be meant"),
        (lambda: fmu.variable("xyzzy"), "; `bevel-differential variables` lists all variables"),
        (lambda: fmu.variable("effects.half_shaft").number("ture"), "must be true or false"),
        (lambda: fmu.variable("scene.start").number("roling"), "did you mean rolling?"),
        (lambda: fmu.variable("contact.law").number("webber_line"), "did you mean line_weber?"),
    ]:
        with refused(said):
            call()


def test_each_word_of_the_hint_finds_something(fmu):
    for name in ("axle.torque", "gear.ratio_of_axle", "stiffness", "clutch.torque", "force.axial"):
        with pytest.raises(DifferentialError) as error:
            fmu.variable(name)
        command = str(error.value).partition("`bevel-differential variables")[2].partition("`")[0]
        if command:
            assert fmu.find(*command.split()), name
