"""Runs whose stop time equals their start time: hosts, the package and the commands use them to read the state at the start."""

import numpy as np
import pytest
from command_line import command
from bevel_differential import Differential, Scene
from bevel_differential.designs.sweep import sweep
from bevel_differential.vehicle import Car
from fmi3 import Unit3
from fmpy import simulate_fmu
from refusals import refused

# the study at its start: a wheel's shaft torque equals its load, and without a difference everything turns with the carrier
STARTED = {"left.shaft_torque": 835.0, "right.shaft_torque": 835.0}
OUTPUTS = list(STARTED)
SCENE = """description = "the start"
stop_time = {stop}
step = "1 ms"
outputs = ["left.shaft_torque", "carrier.speed"]
[set]
left.load_torque = 500.0
right.load_torque = 500.0
"""


@pytest.fixture
def scene_file(tmp_path):
    """scene_file(stop): scene file with this stop time."""
    def write(stop):
        file = tmp_path / "start.toml"
        file.write_text(SCENE.format(stop=stop))
        return file

    return write


@pytest.mark.parametrize("time", [0.0, 5.0])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("version", [2, 3])
def test_fmpy_simulates_the_start(fmu_file, fmu3, version, kind, time):
    record = simulate_fmu(str(fmu_file if version == 2 else fmu3), fmi_type=kind, start_time=time, stop_time=time, output_interval=1e-3,
                          output=OUTPUTS)
    assert record.tolist() == [(time, *STARTED.values())]


@pytest.mark.parametrize("options", [{}, {"eventModeUsed": True}, {"eventModeUsed": True, "earlyReturnAllowed": True}])
def test_a_host_of_fmi_3_reads_saves_and_ends(fmu3, options):
    with Unit3(fmu3, **options) as unit, Unit3(fmu3, **options) as longer:
        for each, stop in ((unit, 2.0), (longer, 3.0)):
            each.begin({}, stop, 2.0)
        assert unit.read(["time", *OUTPUTS]) == [2.0, *STARTED.values()]
        with pytest.raises(Exception, match="fmi3DoStep"):
            unit.step(2.0, 1e-3)
        assert "after the stop time 2 s" in unit.messages[-1][1] and "restored" not in unit.messages[-1][1]
        longer.raw.setFMUState(unit.raw.getFMUState())
        assert longer.step(2.0, 1e-3)[3] == pytest.approx(2.001, abs=1e-12)
        unit.raw.terminate()


def test_a_host_of_model_exchange_reads_the_derivatives(fmu3):
    with Unit3(fmu3, "ModelExchange") as unit:
        unit.initialise({}, 1.0, 1.0)
        unit.update()
        unit.raw.enterContinuousTimeMode()
        assert unit.read(["der(carrier.angle)"]) == unit.read(["carrier.speed"])
        unit.raw.terminate()


def test_an_end_before_the_start_is_an_error(fmu3, opened):
    with Unit3(fmu3) as unit:
        with pytest.raises(Exception, match="fmi3EnterInitializationMode"):
            unit.raw.enterInitializationMode(startTime=1.0, stopTime=0.5)
        assert "stop time 0.5 s is before the start time 1 s" in unit.messages[-1][1]
    with refused("stop = -1.0: it is 0 or more"):
        opened.initialise(stop=-1.0)


def test_the_package_records_the_start():
    with Differential() as differential:
        assert differential.final(OUTPUTS, stop=0) == STARTED
        for step in (1e-3, None):
            record = differential.run(outputs=OUTPUTS, stop="0 ms", step=step)
            assert record.tolist() == [(0.0, *STARTED.values())]
        table = ([0.0, 0.0, 1.0], [100.0, 300.0, 400.0])
        assert differential.run({"left.load_torque": table}, ["left.load_torque"], 0.0)["left.load_torque"].tolist() == [300.0]
        with refused("stop = -0.5: it is 0 or more, s"):
            differential.run(stop=-0.5)


def test_a_scene_has_its_start_in_one_line(fmu, scene_file):
    with Scene.load(scene_file(0), fmu=fmu) as scene:
        assert scene.final() == {"left.shaft_torque": 500.0, "carrier.speed": fmu.variable("carrier.speed_command").start}
        assert len(scene.run()) == 1
        _, *lines = scene.summary(scene.run()).splitlines()
        assert lines[0].split() == ["left.shaft_torque", "N.m", *["500"] * 4]
    with Scene.load(scene_file('"0.1 s"'), fmu=fmu) as scene:
        assert np.array_equal(scene.run(stop=0), scene.run(stop="5 ms")[:1])
    with Scene(stop=0.0, fmu=fmu) as scene:
        assert scene.run(OUTPUTS).tolist() == [(0.0, *STARTED.values())]


def test_designs_are_compared_by_their_starts(fmu, scene_file):
    with Scene.load(scene_file(0), fmu=fmu) as scene:
        plan = {"vary": {"carrier.speed_command": "10..60"}, "runs": 3, "workers": 0}
        found = sweep(scene, **plan, wants=["carrier.speed"]).frame()
        assert found["carrier.speed:final"].tolist() == found["carrier.speed_command"].tolist()
        with refused("less than two steps"):
            sweep(scene, **plan, wants=["carrier.speed:mean"])


def test_a_car_has_the_speed_with_which_it_starts():
    car = Car()
    with refused("0 or more"):
        car.run(stop=-1.0)
    record = car.run(["carrier.speed"], stop=0.0, speed=10.0)
    assert record["time"].tolist() == [0.0]
    assert record["carrier.speed"][0] == pytest.approx(10.0 / car.tyres[0].radius, rel=1e-12)


@pytest.mark.parametrize("line, rows", [("run {long} --stop 0", 4), ("run {still}", 4), ("plan {still}", 0), ("loads {still} --out {out}", 0)])
def test_commands_take_a_scene_without_length(scene_file, tmp_path, line, rows):
    file = scene_file(0.1 if "long" in line else 0)
    printed = command(line.format(long=file, still=file, out=tmp_path / "loads.csv")).out
    assert "nan" not in printed.lower() and (not rows or "left.shaft_torque  N.m" in printed and printed.count(" 500") == rows)
