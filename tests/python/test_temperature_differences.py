"""Temperature differences are converted without the offset of degC, and temperatures with it, in all inputs and outputs."""

import zipfile
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import Differential, DifferentialError, Fmu, Scene
from bevel_differential.command import main
from bevel_differential.csv_table import CsvTable
from bevel_differential.designs.space import Dimension
from bevel_differential.tolerance.factor import Reader
from bevel_differential.want import Condition, Want
from fmpy import read_model_description, simulate_fmu
from lxml import etree

NODES = ("gears", "clutch", "washers", "case")
ABOVE = {node: f"warm_up.{node}_above_oil" for node in NODES}
CHANGES = ("warm_up.ambient_change", "warm_up.sump_change")
DIFFERENCES = {*ABOVE.values(), *CHANGES, "temperature.flash"}
OIL = 353.15


@pytest.mark.parametrize("version", ["2", "3"])
def test_the_model_description_declares_temperature_differences(version, fmu_file):
    file = fmu_file if version == "2" else str(Path(fmu_file).with_name("BevelDifferential3.fmu"))
    with zipfile.ZipFile(file) as archive:
        root = etree.fromstring(archive.read("modelDescription.xml"))
    of_kelvin = [each for each in root.iter("Real", "Float64") if each.get("unit") == "K" and each.getparent().tag != "SimpleType"]
    named = {(each.getparent() if version == "2" else each).get("name"): each for each in of_kelvin}
    assert {name for name, each in named.items() if each.get("relativeQuantity") == "true"} == DIFFERENCES
    assert {name for name, each in named.items() if each.get("declaredType") == "TemperatureDifference"} == DIFFERENCES
    assert {"oil.temperature", "temperature.oil", "temperature.contact", "warm_up.ambient_temperature"} <= set(named)
    # by the reader that hosts use
    types = {each.name: each.relativeQuantity for each in read_model_description(file).typeDefinitions}
    assert types.pop("TemperatureDifference") and not any(types.values())


@pytest.mark.parametrize("kelvin", [20.0, -20.0])
@pytest.mark.parametrize("node", NODES)
def test_the_package_and_fmpy_start_a_node_above_the_oil(node, kelvin, fmu_file):
    outputs = [f"temperature.{node}"]
    for written in (kelvin, f"{kelvin} K", f"{kelvin} degC", (kelvin, "degC"), (kelvin, "K")):
        with Differential({"effects.warm_up": True, ABOVE[node]: written}, fmu=fmu_file) as driven:
            assert driven.final(outputs, stop=1e-6)[outputs[0]] == pytest.approx(OIL + kelvin, abs=1e-3), written
    for written in (kelvin, (kelvin, "degC")):
        found = simulate_fmu(fmu_file, start_values={"effects.warm_up": True, ABOVE[node]: written}, output=outputs, stop_time=1e-3,
                             output_interval=1e-3)
        assert found[outputs[0]][0] == pytest.approx(OIL + kelvin, abs=1e-6), written


def test_temperature_differences_are_shown_as_they_are_read(fmu_file):
    variables = Fmu.of(fmu_file).variables
    for name in DIFFERENCES:
        assert variables[name].shown(20.0) == ("K", 20.0)
        assert variables[name].number("20 degC") == variables[name].number((20, "degC")) == 20.0
    oil = variables["oil.temperature"]
    assert oil.shown(OIL) == ("degC", 80.0) and oil.number("80 degC") == OIL
    assert oil.differences().shown(5.0) == ("K", 5.0) and oil.differences().number("5 degC") == 5.0
    assert oil.shown(OIL) == ("degC", 80.0), "the variable itself has changed"


def test_a_difference_out_of_range_is_reported_in_kelvin(fmu_file):
    with pytest.raises(DifferentialError, match=r"500 degC is outside \[-400, 400\] K"):
        Differential({"warm_up.gears_above_oil": "500 degC"}, fmu=fmu_file)


SCENE = """description = "a case that the air around it cools"
stop_time = 1.0
step = 0.5
outputs = ["temperature.case", "warm_up.given_off"]
[set]
scene.gear_contact = "ideal"
effects.warm_up = true
warm_up.ambient_temperature = "80 degC"
carrier.speed_command = 0
left.load_torque = 0
right.load_torque = 0
"""
WAYS = {
    "csv": ("[[inputs]]\nfile = 'air.csv'\n", "time [s],warm_up.ambient_change [degC]\n0,{0}\n1,{0}\n"),
    "table": ("[[table]]\ninput = 'warm_up.ambient_change'\ntime = [0.0, 1.0]\nvalue = ['{0} degC', '{0} degC']\n", ""),
    "at": ("[[at]]\ntime = 0.0\nwarm_up.ambient_change = '{0} degC'\n", ""),
    "set": ("warm_up.ambient_change = '{0} degC'\n", ""),
}


@pytest.mark.parametrize("kelvin", [10, -10])
@pytest.mark.parametrize("way", WAYS)
def test_a_scene_gives_off_heat_by_the_change_of_the_air(way, kelvin, tmp_path, fmu_file):
    rest, csv = WAYS[way]
    (tmp_path / "air.csv").write_text(csv.format(kelvin), encoding="utf-8")
    (tmp_path / "air.toml").write_text(SCENE + rest.format(kelvin), encoding="utf-8")
    with Scene.load(tmp_path / "air.toml", fmu=fmu_file) as scene:
        given_off = scene.final()["warm_up.given_off"]
        conductance = scene.value("warm_up.case_to_ambient")
    # everything starts at 80 °C and cools only a little in a second
    assert given_off == pytest.approx(-conductance * kelvin, rel=1e-2)


def test_the_command_sets_and_shows_temperature_differences(tmp_path, capsys, fmu_file):
    (tmp_path / "air.toml").write_text(SCENE.replace('"temperature.case"', '"temperature.gears"'), encoding="utf-8")
    assert main(["run", str(tmp_path / "air.toml"), "--fmu", fmu_file, "--set", "warm_up.gears_above_oil=20 degC"]) == 0
    line = next(line.split() for line in capsys.readouterr().out.splitlines() if line.startswith("temperature.gears"))
    assert line[1] == "degC" and float(line[4]) == pytest.approx(100.0, abs=0.1)
    assert main(["plan", str(tmp_path / "air.toml"), "--set", "warm_up.ambient_change=-10 degC"]) == 0


def test_a_column_of_a_package_file_is_converted_by_its_variable(tmp_path, fmu_file):
    file = tmp_path / "steps.csv"
    file.write_text("warm_up.gears_above_oil [degC],oil.temperature [degC]\n5,80\n", encoding="utf-8")
    (_, row), = CsvTable(file, Fmu.of(fmu_file).variable).rows
    assert row == {"warm_up.gears_above_oil": 5.0, "oil.temperature": OIL}


@pytest.mark.parametrize("text", ["normal(80 degC, 5 degC)", "normal(80 degC, 5 K)", "normal(353.15, 5)"])
def test_the_spread_of_a_distribution_is_a_difference(text, fmu_file):
    dimension = Dimension.parse(Fmu.of(fmu_file), "oil.temperature", text)
    assert dimension.numbers == (OIL, 5.0)
    # 84.13 % of a normal distribution are below one standard deviation
    low, high = dimension.at(np.array([0.158655253931457, 0.841344746068543]))
    assert (low, high) == pytest.approx((OIL - 5.0, OIL + 5.0), abs=1e-9)


def test_ends_of_ranges_are_temperatures(fmu_file):
    fmu = Fmu.of(fmu_file)
    for text in ("uniform(75 degC, 85 degC)", "75 degC..85 degC"):
        assert Dimension.parse(fmu, "oil.temperature", text).numbers == (OIL - 5.0, OIL + 5.0)
    assert Dimension.parse(fmu, "oil.temperature", "triangular(75 degC, 80 degC, 85 degC)").numbers == (OIL - 5.0, OIL, OIL + 5.0)


def test_a_band_of_a_tolerance_is_a_difference(fmu_file):
    with Scene.load("study_straight", fmu=fmu_file) as scene:
        for text in ("80 degC +- 6 degC", "80 degC ± 6 K"):
            law = Reader(scene).read("oil.temperature", text).law
            # the band is ± 3 standard deviations
            assert law.dimension.numbers == (OIL, 2.0)


@pytest.mark.parametrize("text, limit, shown", [
    ("temperature.oil:peak_to_peak <= 5 degC", 5.0, ("K", 5.0)),
    ("temperature.oil:peak_to_peak <= 5 K", 5.0, ("K", 5.0)),
    ("temperature.gears:mesh_order_1 < 2 degC", 2.0, ("K", 2.0)),
    ("temperature.flash:max < 40 degC", 40.0, ("K", 40.0)),
    ("temperature.oil:max < 85 degC", OIL + 5.0, ("degC", 85.0)),
    ("temperature.oil <= 85 degC", OIL + 5.0, ("degC", 85.0)),
    ("temperature.oil:time_of_peak <= 5 ms", 5e-3, ("s", 5e-3)),
    ("left.speed:peak_to_peak < 3 rpm", np.pi / 10.0, ("deg/s", 18.0)),
])
def test_limits_of_swings_are_differences(text, limit, shown, fmu_file):
    fmu = Fmu.of(fmu_file)
    condition = Condition.parse(fmu, text)
    assert condition.limit == pytest.approx(limit, rel=1e-14)
    unit, value = condition.want.quantity(fmu).shown(condition.limit)
    assert (unit, value) == (shown[0], pytest.approx(shown[1], rel=1e-12))
    assert not condition.holds(10.0 * limit)


def test_the_unit_of_a_figure_is_in_si(fmu_file):
    fmu = Fmu.of(fmu_file)
    assert [Want.parse(fmu, text).unit(fmu) for text in ("temperature.oil:peak_to_peak", "left.speed:time_of_peak", "efficiency")] == \
        ["K", "s", "1"]
