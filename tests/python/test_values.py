"""Values that users write: package, scene files and commands read them equally."""

import math

import numpy as np
import pytest
from command_line import command
from bevel_differential import Differential, DifferentialError, Scene
from bevel_differential.answers import about, ask
from bevel_differential.designs.space import Space
from bevel_differential.points import seconds
from bevel_differential.vehicle import Motor, Tyre
from refusals import refused

# name, value as on a command line, value as in TOML, number of the FMU
GOOD = [
    ("geometry.planet_teeth", "12.0", "12.0", 12),
    ("geometry.planet_teeth", "12", "\"12\"", 12),
    ("effects.half_shaft", "True", "\"True\"", True),
    ("effects.half_shaft", "false", "\"FALSE\"", False),
    ("scene.start", "rolling", "\"rolling\"", 2),
    ("solver.fixed_step", "0.1 ms", "\"0.1 ms\"", 1e-4),
    ("solver.fixed_step", "100 us", "\"100 µs\"", 1e-4),
    ("left.load_torque", "100 lb.ft", "\"100 ft·lbf\"", 135.58179483314004),
    ("left.load_torque", "0.8 kN.m", "\"0.8 kNm\"", 800.0),
    ("half_shaft.left_stiffness", "100 N.m/deg", "\"100 Nm/°\"", 100.0 * 180.0 / math.pi),
    ("geometry.module", "0.2 in", "\"0.2 in\"", 0.00508),
    ("material.young_modulus", "3e7 psi", "\"3e7 psi\"", 3e7 * 6894.757293168361),
    ("carrier.speed_command", "60 RPM", "\"60 RPM\"", 2.0 * math.pi),
    ("oil.temperature", "176 degF", "\"176 °F\"", 353.15),
    ("warm_up.gears_above_oil", "18 degF", "\"18 °F\"", 10.0),
]
# name, value as on a command line, part of the message
WRONG = [
    ("geometry.planet_teeth", "12.5", "must be a whole number"),
    ("geometry.planet_teeth", "ten", "must be a whole number"),
    ("geometry.module", "17,5 mm", "write 17.5 mm"),
    ("geometry.module", "-0,5 mm", "write -0.5 mm"),
    ("geometry.module", "17.5 kg", "units that do: m, mm, um, in, km"),
    ("effects.half_shaft", "yes", "must be true or false"),
    ("scene.start", "roling", "did you mean rolling?"),
    ("contact.law", "lin", "did you mean line?"),
]
FRAME = 'description = "d"\nstop_time = "1 ms"\nstep = "1 ms"\noutputs = ["left.speed"]\n[set]\n'


@pytest.mark.parametrize(("name", "text", "toml", "number"), GOOD)
def test_every_reader_gives_the_same_number(name, text, toml, number, fmu, tmp_path):
    start = fmu.variable("scene.start").literals
    number = start["rolling"] if name == "scene.start" else number
    file = tmp_path / "scene.toml"
    file.write_text(f"{FRAME}{name} = {toml}\n", encoding="utf-8")
    of_package = fmu.variable(name).number(text)
    with Scene.load(file) as scene:
        of_file = scene.values[name]
    set_later = ask({"ask": "scene", "of": about(file, {name: text})})["set"][name]
    of_command = fmu.variable(name).number(set_later)
    assert of_package == of_file == of_command == pytest.approx(number, rel=1e-14)
    assert type(of_package) is type(number)


@pytest.mark.parametrize(("name", "text", "why"), WRONG)
def test_every_reader_refuses_with_the_same_reason(name, text, why, fmu, tmp_path):
    file = tmp_path / "scene.toml"
    file.write_text(f"{FRAME}{name} = \"{text}\"\n", encoding="utf-8")
    plain = tmp_path / "plain.toml"
    plain.write_text(FRAME, encoding="utf-8")
    for call in (lambda: fmu.variable(name).number(text), lambda: Differential({name: text}),
                 lambda: Scene.load(file), lambda: ask({"ask": "plan", "of": about(plain, {name: text})})):
        with pytest.raises(DifferentialError) as error:
            call()
        assert why in str(error.value) and name in str(error.value)


@pytest.mark.parametrize("line", ["plan {}", "loads {} --out l.csv", "geometry --out g", "run {}"])
def test_commands_take_a_whole_number_with_decimals(line, folder):
    (folder / "scene.toml").write_text(f"{FRAME}scene.gear_contact = \"tooth\"\n", encoding="utf-8")
    command(f"{line.format('scene.toml')} --set geometry.planet_teeth=12.0")


def test_numbers_of_literals_and_python_types_are_read(fmu):
    start = fmu.variable("scene.start")
    assert start.number(float(start.literals["rolling"])) == start.literals["rolling"]
    module = fmu.variable("geometry.module")
    assert module.number((4.5, "mm")) == module.number(("4.5", "mm")) == module.number("4500 um") == module.number(np.float64(0.0045)) == 0.0045
    assert [fmu.variable("effects.half_shaft").number(value) for value in np.array([True, False])] == [True, False]
    with refused("geometry.planet_teeth … must be a whole number"):
        fmu.variable("geometry.planet_teeth").number(True)
    for wrong in (True, math.nan, [1.0], ("4.5", "kg"), None):
        with pytest.raises(DifferentialError, match=r"^geometry\.module = "):
            module.number(wrong)


def test_parts_of_a_car_and_times_have_units():
    assert Tyre(radius="372 mm").radius == 0.372 and Motor(lag="30 ms", knee="6000 RPM").lag == 0.03
    assert Motor(peak="200 lb.ft").peak == pytest.approx(271.16358966628008)
    with refused("Tyre.radius = '37,2 cm': \"37,2 cm\" has a decimal comma: write 37.2 cm"):
        Tyre(radius="37,2 cm")
    with refused("Motor.peak = '1,000 N.m': \"1,000 N.m\": is the comma a decimal comma, or does it separate thousands? Write 1.000 N.m or 1000 N.m"):
        Motor(peak="1,000 N.m")
    assert [seconds("t", text) for text in ("2 min", "0.5 h", "3 us", "4", 5.0)] == pytest.approx([120.0, 1800.0, 3e-6, 4.0, 5.0])


def test_a_decimal_comma_in_a_list_is_refused(fmu):
    for text in ("0,5 mm", "0,1 mm, 0,2 mm", "1.5,2 mm"):
        with refused("write decimal points"):
            Space.parse(fmu, {"geometry.module": text})
    assert Space.parse(fmu, {"geometry.module": "4 mm,5 mm"}).dimensions[0].numbers == (0.004, 0.005)


def test_units_of_values_are_also_units_of_tables(fmu):
    shown = fmu.displaying(["lb.ft", "degF"])
    unit, value = shown.variable("left.shaft_torque").shown(135.58179483314004)
    assert (unit, value) == ("lb.ft", pytest.approx(100.0, rel=1e-14))
    assert shown.variable("temperature.oil").shown(353.15) == ("degF", pytest.approx(176.0))
    # differences have no offset, so they keep their unit
    assert shown.variable("temperature.oil").differences().shown(10.0)[0] == "K"
