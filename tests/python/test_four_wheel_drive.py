"""The car with four-wheel drive, three coupled units: against one integration of all equations, in the mirror, on both sides of the
longest stable step that `coupling` states, and as an SSP archive."""

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import DifferentialError, Scene
from bevel_differential.coupling import GAUSS_SEIDEL, JACOBI, coupling, other_unit
from command_line import command
from fmpy.ssp.ssd import read_ssd
from ssp_archives import content, system, written

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
EXAMPLE = EXAMPLES / "four_wheel_drive"
# only while they are imported, because other programs have modules of the same names
FOLDERS = [str(folder) for folder in (EXAMPLE, EXAMPLE / "ssp", EXAMPLES / "drivetrain")]
sys.path[:0] = FOLDERS
import car  # noqa: E402
import car_structure  # noqa: E402
import whole  # noqa: E402
for folder in FOLDERS:
    sys.path.remove(folder)

# the accuracy that is promised: of the results, and of limits
WITHIN, NEAR = 0.01, 0.03
# a short push of the motor, too weak for a tyre to slide
PUSH = ([0.0, 0.01, 0.02], [0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def right(fmu):
    """Values of the car by name, every millisecond, from one integration of all equations."""
    times = np.linspace(0.0, car.STOP, round(1e3 * car.STOP) + 1)
    return dict(zip(car.NAMES, whole.whole(car.FourWheelDrive(fmu=fmu), times, car.MOTOR, car.BODY, car.PEDAL).T))


@pytest.fixture(scope="module")
def deviation(fmu, right):
    """deviation(step, changes): largest difference of any value of the car with `changes`, over the largest magnitude of the value."""
    def found(step, changes=None):
        record = car.FourWheelDrive(changes=changes, fmu=fmu).run(step=step)[::round(1e-3 / step)]
        return max(np.abs(record[name] - values).max() / np.abs(values).max() for name, values in right.items())

    return found


@pytest.fixture(scope="module")
def own(deviation):
    """Deviation of the car itself."""
    return deviation(car.STEP)


def test_three_units_agree_with_one_integration_of_all_equations_and_converge_with_the_square_of_the_step(deviation, own):
    assert own < WITHIN
    assert 3.0 < deviation(2.0 * car.STEP) / own < 5.0


@pytest.mark.parametrize("unit, name, factor", [("centre", "half_shaft.right_stiffness", 0.8), ("rear", "inertia.pinion", 2.0)])
def test_the_comparison_notices_a_value_that_differs(fmu, deviation, own, unit, name, factor):
    value = car.FourWheelDrive(fmu=fmu).scenes[unit].value(name)
    assert deviation(car.STEP, {unit: {name: factor * value}}) > 10.0 * own


def test_the_ice_limits_every_shaft(fmu):
    """Theory: open differentials halve torques. While the left wheels spin, each half-shaft has what ice and spinning wheel resist."""
    row = car.FourWheelDrive(fmu=fmu).run(stop=0.7)[-1]
    for axle, load in car.LOAD.items():
        half_shafts = [row[f"{axle}_{side}.shaft_torque"] for side in car.SIDES]
        assert half_shafts[0] == pytest.approx(half_shafts[1], rel=1e-3)
        ratio = sum(half_shafts) / row[f"{axle}.propeller_torque"]
        # the rest accelerates pinion and carrier
        assert ratio == pytest.approx(4.1, rel=0.02)
        assert half_shafts[0] < 0.15 * load * 0.334 * 1.6
    assert row["front_left.speed"] > row["rear_left.speed"] > 5.0 * row["rear_right.speed"]


def test_the_mirrored_car_moves_the_mirrored_way(fmu):
    half_shafts = {f"half_shaft.{side}_{what}": f"half_shaft.{other}_{what}" for side, other in (("left", "right"), ("right", "left"))
                   for what in ("stiffness", "damping")}
    one = car.FourWheelDrive(fmu=fmu)
    changes = {axle: {name: one.scenes[axle].value(other) for name, other in half_shafts.items()} for axle in car.AXLES}
    mirrored = car.FourWheelDrive({"left": 0.9, "right": 0.15}, changes, fmu).run()
    record = one.run()
    for name in car.NAMES:
        twin = name.replace("left", "LEFT").replace("right", "left").replace("LEFT", "right")
        assert np.allclose(record[name], mirrored[twin], rtol=1e-9, atol=1e-9 * np.abs(record[name]).max()), name
    assert record["front_left.speed"].max() > 5.0 * record["front_right.speed"].max()


def swing(fmu, step):
    """Second differences of the torque of the front propeller shaft after a short push."""
    return np.abs(np.diff(car.FourWheelDrive(fmu=fmu).run(0.3, step, PUSH)["front.propeller_torque"], 2))


def test_up_to_the_longest_stable_step_swings_decay_and_beyond_they_grow_as_predicted(fmu):
    made = car.FourWheelDrive(fmu=fmu).coupling()
    below, above = (swing(fmu, part * made.limit) for part in (0.9, 1.1))
    third = len(below) // 3
    assert below[-third:].max() < 0.1 * below[:third].max()
    count = len(above) // 3
    growth = (above[-count:].max() / above[-2 * count:-count].max()) ** (1.0 / count)
    assert growth > 1.0 and growth == pytest.approx(made.growth(1.1 * made.limit), rel=NEAR)
    # and much closer to the limit
    assert [swing(fmu, part * made.limit)[-third:].max() > below[:third].max() for part in (1.0 - NEAR, 1.0 + NEAR)] == [False, True]


def test_the_command_states_the_limit(fmu):
    # files of axles are next to that of the centre
    hosts = " ".join(f"--host {car.SHAFT[axle]}:{axle}_axle.toml" for axle in car.AXLES)
    said = command(f"coupling '{EXAMPLE}/centre.toml' {hosts} --master gauss-seidel --input lines").out
    limits = car.FourWheelDrive(fmu=fmu).coupling().limits()
    assert "left: the unit of front_axle\nright: the unit of rear_axle\n" in said
    assert f"longest stable step: {1e3 * limits[GAUSS_SEIDEL, 'lines']:.3g} ms (gauss-seidel, inputs on lines)" in said
    assert f"{1e3 * limits[JACOBI, 'held']:.3g} ms" in said


def test_another_unit_needs_a_torque_and_a_port_that_returns_one(fmu):
    axle, centre = (Scene.load(EXAMPLE / f"{name}.toml", fmu) for name in ("front_axle", "centre"))
    with pytest.raises(DifferentialError, match="the drive of the other unit, front_axle, receives a torque; set scene.carrier_drive = torque"):
        other_unit("left", Scene.load(EXAMPLE / "front_axle.toml", fmu).set({"scene.carrier_drive": "speed"}))
    with pytest.raises(DifferentialError, match="left: the scene drives it by torque"):
        coupling(centre.set({"scene.left_drive": "torque"}), [other_unit("left", axle)])


def test_the_script_prints_its_table_and_draws_a_picture(fmu_file, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["launch", str(tmp_path / "picture.png")])
    monkeypatch.syspath_prepend(str(EXAMPLE))
    runpy.run_path(str(EXAMPLE / "launch.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("longest stable step: ")
    names = [line.split()[0] for line in lines if line]
    assert [name for name in names if name in car.NAMES] == car.NAMES
    assert float(lines[-1].split()[-2]) < 100.0 * WITHIN
    assert (tmp_path / "picture.png").stat().st_size > 10_000


@pytest.fixture(scope="module")
def archives(fmu_file, tmp_path_factory):
    """Archives by version, and their structure."""
    made = car_structure.structure(car.FourWheelDrive(fmu=fmu_file))
    return written(tmp_path_factory.mktemp("ssp"), made, fmu_file), made


def test_the_archive_contains_the_three_units_with_the_values_of_their_scenes(archives, fmu):
    files, made = archives
    first, second = (content.read(files[version]) for version in system.VERSIONS)
    assert content.differences(first, second) == []
    units = [found for found in first["components"].values() if found[1] == "resources/BevelDifferential.fmu"]
    assert len(units) == 3 and len(set(units)) == 1
    for unit, scene in car.FourWheelDrive(fmu=fmu).scenes.items():
        part = unit if unit == "centre" else f"{unit}_axle"
        written = {name: value for (owner, name), value in first["start values"].items() if owner == part}
        assert {name: (kind, {"true": 1, "false": 0}.get(value) if kind == "Boolean" else float(value)) for name, (kind, value) in
                written.items()} == {name: (fmu.variables[name].kind.replace("Enumeration", "Integer"), value)
                                     for name, value in scene.values.items()}


def test_the_archive_connects_the_cut_of_the_page(archives):
    found = content.read(archives[0]["1.0"])
    for axle, side in (("front", "left"), ("rear", "right")):
        assert found["connections"]["centre", f"{side}.speed_command"] == (f"{axle}_axle", "propeller.speed")
        assert found["connections"][f"{axle}_axle", "pinion.torque_command"] == ("centre", f"{side}.shaft_torque")
    assert len(found["connections"]) == 2 + 2 * 2 + 4 * 4


def test_connectors_are_variables_of_the_unit_and_fmpy_reads_the_archive(archives, fmu):
    files, made = archives
    found = content.read(files["2.0"])
    units = [part for part, kind in made.parts.items() if kind == "BevelDifferential"]
    connectors = {(part, name): kind for (part, name), (kind, _) in found["connectors"].items() if part in units}
    assert len(connectors) == 3 + 3 + 2 * (3 + 3)
    assert connectors == {(part, name): fmu.variables[name].causality for part, name in connectors}
    # validates by its schema of SSP 1.0
    read = read_ssd(str(files["1.0"]))
    assert [part.name for part in read.system.elements] == list(made.parts)
    assert len(read.system.connections) == len(made.connections)
