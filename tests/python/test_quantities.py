"""Quantities of the parts around the gears in every command, and statistics that cannot be formed."""

import math

import numpy as np
import pytest
from command_line import command
from command_list import SCENE

from bevel_differential import Differential, DifferentialError, Scene
from bevel_differential.accuracy import accuracy
from bevel_differential.comparison import compare
from bevel_differential.designs.sweep import sweep, text
from bevel_differential.optimise.design_task import DesignTask
from bevel_differential.optimise.problem import Problem
from bevel_differential.quantities import QUANTITIES
from bevel_differential.want import Condition
from refusals import refused

BORE = {"geometry.planet_bore": "12 mm"}


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    with Scene.load(tmp_path / "scene.toml") as loaded:
        yield loaded.set(BORE)


def test_a_run_records_quantities_by_their_formulas(scene):
    names = ["geometry.planet_mass", "gears.mass", "geometry.side_mass", "pin.shear", "envelope.diameter"]
    record = scene.run(names)
    assert record.dtype.names == ("time", *names)
    # N m_p + 2 m_s with two planets
    assert np.all(record["gears.mass"] == 2.0 * record["geometry.planet_mass"] + 2.0 * record["geometry.side_mass"])
    forces = scene.run([f"planet[{k}].pin_force" for k in range(1, 5)])
    largest = max(forces[name].max() for name in forces.dtype.names[1:])
    assert record["pin.shear"][-1] == pytest.approx(16.0 * largest / (3.0 * math.pi * 0.012**2), rel=1e-12)
    assert scene.final(names) == {name: record[name][-1] for name in names}
    assert "pin.shear" in scene.summary(record) and "MPa" in scene.summary(record)
    plain = Differential({**scene.values}).run(outputs=["envelope.diameter"], stop=1e-3)
    assert np.all(plain["envelope.diameter"] == record["envelope.diameter"][0])


def test_a_scene_file_names_quantities_among_its_outputs(tmp_path):
    text = SCENE.replace("outputs = [", 'outputs = ["gears.mass", ', 1).replace("stop_time = 0.001", "stop_time = 0.02")
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    with Scene.load(tmp_path / "scene.toml") as scene:
        assert scene.outputs[0] == "gears.mass" and len(scene.outputs) > 1
        record = scene.run()
        assert list(record.dtype.names) == ["time", *scene.outputs] and record["gears.mass"][0] > 0.0
        # the accuracy of outputs is examined, and the quantity is left out by name
        with pytest.warns(match="gears.mass: it is calculated from outputs"):
            answer = accuracy(scene, within="5%")
        assert answer.wants and not any("gears.mass" in want for want in answer.wants)
    with refused("--want pin.shear:max: … name planet[1].pin_force or"):
        accuracy(tmp_path / "scene.toml", "pin.shear:max")


def test_loads_of_quantities_are_the_largest_so_far_since_rating_began():
    """The carrier torque rises, falls, and rises less."""
    course = [("carrier.torque_command", [0.0, 0.01, 0.02, 0.03, 0.04], [0.0, 900.0, 100.0, 600.0, 600.0], None)]
    for sign in (1.0, -1.0):
        tables = [(name, times, [sign * value for value in values], period) for name, times, values, period in course]
        values = {**BORE, "scene.carrier_drive": "torque", "scene.gear_contact": "lumped", "scene.start": "rest", "scene.left_drive": "speed",
                  "scene.right_drive": "speed", "half_shaft.left_damping": 50.0, "half_shaft.right_damping": 50.0,
                  "left.speed_command": 0.0, "right.speed_command": 0.0}
        for since in (0.0, 0.022):
            scene = Scene("pin", stop=0.04, step=1e-3, tables=tables, set={**values, "strength.rate_from": since})
            record = scene.run(["pin.shear", "planet[1].pin_force", "planet[2].pin_force"])
            shear, force = record["pin.shear"], np.maximum(record["planet[1].pin_force"], record["planet[2].pin_force"])
            rated = record["time"] >= since
            expected = np.maximum.accumulate(np.where(rated, force, 0.0)) * 16.0 / (3.0 * math.pi * 0.012**2)
            assert np.allclose(shear, expected, rtol=1e-12, atol=0.0) and np.all(np.diff(shear) >= 0.0) and shear[-1] > 0.0
            # the end value in one long step would miss the largest load
            assert scene.final(["pin.shear"])["pin.shear"] == shear[-1]


@pytest.mark.parametrize("name", sorted(QUANTITIES.keys() - {"gears.mass"}))
def test_sweeps_and_comparisons_have_the_quantities_of_searches(name, scene, tmp_path):
    (tmp_path / "search.toml").write_text(f'description = "d"\nscene = "scene.toml"\nobjectives = ["minimise gears.mass", "minimise {name}"]\n'
                                          '[set]\ngeometry.planet_bore = "12 mm"\n[vary]\ngeometry.module = "4 mm..5 mm"\n', encoding="utf-8")
    row = DesignTask(Problem.load(tmp_path / "search.toml"), thorough=True).evaluate(0, {"geometry.module": 4.25e-3})
    result = sweep(scene, {"geometry.module": "4.25 mm"}, "grid", wants=[name, "gears.mass"], workers=0).table.to_pylist()[0]
    assert result[f"{name}:final"] == pytest.approx(row.figures[f"{name}:final"], rel=1e-9), result["message"]
    assert result["gears.mass:final"] == pytest.approx(row.figures["gears.mass:final"], rel=1e-12)
    assert name in str(compare(scene, scene, outputs=[name], values={"geometry.module": "4.25 mm"}))


def test_suggestions_are_of_the_same_kind(fmu, scene):
    for action in (lambda: sweep(scene, {"left.load_torque": "1, 2"}, "grid", wants=["gear.mass"], workers=0), lambda: scene.run(["gear.mass"]),
                   lambda: Scene("s", outputs=["gear.mass"])):
        with refused("did you mean gears.mass?"):
            action()
    # a parameter of a similar name is not suggested for an output, and no output for a parameter
    with pytest.raises(DifferentialError) as error:
        fmu.output("side_gear_mass")
    assert "inertia.side_gear_mass" not in str(error.value)
    with pytest.raises(DifferentialError) as error:
        fmu.settable("geometry.planet_masses")
    assert "geometry.planet_mass" not in str(error.value).replace("geometry.planet_masses", "")
    with refused("calculated"):
        scene.set({"gears.mass": 1.0})
    with fmu.open() as instance, refused("gears.mass … single calls cannot read it"):
        instance.get("gears.mass")
    assert "gears.mass" in command("run study_turning --stop '2 ms' --output gears.mass").out


def test_conditions_show_the_limit_as_it_was_written(fmu):
    for written, shown in (("pin.shear <= 120 MPa", "pin.shear:final <= 120 MPa"), ("left.speed:max < 30", "left.speed:max < 30 rad/s"),
                           ("efficiency>=0.99", "efficiency:final >= 0.99"), ("left.speed:time_of_peak > 20 ms", "left.speed:time_of_peak > 20 ms")):
        assert str(Condition.parse(fmu, written)) == shown


def test_a_statistic_that_cannot_be_formed_leaves_only_its_own_cell_empty():
    # in 0.05 s, the carrier turns 0.24 times at 30 rad/s and 1.2 times at 150 rad/s
    with Scene("turns", stop=0.05, step=1e-3, set={"scene.gear_contact": "ideal"}) as scene:
        result = sweep(scene, {"carrier.speed_command": "30, 150"}, "grid", wants=["left.speed:mean", "carrier.torque:shaft_order_1"],
                       conditions=["left.speed:mean > 1"], workers=0)
    first, second = result.table.to_pylist()
    assert [row["left.speed:mean"] for row in (first, second)] == pytest.approx([30.0, 150.0])
    assert first["carrier.torque:shaft_order_1"] is None and second["carrier.torque:shaft_order_1"] is not None
    assert "shaft_order_1" in first["message"] and "less than one period" in first["message"] and not second["message"]
    assert first["feasible"] and second["feasible"] and not result.failures()
    assert "failed    0" in text(result) and "empty     1" in text(result)
