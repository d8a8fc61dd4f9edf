"""Clutch packs from their drawing and from a bias ratio: numbers calculated by hand, limits, refusals, and torques of the FMU."""

from math import inf, nan, pi, sqrt

import pytest
from bevel_differential import Clutch, Differential, Scene
from refusals import refused

# a pack with four faces from 40 to 60 mm, pressed by ramps of 45° in drive and 60° in coast at 35 mm, and by 500 N of springs
PACK = {"faces": 4, "friction": 0.12, "inner": 0.040, "outer": 0.060, "ramp_drive": "45 deg", "ramp_coast": "60 deg",
        "ramp_radius": 0.035, "spring_force": 500.0}
# by hand:
#   mean radius   (40 + 60)/2 = 50 mm, so n μ r_m = 4 · 0.12 · 0.05 m = 0.024 m
#   κ             0.024 m/(0.035 m · tan 45°) = 24/35, because tan 45° = 1
#   coast ratio   tan 45°/tan 60° = 1/√3
#   preload       0.024 m · 500 N = 12 N·m
#   area          4 · π (0.06² − 0.04²) m² = 4 π · 0.002 m²
KAPPA, COAST, PRELOAD, AREA = 24.0 / 35.0, 1.0 / sqrt(3.0), 12.0, 0.008 * pi
NUMBERS = {"limited_slip.preload": PRELOAD, "limited_slip.torque_coefficient": KAPPA, "limited_slip.coast_ratio": COAST,
           "limited_slip.mean_radius": 0.05, "limited_slip.friction_area": AREA, "limited_slip.plate_coefficient": 0.12}


@pytest.fixture
def plates():
    """plates(changes): values of the clutch with changed arguments."""
    return lambda **changes: Clutch.from_plates(**PACK | changes).values


# values

def test_values_are_those_calculated_by_hand(plates):
    found = plates()
    assert found.pop("limited_slip.pressed_by") == "both_sides" and found.pop("effects.limited_slip") is True
    assert found == pytest.approx(NUMBERS, rel=1e-12)


def test_texts_pairs_and_numbers_in_si_have_the_same_values(plates):
    written = plates(faces="4", friction="0.12", inner="40 mm", outer=(60, "mm"), ramp_drive=pi / 4.0, ramp_coast=(60.0, "deg"),
                     ramp_radius="35mm", spring_force="0.5 kN")
    plain = plates()
    assert written.pop("limited_slip.pressed_by") == plain.pop("limited_slip.pressed_by")
    assert written == pytest.approx(plain, rel=1e-12)


@pytest.mark.parametrize("changes, factor", [({"faces": 8}, 2.0), ({"friction": 0.06}, 0.5), ({"inner": 0.030, "outer": 0.050}, 0.8),
                                             ({"ramp_radius": 0.070}, 0.5), ({"ramp_drive": "60 deg"}, 1.0 / sqrt(3.0)),
                                             ({"ramp_drive": "30 deg"}, sqrt(3.0))])
def test_the_coefficient_grows_with_faces_friction_and_radius_and_falls_with_lever_and_angle(plates, changes, factor):
    assert plates(**changes)["limited_slip.torque_coefficient"] == pytest.approx(factor * KAPPA, rel=1e-12)


@pytest.mark.parametrize("coast, ratio", [("90 deg", 0.0), (pi / 2.0, 0.0), ("45 deg", 1.0), ("60 deg", COAST), ("30 deg", sqrt(3.0))])
def test_ramps_are_one_way_two_way_or_between(plates, coast, ratio):
    found = plates(ramp_coast=coast)
    assert found["limited_slip.coast_ratio"] == (ratio if ratio == 0.0 else pytest.approx(ratio, rel=1e-12))
    assert found["limited_slip.torque_coefficient"] == pytest.approx(KAPPA, rel=1e-12)


def test_without_ramps_that_press_only_the_springs_do(plates, fmu):
    found = plates(ramp_drive="90 deg", ramp_coast="90 deg")
    assert found["limited_slip.torque_coefficient"] == 0.0 and found["limited_slip.preload"] == pytest.approx(PRELOAD, rel=1e-12)
    with Differential({"scene.gear_contact": "ideal"} | found, fmu=fmu) as axle:
        axle.final(["left.speed"], stop=0.01)
        assert not [text for text in axle.warnings if "limited_slip.pressed_by" in text or "limited_slip.coast_ratio" in text]


def test_a_self_locking_pack_is_allowed_and_the_fmu_warns(plates, fmu):
    found = plates(faces=8)
    assert found["limited_slip.torque_coefficient"] == pytest.approx(48.0 / 35.0)
    with Differential({"scene.gear_contact": "lumped"} | found, fmu=fmu) as axle:
        axle.final(["left.speed"], stop=0.001)
        assert any("lock themselves" in text for text in axle.warnings)


# refusals

@pytest.mark.parametrize("name, value, said", [
    ("faces", 0, "1 or more"), ("faces", 2.5, "whole number"), ("faces", True, "number"), ("faces", "many", "number"),
    ("friction", 0.0, "outside [0.01, 1]"), ("friction", 1.5, "outside [0.01, 1]"), ("friction", nan, "finite"),
    ("inner", 0.0, "above 0 mm … numbers are in m"), ("inner", 0.06, "not below outer = 60 mm"), ("inner", "70 mm", "not below"),
    ("inner", inf, "finite"), ("outer", "60 deg", "unit deg of \"60 deg\" does not fit … mm"), ("outer", None, "number"),
    ("ramp_drive", 45, "above 0 deg and at most 90 deg … numbers are in rad"), ("ramp_drive", "0 deg", "above 0 deg"),
    ("ramp_drive", "91 deg", "at most 90 deg"), ("ramp_coast", -0.1, "above 0 deg"), ("ramp_coast", "60", "at most 90 deg … rad"),
    ("ramp_radius", 0.0, "above 0 mm"), ("ramp_radius", nan, "finite"), ("spring_force", -1.0, "0 N or more"),
    ("spring_force", "500 N.m", "unit N.m of \"500 N.m\" does not fit … kN")])
def test_an_argument_out_of_range_is_refused_by_its_name(plates, name, value, said):
    with refused(f"Clutch.from_plates: {name} = … {said}"):
        plates(**{name: value})


@pytest.mark.parametrize("changes, name, causes", [
    ({"faces": 100}, "torque_coefficient", "faces"), ({"ramp_coast": "1 deg"}, "coast_ratio", "ramp_drive and ramp_coast"),
    ({"spring_force": "1e9 N"}, "preload", "spring_force"), ({"inner": 1e-4, "outer": 1e-3}, "mean_radius", "inner and outer")])
def test_a_value_that_the_fmu_would_refuse_is_refused_with_its_arguments(plates, changes, name, causes):
    with refused(f"limited_slip.{name} = … is outside [ … {causes}"):
        plates(**changes)


def test_ramps_that_press_only_in_coast_are_refused_with_a_remedy(plates):
    with refused("Clutch.from_plates: ramp_drive = 90 deg presses nothing … ramp_coast = 60 deg … turn the signs … exchange ramp_drive and "
                 "ramp_coast"):
        plates(ramp_drive="90 deg")


# scene files

FILE = """description = "packs"
stop_time = 1.0
step = "1 ms"
outputs = ["left.shaft_torque"]
clutch = {{{clutch}}}
[set]
scene.gear_contact = "lumped"
{set}
"""
IN_FILE = {"faces": "4", "friction": "0.12", "inner": '"40 mm"', "outer": "0.060", "ramp_drive": '"45 deg"', "ramp_coast": '"60 deg"',
           "ramp_radius": '"35 mm"', "spring_force": '"0.5 kN"'}


@pytest.fixture
def of_file(fmu, tmp_path):
    """of_file(dimensions, set): values of a scene file with these packs."""
    def read(dimensions=IN_FILE, set=""):
        file = tmp_path / "scene.toml"
        file.write_text(FILE.format(clutch=", ".join(f"{name} = {value}" for name, value in dimensions.items()), set=set), encoding="utf-8")
        with Scene.load(file, fmu) as scene:
            return dict(scene.values)
    return read


def test_a_scene_file_has_the_packs_of_its_dimensions(of_file, fmu):
    found = of_file()
    assert found.pop("scene.gear_contact") is not None and found.pop("effects.limited_slip")
    assert fmu.variable("limited_slip.pressed_by").written(found.pop("limited_slip.pressed_by")) == "both_sides"
    assert found == pytest.approx(NUMBERS, rel=1e-12)


def test_values_of_a_scene_file_replace_those_of_the_packs(of_file):
    found = of_file(set='limited_slip.preload = "3 N.m"\neffects.limited_slip = false')
    assert found["limited_slip.preload"] == 3.0 and not found["effects.limited_slip"]
    assert found["limited_slip.torque_coefficient"] == pytest.approx(KAPPA, rel=1e-12)


def test_springs_may_be_left_out_of_a_scene_file(of_file):
    assert of_file({name: value for name, value in IN_FILE.items() if name != "spring_force"})["limited_slip.preload"] == 0.0


@pytest.mark.parametrize("changes, said", [
    ({"faces": "2.5"}, "faces = 2.5: it must be a whole number of 1 or more"), ({"faces": "true"}, "faces = true … number"),
    ({"outer": '"60 deg"'}, "outer = \"60 deg\" … deg … mm"), ({"outer": '"30 mm"'}, "inner = 40 mm is not below outer = 30 mm"),
    ({"ramp_drive": "45"}, "ramp_drive = 45: it must be above 0 deg and at most 90 deg; numbers are in rad"),
    ({"ramp_drive": '"90 deg"'}, "presses nothing … exchange"), ({"friction": "1.5", "ramp_radius": "0"}, "friction = 1.5 … ramp_radius = 0"),
    ({"plates": "4"}, "there is no dimension plates … known: faces"), ({"faces": "100"}, "torque_coefficient … calculated from faces")])
def test_dimensions_in_a_scene_file_are_refused_by_their_name(of_file, changes, said):
    with refused(f"clutch: … {said}"):
        of_file(IN_FILE | changes)


def test_all_missing_dimensions_of_a_scene_file_are_listed(of_file):
    with refused("clutch: friction, inner, outer, ramp_drive, ramp_coast, ramp_radius are missing"):
        of_file({"faces": "4"})


@pytest.mark.parametrize("arguments, said", [((0.99,), "tbr = 0.99 … 1 or more"), ((inf,), "tbr … finite"), (("x",), "tbr"),
                                              ((2.0, -1.0), "preload: -1 … outside [0, "), ((2.0, "1 N"), "preload … unit N of")])
def test_a_wrong_bias_ratio_or_preload_is_refused(arguments, said, fmu):
    with refused(f"Clutch.from_bias_ratio: … {said}"):
        Clutch.from_bias_ratio(*arguments, fmu=fmu)


# torques of the FMU

def slipping(fmu, values, torque, difference):
    """Outputs in a bench with the carrier's torque and an imposed difference of the wheel speeds. Lumped gears have no friction."""
    scene = {"scene.gear_contact": "lumped", "scene.carrier_drive": "torque", "scene.left_drive": "speed", "scene.right_drive": "speed",
             "carrier.torque_command": torque, "carrier.speed_command": 30.0, "left.speed_command": 30.0 + 0.5 * difference,
             "right.speed_command": 30.0 - 0.5 * difference}
    with Differential(scene | values, fmu=fmu) as axle:
        # shafts with more damping than usual, so that the swings of the start decay within the run
        axle.set({f"half_shaft.{side}_damping": 0.01 * fmu.variable(f"half_shaft.{side}_stiffness").start for side in ("left", "right")})
        return axle.final(["left.shaft_torque", "right.shaft_torque", "torque_bias_ratio"], stop=1.0)


@pytest.mark.parametrize("difference", [4.0, -4.0])
@pytest.mark.parametrize("torque, ratio", [(1600.0, 1.0), (-1600.0, COAST)])
def test_wheel_torques_differ_as_the_drawing_says_in_drive_and_in_coast(plates, fmu, torque, ratio, difference):
    found = slipping(fmu, plates(), torque, difference)
    left, right = found["left.shaft_torque"], found["right.shaft_torque"]
    # each pack has the preload and, by its ring, n μ r_m T/(2 r tan β); both packs move torque from the fast wheel to the slow one
    moved = 2.0 * PRELOAD + ratio * KAPPA * abs(torque)
    assert left + right == pytest.approx(torque, rel=1e-5)
    assert (right - left) * (1.0 if difference > 0.0 else -1.0) == pytest.approx(moved, rel=1e-5)


@pytest.mark.parametrize("tbr", [1.0, 1.5, 3.0])
def test_the_fmu_has_the_given_bias_ratio(fmu, tbr):
    values = Clutch.from_bias_ratio(tbr, fmu=fmu).values
    # by hand: (3 − 1)/(3 + 1) = 1/2 and (1.5 − 1)/(1.5 + 1) = 1/5
    assert values["limited_slip.torque_coefficient"] == pytest.approx({1.0: 0.0, 1.5: 0.2, 3.0: 0.5}[tbr], rel=1e-12)
    assert values["limited_slip.preload"] == 0.0
    found = slipping(fmu, values, 1600.0, 4.0)
    assert found["torque_bias_ratio"] == pytest.approx(tbr, rel=1e-5)
    assert found["right.shaft_torque"] / found["left.shaft_torque"] == pytest.approx(tbr, rel=1e-5)


def test_preload_adds_to_a_bias_ratio(fmu):
    found = slipping(fmu, Clutch.from_bias_ratio(3.0, "40 N.m", fmu=fmu).values, 1600.0, 4.0)
    # T/2 ± (T/4 + 40 N·m)
    assert [found["left.shaft_torque"], found["right.shaft_torque"]] == pytest.approx([360.0, 1240.0], rel=1e-5)
