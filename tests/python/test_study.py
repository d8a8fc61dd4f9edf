"""The comparison with the study: closed forms against numbers by hand and the library's geometry, and the printed table."""

import json

import pytest

from bevel_differential import Scene
from bevel_differential.answers import ask
from bevel_differential.study import theory
from bevel_differential.study.comparison import Comparison, signed_percent
from bevel_differential.study.simulation import Run, start_values
from bevel_differential.study.stated import CASES
from bevel_differential.study.theory import Theory

STRAIGHT, TURNING = CASES.values()


@pytest.fixture(scope="module")
def forms(fmu):
    return Theory(start_values(fmu))


def test_theory_gives_the_numbers_known_by_hand(forms):
    assert theory.carrier_speed(STRAIGHT) == pytest.approx(2859.07, rel=2e-6)
    assert theory.carrier_speed(TURNING) == pytest.approx(953.02, rel=5e-6)
    assert theory.load_torque() == pytest.approx(834.29, rel=5e-6)
    assert forms.hertz_stiffness / 1e3**1.5 == pytest.approx(5.4774e5, rel=1e-5)
    assert forms.normal_force == pytest.approx(16144.0, rel=3e-5)
    turn = forms.expected(TURNING)
    assert turn.side_speeds == (1079.0, 829.0) and forms.expected(STRAIGHT).side_speeds == (2861.0, 2861.0)
    assert turn.tangential_force == pytest.approx(23194.0, rel=3e-5)
    assert turn.mesh_frequency == pytest.approx(50.0 / 9.0, rel=1e-12)
    assert forms.addendum_limit == pytest.approx(0.787, rel=1e-3)
    assert forms.standard_addenda_interfere == (True, False)


def test_theory_has_the_gears_of_the_library(forms):
    found = json.loads(ask({"ask": "geometry"})["files"]["dimensions.json"])
    assert forms.pair.contact_ratio == pytest.approx(found["tredgold"]["contact_ratio"]["exact"], rel=1e-12)
    assert forms.planar_contact_ratio == pytest.approx(found["tredgold"]["contact_ratio_without_limits"]["tredgold"], rel=1e-12)
    assert forms.addendum_limit == pytest.approx(found["side_gear"]["limit_outer_addendum_in_modules"]["value"], rel=1e-12)
    assert 1e3 * forms.side_radius == pytest.approx(found["side_gear"]["outer_pitch_diameter_d_e"]["value"] / 2.0, rel=1e-12)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_scene_of_a_case_drives_as_the_study_does(fmu, case):
    with Scene.load(case.scene, fmu=fmu) as scene:
        assert fmu.variable("carrier.speed_command").shown(scene.value("carrier.speed_command"))[1] == pytest.approx(case.carrier_speed)
        assert fmu.variable("spin.command").shown(scene.values.get("spin.command", 0.0))[1] == pytest.approx(case.planet_spin)
        assert scene.value("left.load_torque") == scene.value("right.load_torque") == 835.0


def test_differences_show_two_digits():
    assert signed_percent(0.0) == signed_percent(9e-15) == "0 %"
    assert [signed_percent(x) for x in (0.1234, -0.0001234, 1.2e-9, 5.68)] == ["+12 %", "-0.012 %", "+1.2e-7 %", "+568 %"]


def test_rows_compare_the_program_with_theory_and_name_their_notes(fmu, forms):
    results = {"side_speeds": [1090.0, 829.0], "ripple": [1.0, 2.0], "carrier_speed": 954.0, "normal_force": [16200.0, 16300.0],
               "tangential_force": [23000.0, 23000.0], "peak_tangential_force": 50000.0, "peak_time": 3.4e-5, "mesh_frequency": 5.0,
               "first_line": None, "settled_after": 1e-3, "steps": 7.0, "relative_energy_residual": -2.5e-10}
    runs = {name: Run(case, forms.expected(case), None, None, {}, results) for name, case in CASES.items()}
    found = Comparison(start_values(fmu), runs)
    lines = found.terminal().splitlines()
    rows = {line.split("  ")[0]: line.split() for line in lines[2:lines.index("")]}
    assert rows["turn: left, deg/s"][-5:] == ["1082", "1079.000", "1090.000", "+1.0", "%"]
    assert rows["turn: first line of force, Hz [6]"][-3:] == ["–", "5.556", "none"]
    assert rows["straight: energy residual [7]"][-3:] == ["–", "0", "-2.500e-10"]
    assert rows["turn: normal force per mesh, N [4]"][-5:] == ["–", "16144", "16250", "+0.65", "%"]
    assert max(map(len, lines)) <= 118 and sum(line.startswith("[") for line in lines) == len(found.notes) == 8
    # Markdown has the same cells, with each note on one line
    table, _, notes = found.document().partition("\n\n")
    assert [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]] == found.rows
    assert notes.splitlines() == [f"{i}. {note}" for i, note in enumerate(found.notes, 1)]
