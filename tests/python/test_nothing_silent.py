"""A value without effect in a scene causes a warning with its name and with the setting that it needs, wherever a scene is set up."""

import warnings
from pathlib import Path

import pytest

from bevel_differential import DifferentialWarning, Scene, shipped_scenes
from bevel_differential.answers import about, ask
from bevel_differential.spectrum import Event, spectrum
from bevel_differential.values import UNFELT
from refusals import refused

SCENES = Path(__file__).resolve().parents[2] / "scenes"
# values that are set, and the setting that they need
CASES = [
    ({"left.brake_torque": 200.0}, "effects.wheel_brake = true"),
    ({"limited_slip.preload": 80.0}, "effects.limited_slip = true"),
    ({"tooth_errors.accuracy_grade": 7}, "effects.tooth_errors = true"),
    ({"geometry.planet_addendum": 1.1, "geometry.addendum_system": "gleason"}, "geometry.addendum_system = explicit"),
    ({"carrier.torque_command": 300.0}, "scene.carrier_drive = torque"),
    ({"left.speed_command": 40.0}, "scene.left_drive = speed"),
    ({"right.load_torque": 40.0, "scene.right_drive": "speed"}, "scene.right_drive = torque"),
    ({"spin.command": 3.0}, "scene.planet_spin = imposed"),
    ({"fault.trigger": 1.0}, "effects.tooth_fault = true"),
    ({"tooth_fault.depth": 2e-4}, "effects.tooth_fault = true"),
    ({"tooth_fault.onset": 0.01, "effects.tooth_fault": True}, "tooth_fault.at_onset = true"),
    ({"contact.reference_line_load": 3e5}, "contact.law = line"),
    ({"contact.stiffness": 1e10, "contact.stiffness_from_hertz": True}, "contact.stiffness_from_hertz = false"),
    ({"contact.restitution": 0.7}, "contact.damping_model = restitution"),
    ({"contact.mesh_stiffness": 2e10, "scene.gear_contact": "lumped"}, "contact.mesh_stiffness_from_geometry = false"),
    ({"contact.damping": 1e4, "scene.gear_contact": "ideal"}, "scene.gear_contact != ideal"),
    ({"solid.facets": 20}, "scene.gear_contact = solid"),
    ({"solver.fixed_step": 2e-4}, "solver.method = fixed_step"),
    ({"inertia.planet": 1e-5}, "inertia.from_geometry = false"),
    ({"half_shaft.left_damping": 9.0}, "effects.half_shaft = true"),
    ({"half_shaft.left_damping": 9.0, "effects.half_shaft": True}, "inertia.left_end > 0"),
    ({"thrust_friction.pin_radius": 7e-3, "effects.thrust_friction": True, "thrust_friction.radii_from_geometry": True},
     "thrust_friction.radii_from_geometry = false"),
    ({"tooth_friction.roughness": 1e-6, "effects.tooth_friction": True}, "tooth_friction.law != coulomb_stribeck"),
    ({"bearing_drag.carrier_diameter": 0.3, "effects.bearing_drag": True}, "bearing_drag.churning_from_geometry = true"),
    ({"bearing_drag.carrier_churning": 1e-3, "effects.bearing_drag": True, "bearing_drag.churning_from_geometry": True},
     "bearing_drag.churning_from_geometry = false"),
    ({"bearing_drag.carrier_width": 0.1, "effects.bearing_drag": True, "bearing_drag.churning_from_geometry": True,
      "bearing_drag.oil_level": 0.0}, "bearing_drag.oil_level > 0"),
    ({"bearing_drag.seal_torque_per_diameter": 3.0, "effects.bearing_drag": True}, "bearing_drag.seal_diameter > 0"),
    ({"bearing_drag.bearing_diameter": 0.1, "effects.bearing_drag": True}, "bearing_drag.bearing_load > 0"),
    ({"oil.density": 900.0, "effects.bearing_drag": True, "bearing_drag.churning_from_geometry": True},
     "bearing_drag.viscosity_from_oil = true"),
    ({"tooth_errors.relief_length": 0.2, "effects.tooth_errors": True}, "tooth_errors.planet_tip_relief > 0"),
    ({"carrier.speed_command": 7.0, "scene.carrier_drive": "torque", "scene.start": "rest"}, "scene.carrier_drive = speed"),
]


def unfelt(messages):
    return [message for message in messages if UNFELT in message]


@pytest.mark.parametrize("values, acts_with", CASES, ids=[" ".join(case) for case, _ in CASES])
def test_a_value_that_changes_nothing_is_named_with_the_setting_that_it_needs(opened, values, acts_with):
    name = next(iter(values))
    opened.initialise(values)
    assert [message.partition(":")[0] for message in unfelt(opened.messages)] == [name]
    assert acts_with in opened.unfelt[name]


def test_values_set_to_their_start_values_give_no_warning(fmu, opened):
    starts = {v.name: v.start for v in fmu.variables.values() if v.causality in ("parameter", "input") and v.start is not None}
    literals = {name: next((word for word, number in fmu.variable(name).literals.items() if number == value), value)
                for name, value in starts.items()}
    assert len(starts) > 130
    opened.initialise()
    usual = list(opened.messages)
    opened.initialise(literals)
    assert opened.messages == usual and not unfelt(usual)


@pytest.mark.parametrize("name", shipped_scenes())
def test_the_shipped_scenes_set_only_values_that_have_an_effect(name):
    with Scene.load(SCENES / f"{name}.toml") as scene:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DifferentialWarning)
            scene.run(stop=0.02 if name != "hil" else 5.5)
        assert not unfelt(scene.warnings)


def test_each_value_is_reported_once_in_a_run_and_again_in_the_next(opened):
    for _ in range(2):
        opened.initialise({"left.brake_torque": 200.0})
        for k in range(4):
            # the first value again, another one that is set later, and one that takes effect
            opened.set({"left.brake_torque": 150.0 + k, "left.load_torque": 800.0 + k, "limited_slip.preload": 70.0 + k})
            opened.step(1e-3)
        assert sorted(opened.unfelt) == ["left.brake_torque", "limited_slip.preload"]
        assert len(unfelt(opened.messages)) == 2


def test_an_initial_speed_acts_only_at_the_start(opened):
    opened.initialise({"scene.carrier_drive": "torque", "carrier.speed_command": 30.0})
    assert not opened.unfelt
    opened.set({"carrier.speed_command": 31.0})
    assert "scene.carrier_drive = speed" in opened.unfelt["carrier.speed_command"]


def test_a_host_that_integrates_is_warned_that_the_method_has_no_effect(fmu):
    with fmu.open("ModelExchange") as opened:
        opened.initialise({"solver.method": "radau", "effects.mesh_history": True})
        assert sorted(opened.unfelt) == ["effects.mesh_history", "solver.method"]


def test_the_log_is_of_the_category_of_warnings_and_quiet_without_it(through_fmpy):
    lines = []
    through_fmpy({"left.brake_torque": 200.0}, 0.002, debug_logging=True, logger=lambda *line: lines.append(line))
    said = [line for line in lines if UNFELT in line[4].decode()]
    assert [line[3] for line in said] == [b"logStatusWarning"]
    lines.clear()
    through_fmpy({"left.brake_torque": 200.0}, 0.002, logger=lambda *line: lines.append(line))
    assert not lines


def test_the_plan_of_a_scene_names_unused_values_of_the_start_and_of_later_settings(tmp_path):
    file = tmp_path / "later.toml"
    file.write_text((SCENES / "study_turning.toml").read_text() + "limited_slip.preload = 80.0\n"
                    "[[at]]\ntime = 0.1\nleft.brake_torque = 90.0\n[[at]]\ntime = 0.2\nleft.brake_torque = 95.0\n"
                    "[[table]]\ninput = \"right.brake_torque\"\ntime = [0.0, 0.3]\nvalue = [0.0, 20.0]\n", encoding="utf-8")
    with pytest.warns(DifferentialWarning) as caught:
        printed = ask({"ask": "plan", "of": about(file)})["text"]
    assert UNFELT not in printed
    said = [str(one.message).partition(":")[0] for one in caught if UNFELT in str(one.message)]
    assert said == ["limited_slip.preload", "left.brake_torque", "right.brake_torque"]


BY_TORQUE = {"scene.carrier_drive": "torque"}
HEAD = "name,count,duration [s],speed [km/h],speed_difference [rad/s],torque [N.m]"
CAR = {"wheel_radius": "334 mm", "track": "1.55 m", "scene.gear_contact": "lumped"}


@pytest.fixture
def cycle(tmp_path):
    """cycle(lines, parameters): damage of a duty cycle."""

    def of(lines, **parameters):
        file = tmp_path / "cycle.csv"
        file.write_text("\n".join(lines), encoding="utf-8")
        return spectrum(file, CAR | {name.replace("__", "."): value for name, value in parameters.items()})

    return of


@pytest.mark.parametrize("driven", [{}, {"scene__left_drive": "speed", "scene__right_drive": "speed"}], ids=["loads", "wheels"])
def test_a_duty_cycle_gives_its_torque_to_a_carrier_that_is_driven_by_torque(cycle, driven):
    lines = [HEAD, "turn,4,20,18,2,450", "back,2,20,-18,-2,-300", "straight,9,10,50,,800"]
    found = cycle(lines, scene__carrier_drive="torque", **driven).damage
    assert found == pytest.approx(cycle(lines).damage, rel=2e-3) and found["damage.planet"] > 0.0


def test_a_duty_cycle_refuses_unused_values_by_name(cycle):
    with refused("event 'braked': left.brake_torque: 90 N.m … effects.wheel_brake = true"):
        cycle([f"{HEAD},left.brake_torque [N.m]", "braked,4,20,18,2,450,90"])
    with refused("event 'one': left.load_torque: … scene.left_drive = torque"):
        spectrum([Event("one", 1.0, 1.0, values={"left.load_torque": 100.0, "right.load_torque": 100.0, "left.speed_command": 50.0,
                                                 "carrier.speed_command": 50.0})], {"scene.left_drive": "speed"})
