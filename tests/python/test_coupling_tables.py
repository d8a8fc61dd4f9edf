"""Tables of the coupling torque for the block Limited Slip Differential: closed forms of clutches, and the block's own equations."""

import re

import numpy as np
import pytest
from command_line import command
from bevel_differential import DifferentialWarning, Scene
from bevel_differential.losses import VARIABLES, losses
from bevel_differential.losses.coupling import middle
from bevel_differential.losses.grid import Bound
from bevel_differential.losses.point import pressed
from bevel_differential.losses.tables import save_for_simulink

KAPPA, COAST, PRELOAD = 0.3, 0.25, 40.0
TORQUE, SPEED, EXPONENT = 80.0, 10.0, 0.5
TEMPERATURE = 330.0
NAMES = ("dwT", "Tdw", "Tin", "TTin")
RAMPS = {"scene.gear_contact": "lumped", "effects.limited_slip": True, "limited_slip.torque_coefficient": KAPPA,
         "limited_slip.pressed_by": "both_sides"}
VISCOUS = {"scene.gear_contact": "ideal", "effects.limited_slip": True, "limited_slip.viscous_torque": TORQUE,
           "limited_slip.viscous_speed": SPEED, "limited_slip.viscous_exponent": EXPONENT}


@pytest.fixture
def mapped():
    """mapped(values, torques, differences): map of a scene with these values."""
    def measured(values, torques, differences):
        levels = dict(zip(VARIABLES, (torques, [10.0, 40.0], differences, [TEMPERATURE])))
        with Scene("clutches", set=values) as scene:
            return losses(scene, levels, bound=Bound(10.0, 1000.0), unseen=0, workers=0)

    return measured


@pytest.fixture
def tables(tmp_path):
    """tables(map): script for Simulink, and its vectors by name."""
    def written(made):
        script = save_for_simulink(made, tmp_path / "map.m").read_text(encoding="utf-8")
        return script, {name: np.array([float(value) for value in text.split()])
                        for name, text in re.findall(r"^(\w+) = \[([^]]*)\];$", script, re.MULTILINE)}

    return written


def test_ramps_have_their_coefficient_times_the_input_torque_in_drive_and_coast(mapped, tables):
    values = RAMPS | {"limited_slip.coast_ratio": COAST, "limited_slip.preload": PRELOAD}
    _, found = tables(mapped(values, [-800.0, 200.0, 800.0], [1.0, 9.0]))
    # both packs have the preload, and κ times half the torque of the carrier
    for torque, coupling in zip(found["Tin"], found["TTin"]):
        ratio = 1.0 if torque > 0.0 else COAST
        assert coupling == pytest.approx(2.0 * PRELOAD + ratio * KAPPA * abs(torque), rel=1e-3)
    assert found["Tin"][0] == -800.0 and found["Tin"][-1] == 800.0


def test_ramps_have_their_coefficient_times_the_input_torque_at_every_slip(mapped, tables):
    made = mapped(RAMPS, [200.0, 800.0], [1.0, 9.0])
    _, found = tables(made)
    torque = made.lines[0][middle(made)[0]]
    assert found["Tdw"] == pytest.approx(np.sign(found["dwT"]) * KAPPA * torque, rel=1e-3, abs=1e-3)


def test_sheared_oil_follows_its_power_law_over_slip(mapped, tables):
    made = mapped(VISCOUS, [200.0, 800.0], [0.5, 2.0, 8.0, 40.0])
    _, found = tables(made)
    slips = found["dwT"]
    # the slip of a pack is half the difference of the wheel speeds; both packs have T_v (s/s_v)^n
    assert slips[slips > 0.0] == pytest.approx(0.5 * made.lines[2]) and slips == pytest.approx(-slips[::-1])
    law = np.sign(slips) * 2.0 * TORQUE * (np.abs(slips) / SPEED) ** EXPONENT
    assert found["Tdw"] == pytest.approx(law, rel=1e-3, abs=1e-3)
    # at every torque, the same oil
    at = 0.5 * made.lines[2][middle(made)[2]]
    assert found["TTin"] == pytest.approx(np.full(len(found["Tin"]), 2.0 * TORQUE * (at / SPEED) ** EXPONENT), rel=1e-3)


def test_the_equations_of_the_block_give_the_wheel_torques_of_the_fmu(mapped, tables):
    """The axles get T/2 ∓ Tc/2, where Tc is read at (ω1 − ω2)/2 with axle 1 on the left."""
    made = mapped(VISCOUS | {"limited_slip.preload": PRELOAD}, [200.0, 800.0], [1.0, 9.0])
    _, found = tables(made)
    torque, speed, _, warmth = middle(made)
    for place, difference in enumerate(made.lines[2]):
        for sheet, sign in ((0, 1.0), (1, -1.0)):
            coupling = np.interp(0.5 * sign * difference, found["dwT"], found["Tdw"])
            half = 0.5 * made.lines[0][torque]
            axles = [half - 0.5 * coupling, half + 0.5 * coupling]
            assert axles == pytest.approx(made.slipping[sheet][torque, speed, place, warmth, :2], rel=1e-6)
            # by hand: the pack of the fast wheel takes preload and oil from it
            moved = PRELOAD + TORQUE * (0.5 * difference / SPEED) ** EXPONENT
            assert axles == pytest.approx([half - sign * moved, half + sign * moved], rel=1e-3)


def test_a_stuck_differential_has_no_coupling_torque_straight_ahead(mapped, tables):
    script, found = tables(mapped(RAMPS, [200.0, 800.0], [1.0, 9.0]))
    [still] = found["Tdw"][found["dwT"] == 0.0]
    assert abs(still) < 1e-6 and " -0 " not in script


def test_a_map_of_coast_and_drive_shows_the_slip_in_drive(mapped, tables):
    made = mapped(RAMPS, [-800.0, 800.0], [1.0, 9.0])
    assert made.lines[0].tolist()[:3] == [-800.0, 0.0, 800.0] and middle(made)[0] == 2
    script, found = tables(made)
    assert np.abs(found["Tdw"])[0] == pytest.approx(KAPPA * 800.0, rel=1e-3) and "at 800 N.m, " in script


def test_a_single_torque_leaves_out_only_the_table_over_torque(mapped, tables):
    script, found = tables(mapped(RAMPS, [800.0], [1.0, 9.0]))
    assert set(found) & set(NAMES) == {"dwT", "Tdw"} and "left out, because the map has a single torque" in script


def test_without_limited_slip_the_tables_are_left_out_with_the_reason(mapped, tables):
    script, found = tables(mapped({"scene.gear_contact": "ideal", "effects.limited_slip": False}, [200.0, 800.0], [1.0, 9.0]))
    assert not set(found) & set(NAMES) and "because effects.limited_slip is off in the scene" in script
    assert "eta_tbl" in script and "locking_tbl" in script


ELECTRONIC = {"scene.gear_contact": "ideal", "effects.clutches": True, "clutches.torque": 300.0, "left.clutch_command": 0.4}


def test_a_clutch_on_command_has_its_torque_at_every_slip(mapped, tables):
    _, found = tables(mapped(ELECTRONIC, [200.0, 800.0], [1.0, 9.0]))
    assert found["Tdw"] == pytest.approx(np.sign(found["dwT"]) * 0.4 * 300.0, rel=1e-3, abs=1e-3)
    assert found["TTin"] == pytest.approx(np.full(len(found["Tin"]), 0.4 * 300.0), rel=1e-3)


def test_a_clutch_whose_gearing_is_supported_by_the_housing_has_no_tables_and_its_reversal_is_reported(tables):
    levels, said = dict(zip(VARIABLES, ([800.0], [40.0], [4.0, 12.0], [TEMPERATURE]))), []
    with Scene("clutches", set=ELECTRONIC | {"clutches.left_ratio": 1.125}) as scene:
        script, found = tables(losses(scene, levels, bound=Bound(1000.0, 1000.0), unseen=0, workers=0, tell=said.append))
    assert not set(found) & set(NAMES) and "to or from the housing" in script
    assert any("left clutch reverses at a difference of 0.25 times" in text for text in said)


def test_a_map_says_that_a_command_which_changes_in_the_scene_is_constant():
    levels = dict(zip(VARIABLES, ([800.0], [40.0], [4.0], [TEMPERATURE])))
    table = ("left.clutch_command", [0.0, 0.1], [0.0, 1.0], None)
    with Scene("clutches", set={**ELECTRONIC, "left.clutch_command": 0.0}, tables=[table]) as scene:
        with pytest.warns(DifferentialWarning, match="left.clutch_command changes over time in the scene, but is constant at 0 here"):
            losses(scene, levels, bound=Bound(1000.0, 1000.0), unseen=0, workers=0)


@pytest.mark.parametrize("switch, said", [("true", False), ("false", True)])
def test_the_command_says_what_it_leaves_out(switch, said, tmp_path):
    file = tmp_path / "map.m"
    printed = command(f"losses torque_bias --quick --set scene.gear_contact=ideal --set effects.tooth_friction=false "
                      f"--set effects.thrust_friction=false --set effects.limited_slip={switch} --set limited_slip.preload=40N.m "
                      f"--set limited_slip.torque_coefficient=0 --torque 200,800 --speed 40 --difference 1,9 --temperature 60degC "
                      f"--unseen 2 --workers 0 --simulink {file}").out
    words = f"{file} has no tables of the coupling torque: effects.limited_slip is off"
    assert (words in printed) is said
    assert ("TTin" in file.read_text(encoding="utf-8")) is not said


@pytest.mark.parametrize("command, sides", [(0.1, []), (0.3, ["left"])])
def test_a_clutch_within_the_dead_band_of_its_actuator_is_not_pressed(fmu_file, command, sides):
    with Scene(set={**ELECTRONIC, "left.clutch_command": command, "clutches.dead_band": 0.2}, fmu=fmu_file) as scene:
        assert pressed(scene) == sides
