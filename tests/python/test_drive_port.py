"""Commands about a differential behind a final drive drive its port: the same results as with a drive at the carrier."""

import numpy as np
import pytest
from bevel_differential import DifferentialError, Scene
from bevel_differential.bench import TESTS, bench, scene_file
from bevel_differential.drive_port import PORT, SPEED, TORQUE, at_port
from bevel_differential.losses.command import _reached
from duty_cycles import HEAD, spectrum_of
from final_drive_scenes import RATIO

# a rigid final drive without inertia and losses changes nothing behind it
NOTHING = {"effects.final_drive": True, "inertia.pinion": 0.0}
ELASTIC = {"effects.final_drive": True, "final_drive.elastic_mesh": True}
LUMPED = {"scene.gear_contact": "lumped"}
# relative to the largest value of an output: steps of the solver differ
SAME = 1e-6
CYCLE = [HEAD, "start,2,4,20,,1500", "corner,1,4,20,20,300"]
# scenes of the bench that command the carrier, and the time by which their tables begin [s]
SCENES = {"bias": 0.1, "ramps": 0.1, "clutch_curve": 0.1, "judder": 0.5, "hot_lap": 18.0, "winter_start": 5.0, "clutch_command": 0.1}


@pytest.fixture
def bench_scene(fmu_file):
    """bench_scene(name): scene of a test of the bench."""
    return lambda name: Scene.load(scene_file(name), fmu=fmu_file)


def test_all_scenes_of_the_bench_are_here():
    assert {scene for _, scene in TESTS.values()} == {*SCENES, "lash"}


@pytest.mark.parametrize("name, stop", SCENES.items())
def test_a_scene_of_the_bench_moves_equally_if_its_port_is_driven(bench_scene, name, stop):
    outputs = ["left.speed", "right.shaft_torque", "carrier.speed", "carrier.torque"]
    plain = bench_scene(name).run(outputs, stop=stop)
    driven = at_port(bench_scene(name).set(NOTHING))
    assert not {*PORT} & {*driven.values, *(table[0] for table in driven.tables)} and not {*PORT} & driven.unfelt_of().keys()
    record = driven.run(outputs, stop=stop)
    for output in outputs:
        assert record[output] == pytest.approx(plain[output], abs=SAME * np.max(np.abs(plain[output]))), output


def test_changes_and_units_of_the_carrier_become_those_of_the_port(fmu_file):
    scene = Scene(set=NOTHING | {TORQUE: "820 N.m", SPEED: (100.0, "rpm")}, changes=[(0.1, {TORQUE: "0.41 kN.m"})],
                  tables=[(SPEED, [0.0, 0.2], ["10 rad/s", 20.0], None)], fmu=fmu_file)
    driven = at_port(scene)
    assert driven.values[PORT[TORQUE]] == pytest.approx(820.0 / RATIO)
    assert driven.changes[0][1] == pytest.approx({PORT[TORQUE]: 410.0 / RATIO})
    assert (name := driven.tables[0][0]) == PORT[SPEED] and driven.tables[0][2] == pytest.approx([10.0 * RATIO, 20.0 * RATIO]), name


@pytest.mark.parametrize("values", [{TORQUE: 500.0}, NOTHING | {PORT[TORQUE]: 300.0, PORT[SPEED]: 200.0, TORQUE: 500.0}, NOTHING])
def test_a_scene_that_commands_its_drive_is_left_alone(fmu_file, values):
    scene = Scene(set=values, fmu=fmu_file)
    assert at_port(scene) is scene


@pytest.mark.parametrize("name", ["judder", "winter_start", "ramps"])
def test_the_bench_draws_the_same_conclusion_at_the_port(fmu_file, tmp_path, name):
    plain, driven = (bench(name, tmp_path, values=values, fmu=fmu_file, workers=0) if name == "ramps" else
                     bench(name, tmp_path, values=values, fmu=fmu_file) for values in ({}, NOTHING))
    assert driven == plain


@pytest.mark.parametrize("values", [NOTHING, ELASTIC])
@pytest.mark.parametrize("drive", ["speed", "torque"])
@pytest.mark.parametrize("lines", [CYCLE, ["name,count,history", "swing,2,history.csv"]])
def test_a_duty_cycle_damages_the_gears_equally_behind_a_final_drive(fmu_file, tmp_path, values, drive, lines):
    (tmp_path / "history.csv").write_text("time [s],speed [km/h],torque [N.m]\n0,20,1200\n0.2,21,1500\n0.4,20,1200\n", encoding="utf-8")
    given = LUMPED | {"scene.carrier_drive": drive}
    plain, driven = (spectrum_of(lines, tmp_path, fmu_file, given | more) for more in ({}, values))
    assert np.max(plain.by_event) > 0.0
    # settling differs with an elastic mesh
    assert driven.by_event == pytest.approx(plain.by_event, rel=SAME if values is NOTHING else 0.02)
    assert driven.km == pytest.approx(plain.km)


def test_distance_follows_from_the_speed_of_the_port(fmu_file, tmp_path):
    lines = ["name,count,duration [s],pinion.speed_command [rad/s],left.load_torque [N.m],right.load_torque [N.m]", "a,1,10,41,300,300"]
    found = spectrum_of(lines, tmp_path, fmu_file, LUMPED | NOTHING)
    assert found.km == pytest.approx(10.0 * 41.0 / RATIO * 0.334 / 1000.0)


@pytest.mark.parametrize("drive, command", [("speed", PORT[SPEED]), ("torque", PORT[TORQUE])])
def test_a_missing_command_is_that_of_the_port(fmu_file, tmp_path, drive, command):
    lines = ["name,count,duration [s],left.load_torque [N.m],right.load_torque [N.m]", "a,1,1,300,300"]
    parameters = LUMPED | ELASTIC | {"scene.carrier_drive": drive, SPEED: 10.0, TORQUE: 100.0}
    with pytest.raises(DifferentialError, match=f"there is no such column; write a value, or set {command} in the scene"):
        spectrum_of(lines, tmp_path, fmu_file, parameters)


def test_a_loss_map_reaches_the_torque_and_the_speed_of_the_scene(fmu_file):
    plain, driven = (_reached(Scene.load("torque_bias", fmu=fmu_file).set(values)) for values in ({}, NOTHING))
    assert driven == pytest.approx(plain, rel=SAME)
