"""Lash at the port by source, natural frequencies against closed forms, and reports of scenes with a final drive."""

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.bench.lash import play_of
from bevel_differential.coupling.vibration import vibrations
from bevel_differential.lash import lash_by_source
from bevel_differential.report import axle
from bevel_differential.report.runup import theory
from bevel_differential.report.simulated import Simulated
from bevel_differential.report.waterfall import _labels
from bevel_differential.report.write import write
from final_drive_scenes import DRIVEN, ELASTIC, RATIO, loads, turning_inertia
from report_page import ReportPage

# relative error of a natural frequency or damping ratio, and error of a lash [deg]
SAME, LASH = 1e-6, 1e-4
# of the final drive [N/m, N·s/m, m] and of the propeller shaft [N·m/rad, N·m·s/rad]; inertias [kg·m²]
MESH, MESH_DAMPING, RADIUS = 3e8, 3e3, 0.09
SHAFT, SHAFT_DAMPING = 2e4, 2.0
PINION, END, WHEEL = 0.004, 0.012, 0.7
VALUES = {"inertia.pinion": PINION, "inertia.propeller_end": END} | loads(1200.0)
WITH_SHAFT = {"effects.propeller_shaft": True}
IDEAL, LUMPED = {"scene.gear_contact": "ideal"}, {"scene.gear_contact": "lumped"}
UNDAMPED = {"final_drive.damping": 0.0, "propeller_shaft.damping": 0.0}
TURN = 2.0 * np.pi


@pytest.fixture
def scene(fmu_file):
    """scene(values): scene with these values."""
    return lambda values: Scene("axle", stop="20 ms", step="1 ms", outputs=["propeller.torque"], set=VALUES | values, fmu=fmu_file)


def unsimulated(scene):
    """Scene of a report without its record."""
    return Simulated(scene, None, 0.0, "", [], (), {}, 0.0, None)


def rows_of(block):
    return {row[0]: row[1:] for row in block.rows}


@pytest.mark.parametrize("contact", ["lumped", "tooth"])
@pytest.mark.parametrize("values, port", [({}, "pinion"), (WITH_SHAFT, "propeller shaft")])
def test_the_start_values_have_the_lash_of_a_hand_calculation(scene, contact, values, port):
    block = axle.lash(unsimulated(scene(ELASTIC | values | {"scene.gear_contact": contact})))
    assert list(block.head[3:]) == ["at the carrier, °", f"at the {port}, °"]
    rows = rows_of(block)
    assert list(rows) == ["final drive", "gears of the differential", "total"]
    assert [float(row[-1]) for row in rows.values()] == pytest.approx([0.3132, 0.6525, 0.96575], abs=LASH)
    assert float(rows["total"][-2]) == pytest.approx(0.96575 / RATIO, abs=LASH)


def test_without_a_final_drive_the_lash_is_at_the_carrier(scene):
    block = axle.lash(unsimulated(scene({})))
    assert [float(cell) for cell in rows_of(block)["gears of the differential"]] == pytest.approx([0.1, 36.0, 0.6525 / RATIO], abs=LASH)
    assert block.head[-1] == "at the carrier, °" and "final drive" not in rows_of(block)


@pytest.mark.parametrize("values", [IDEAL, {"effects.backlash": False}, IDEAL | {"effects.final_drive": True}])
def test_a_scene_without_lash_says_so(scene, values):
    block = axle.lash(unsimulated(scene(values)))
    assert block.text.startswith("There is no lash between the ") and block.text.endswith(" and the wheels.")


@pytest.mark.parametrize("values", [ELASTIC, ELASTIC | {"geometry.backlash": "0.17 mm", "geometry.side_teeth": 18,
                                                        "geometry.module": "5 mm"},
                                    {"effects.final_drive": True, "geometry.planet_count": 4},
                                    ELASTIC | {"final_drive.backlash": "0.21 mm", "effects.backlash": False}])
def test_the_lash_is_that_of_the_simulated_play(scene, values):
    """The play is extrapolated from equilibria of the FMU, which share no formula with the table."""
    driven = scene(LUMPED | values)
    assert sum(source.angle for source in lash_by_source(driven.value, has_teeth=True)) == pytest.approx(play_of(driven), rel=1e-4)


def test_a_propeller_shaft_swings_between_its_end_and_all_that_is_behind(fmu, scene):
    behind = turning_inertia(fmu) / RATIO**2 + PINION
    reduced = END * behind / (END + behind)
    (one,) = vibrations(scene(IDEAL | DRIVEN | WITH_SHAFT | {"pinion.torque_command": 1200.0 / RATIO})).found
    assert TURN * one.frequency == pytest.approx(np.sqrt(SHAFT / reduced), rel=SAME)
    assert one.damping == pytest.approx(0.5 * SHAFT_DAMPING / np.sqrt(SHAFT * reduced), rel=SAME)
    assert one.shape["propeller shaft"] / one.shape["carrier"] == pytest.approx(-behind / END, rel=SAME)
    assert one.shape["left side gear"] == pytest.approx(one.shape["carrier"], rel=SAME)


def test_an_elastic_mesh_swings_against_an_imposed_pinion(fmu, scene):
    inertia, stiffness = turning_inertia(fmu), MESH * RADIUS**2
    (one,) = vibrations(scene(IDEAL | ELASTIC)).found
    assert TURN * one.frequency == pytest.approx(np.sqrt(stiffness / inertia), rel=SAME)
    assert one.damping == pytest.approx(0.5 * MESH_DAMPING * RADIUS**2 / np.sqrt(stiffness * inertia), rel=SAME)
    assert next(iter(one.shape)) in ("left side gear", "carrier")


@pytest.mark.parametrize("drive", ["speed", "torque"])
def test_mesh_and_shaft_have_the_frequencies_of_a_chain(fmu, scene, drive):
    """Driven end, pinion and carrier, referred to the carrier; an imposed speed holds the driven end."""
    end, pinion, carrier = RATIO**2 * END, RATIO**2 * PINION, turning_inertia(fmu)
    shaft, mesh = RATIO**2 * SHAFT, MESH * RADIUS**2
    stiffness = np.array([[shaft, -shaft, 0.0], [-shaft, shaft + mesh, -mesh], [0.0, -mesh, mesh]])
    free = slice(1, 3) if drive == "speed" else slice(0, 3)
    squares = np.linalg.eigvals((stiffness / np.array([end, pinion, carrier])[:, None])[free, free])
    expected = np.sqrt(np.sort(squares)[-2:]) / TURN
    found = vibrations(scene(IDEAL | ELASTIC | WITH_SHAFT | UNDAMPED | {"scene.carrier_drive": drive,
                                                                        "pinion.torque_command": 1200.0 / RATIO})).found
    assert [one.frequency for one in found] == pytest.approx(expected, rel=SAME)
    assert [one.damping for one in found] == [0.0, 0.0]


@pytest.mark.parametrize("final_drive", [{}, {"effects.final_drive": True}])
def test_wheels_that_swing_together_leave_an_imposed_carrier_alone(scene, final_drive):
    stiffness, damping = 9e3, 4.0
    shafts = {f"{name}": value for side in ("left", "right") for name, value in
              ((f"inertia.{side}_end", WHEEL), (f"half_shaft.{side}_stiffness", stiffness), (f"half_shaft.{side}_damping", damping))}
    found = vibrations(scene(IDEAL | final_drive | shafts | {"effects.half_shaft": True})).found
    (together,) = (one for one in found if one.shape["left wheel end"] * one.shape["right wheel end"] > 0.9)
    assert TURN * together.frequency == pytest.approx(np.sqrt(stiffness / WHEEL), rel=SAME)
    assert together.damping == pytest.approx(0.5 * damping / np.sqrt(stiffness * WHEEL), rel=SAME)
    assert abs(together.shape["left side gear"]) < SAME


@pytest.mark.parametrize("values, texts", [
    (IDEAL, ["no elastic part is between bodies that are free to turn."]),
    (IDEAL | {"effects.final_drive": True}, ["no elastic part is between bodies that are free to turn."]),
    (LUMPED | ELASTIC | loads(0.0), ["no elastic part", "teeth of the differential and final drive have no stiffness here"]),
])
def test_a_rigid_scene_says_that_nothing_vibrates(scene, values, texts):
    blocks = axle.natural_frequencies(unsimulated(scene(values)))
    assert blocks[0].text.startswith("Nothing vibrates at the start of the scene: ")
    assert len(blocks) == len(texts) and all(text in block.text for block, text in zip(blocks, texts))


def test_bodies_are_named_with_those_that_are_rigid_with_them(scene):
    table, = axle.natural_frequencies(unsimulated(scene(IDEAL | DRIVEN | WITH_SHAFT | {
        "pinion.torque_command": 1200.0 / RATIO, "inertia.left_end": 0.01, "inertia.right_end": 0.01})))
    (bodies, frequency, _), = table.rows
    assert bodies.startswith("left side gear with wheel 1, right side gear with wheel 1, carrier with pinion 1, propeller shaft −")
    assert float(frequency) > 100.0 and "divided by the ratio 4.1" in table.caption


@pytest.mark.parametrize("contact", ["ideal", "lumped", "tooth"])
@pytest.mark.parametrize("elastic, shaft", [(False, False), (True, True)])
def test_a_report_of_a_driven_pinion_has_its_lash_and_its_frequencies(scene, tmp_path, contact, elastic, shaft):
    driven = scene({"scene.gear_contact": contact, "contact.law": "line", "effects.final_drive": True, "final_drive.elastic_mesh": elastic,
                    "effects.propeller_shaft": shaft, "propeller_shaft.joint_angle": "8 deg" if shaft else 0.0,
                    "pinion.speed_command": 170.0})
    text = write(driven, tmp_path / "page.html", quick=True).read_text(encoding="utf-8")
    section = ReportPage(text).sections["axle"]
    assert ("lash, mm" in section) == (contact != "ideal" or elastic)
    assert ("natural frequency, Hz" in section) == (contact != "ideal" or shaft)
    assert ("0.3132" in section) == elastic


def test_orders_of_the_final_drive_have_names(scene):
    run = unsimulated(scene(ELASTIC | WITH_SHAFT | {"final_drive.ring_runout": "10 um", "final_drive.pinion_runout": "10 um",
                                                    "propeller_shaft.joint_angle": "8 deg"}))
    own = {name: order for name, order in theory(run, -0.2).items() if not name.startswith("mesh")}
    assert own == pytest.approx({"ring gear 41 per carrier turn": 205.0, "pinion 4.1 per carrier turn": 20.5,
                                 "runout 1 per carrier turn": 5.0, "joint 8.2 per carrier turn": 41.0})
    run.scene.set({"final_drive.elastic_mesh": False})
    assert [name for name in theory(run, 0.2) if not name.startswith("mesh")] == ["joint 8.2 per carrier turn"]


def test_labels_of_orders_do_not_overlap():
    expected = {f"mesh {k} × 10": 10.0 * k for k in range(1, 7)} | {"ring gear 41 per carrier turn": 205.0, "joint 8.2 per carrier turn": 41.0}
    assert _labels(expected, 10.0, 12.0) == ["1 × 10", "", "", "", "", "6 × 10", "ring", "joint"]
    assert "" not in _labels(expected, 10.0, 0.5)
