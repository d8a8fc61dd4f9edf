"""No answer depends silently on a value that nobody gave: effects start without influence, start values that take effect are
listed, and the log names loads that nobody set and that accelerate the wheels backward."""

import warnings
from functools import partial
from math import inf

import pytest
from command_line import command
from refusals import refused, warnings_about
from bevel_differential import Differential, DifferentialError, DifferentialWarning, Scene
from bevel_differential.answers import about, ask
from bevel_differential.values import NOBODY_SET
from bevel_differential.vehicle import Body, Car, Motor, Tyre
from fmi3 import Unit3

# warnings about start values that nobody set
short = partial(warnings_about, "start values of the study")
BY_TORQUE = {"scene.carrier_drive": "torque", "scene.gear_contact": "ideal"}
# start values of parameters that many differentials do not need
NEUTRAL = ["limited_slip.preload", "limited_slip.torque_coefficient", *(f"bearing_drag.{name}" for name in (
    "carrier_torque", "carrier_viscous", "carrier_churning", "side_torque", "side_viscous", "seal_diameter", "bearing_load"))]


def messages(fmu, kind, values, steps=()):
    """Messages that an instance of FMI 2.0 logs, at the start and in steps up to these times."""
    with fmu.open(kind) as opened:
        opened.initialise(values)
        if kind == "CoSimulation":
            for time in steps:
                opened.step(time - opened.time)
        elif steps:
            opened.raw.newDiscreteStates()
            opened.raw.enterContinuousTimeMode()
            for time in steps:
                opened.raw.setTime(time)
                opened.raw.completedIntegratorStep()
        return list(opened.messages)


def messages3(fmu_file, kind, values):
    """Messages that an instance of FMI 3.0 logs at the start."""
    with Unit3(fmu_file.replace("BevelDifferential.fmu", "BevelDifferential3.fmu"), kind, loggingOn=True) as unit:
        unit.initialise(values)
        return [text for _, text in unit.messages]


def backward(said):
    return [text for text in said if "nobody set " in text and not text.startswith(NOBODY_SET)]


def too_fast(said):
    return [text for text in said if "faster than any differential turns" in text]


@pytest.mark.parametrize("name", NEUTRAL)
def test_values_of_optional_parts_start_at_zero(fmu, name):
    assert fmu.variable(name).start == 0.0


@pytest.mark.parametrize("contact", ["ideal", "lumped"])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_clutch_with_a_preload_has_only_the_preload(run, contact, sign):
    # each clutch moves the torque M from the carrier's half to the slower side: TBR = (T/2 + M)/(T/2 - M)
    torque, preload = 525.6, 50.0
    values = {**BY_TORQUE, "scene.gear_contact": contact, "scene.left_drive": "speed", "scene.right_drive": "speed",
              "carrier.torque_command": sign * torque, "carrier.speed_command": sign * 50.0, "left.speed_command": sign * 52.0,
              "right.speed_command": sign * 48.0, "half_shaft.left_damping": 100.0, "half_shaft.right_damping": 100.0,
              "effects.limited_slip": True, "limited_slip.preload": preload}
    last = run(values, stop=0.5, output=["torque_bias_ratio"])["torque_bias_ratio"][-1]
    assert last == pytest.approx((0.5 * torque + preload) / (0.5 * torque - preload), rel=2e-3)


def test_only_seals_drag_if_only_seals_are_given(opened):
    # both side gears turn with the carrier: 2 k d, with k = 3.737 N (ISO/TR 14179-1)
    opened.initialise({"scene.gear_contact": "ideal", "effects.bearing_drag": True, "bearing_drag.seal_diameter": 0.04,
                       "left.load_torque": 0.0, "right.load_torque": 0.0, "carrier.speed_command": 30.0})
    opened.step(0.1)
    assert opened.get("carrier.torque") == pytest.approx(2.0 * 3.737 * 0.04, rel=1e-9)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("effect, why", [("limited_slip", "no torque"), ("bearing_drag", "no drag")])
def test_an_effect_without_a_value_warns_that_it_does_nothing(fmu, kind, effect, why):
    for given in ({}, {"limited_slip.preload": 1.0, "bearing_drag.side_viscous": 1e-4}):
        said = messages(fmu, kind, {f"effects.{effect}": True, **given})
        assert sum(text.startswith(f"effects.{effect}: ") and why in text for text in said) == (not given)


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_loads_that_nobody_set_and_that_turn_the_wheels_backward_are_named_at_the_start(fmu, fmu_file, kind):
    three = {"scene.carrier_drive": 2, "scene.gear_contact": 1}
    # both loads start at 835 N.m, so 1670 N.m balance them
    for torque, warns in [(300.0, True), (0.0, True), (-300.0, True), (-5000.0, True), (1669.9, True), (1670.0, False), (2000.0, False)]:
        assert len(backward(messages(fmu, kind, {**BY_TORQUE, "carrier.torque_command": torque}))) == warns, torque
        assert len(backward(messages3(fmu_file, kind, {**three, "carrier.torque_command": torque}))) == warns, torque
    for given, warns in [({"left.load_torque": 100.0}, True), ({"left.load_torque": 900.0}, True), ({"left.load_torque": 835.0, "right.load_torque": 835.0}, False),
                         ({"left.load_torque": -900.0}, False), ({"effects.wheel_brake": True, "left.brake_torque": 2000.0}, False),
                         ({"scene.left_drive": "speed"}, True), ({"scene.left_drive": "speed", "right.load_torque": 835.0}, False)]:
        values = {**BY_TORQUE, "carrier.torque_command": 300.0, **given}
        assert len(backward(messages(fmu, kind, values))) == warns, given


def test_a_wheel_beside_an_imposed_speed_has_half_of_the_torque(fmu):
    for torque, warns in [(2.0 * 834.0, True), (2.0 * 836.0, False)]:
        assert len(backward(messages(fmu, "CoSimulation", {**BY_TORQUE, "carrier.torque_command": torque,
                                                           "scene.right_drive": "speed"}))) == warns


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_excessive_speeds_are_reported_once(fmu, sign):
    loads = {"left.load_torque": 0.0, "right.load_torque": 0.0, "carrier.torque_command": 0.0}
    for kind in ["CoSimulation", "ModelExchange"]:
        for speed, warns in [(2999.0, False), (3001.0, True)]:
            said = too_fast(messages(fmu, kind, {**BY_TORQUE, **loads, "carrier.speed_command": sign * speed}, (1e-3, 2e-3, 3e-3)))
            assert len(said) == warns, said
            assert all(text.startswith("carrier.speed: ") and "3000 rad/s = 28648 rpm" in text for text in said)
    said = too_fast(messages(fmu, "CoSimulation", {"scene.gear_contact": "ideal", "scene.planet_spin": "imposed",
                                                   "spin.command": sign * 3100.0}, (1e-3, 2e-3)))
    assert len(said) == 1 and said[0].startswith("planet[")


def test_a_drive_without_loads_gives_warnings_at_both_ends(opened):
    values = {**BY_TORQUE, "carrier.torque_command": 300.0}
    opened.initialise(values, 5.0)
    assert len(backward(opened.messages)) == 1 and not too_fast(opened.messages)
    for _ in range(5):
        opened.step(1.0)
    assert opened.get("carrier.speed") < -3e5
    assert len(backward(opened.messages)) == len(too_fast(opened.messages)) == 1


OWN = {"geometry.module": "5 mm", **BY_TORQUE, "carrier.torque_command": 2000.0}


def listed(line):
    """{name: text of its value} from a line of values that nobody set."""
    found = {}
    for group in line.removeprefix(NOBODY_SET).split("; "):
        name, _, values = group.partition(": ")
        for value in values.split(", "):
            inner, _, text = value.partition(" = ")
            found[inner if name == "drives and loads" else f"{name}.{inner}"] = text
    return found


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
@pytest.mark.parametrize("more", [{}, {"scene.gear_contact": "tooth", "effects.strength": True, "effects.thrust_friction": True},
                                  {"effects.half_shaft": True, "lock.command": 1.0}], ids=["ideal", "teeth", "lock"])
def test_other_gears_get_one_line_of_the_values_that_nobody_set_until_they_are_set(fmu, kind, more):
    lines = [text for text in messages(fmu, kind, OWN | more) if text.startswith(NOBODY_SET)]
    assert len(lines) == 1
    found = listed(lines[0])
    assert {"geometry.side_teeth", "inertia.carrier", "left.load_torque", "right.load_torque"} <= set(found)
    assert ("material.young_modulus" in found) == ("contact.law" in found) == (more.get("scene.gear_contact") == "tooth")
    assert ("lock.torque" in found) == ("lock.command" in more)
    assert not set(found) & set(OWN | more)
    # set to their start values, they count as set
    start = {name: fmu.variable(name).start for name in found}
    assert not [text for text in messages(fmu, kind, {**OWN, **more, **start}) if text.startswith(NOBODY_SET)]


def test_fmi_3_lists_the_values_that_nobody_set_too(fmu_file):
    for kind in ["CoSimulation", "ModelExchange"]:
        said = messages3(fmu_file, kind, {"geometry.module": 5e-3})
        assert sum(text.startswith(NOBODY_SET) for text in said) == 1


def test_the_study_gives_no_warning_but_its_scene_lists_the_values_that_nobody_set(fmu):
    for values in ({}, {"left.load_torque": 400.0}, {"scene.gear_contact": "ideal"}):
        assert not [text for text in messages(fmu, "CoSimulation", values) if text.startswith(NOBODY_SET)]
    with Scene("plain", set={"left.load_torque": 400.0}) as scene:
        assert "left.load_torque" not in scene.nobody_set() and "right.load_torque = 835 N.m" in scene.nobody_set()
        assert "nobody" not in scene.plan_text()


def test_a_value_that_is_not_listed_does_not_change_the_result(fmu, opened):
    """For gears and a drive, the list contains all values that take effect, so any other parameter may have any value."""
    names = ["left.speed", "right.speed", "carrier.angle", "left.shaft_torque", "carrier.torque"]
    opened.initialise(OWN)
    found = listed(next(text for text in opened.messages if text.startswith(NOBODY_SET)))
    opened.step(0.1)
    expected = opened.read(names)
    tried = 0
    for variable in fmu.variables.values():
        is_value = variable.causality == "parameter" and variable.kind == "Real" and not variable.name.startswith("solver.")
        if not is_value or variable.name in found or variable.name in OWN or variable.start in (None, 0.0, 1.0):
            continue
        if variable.name in ("geometry.shaft_angle", "contact.exponent"):
            continue
        value = min(max(1.1 * variable.start, variable.minimum or -inf), variable.maximum or inf)
        opened.initialise({**OWN, variable.name: value})
        opened.step(0.1)
        assert opened.read(names) == expected, variable.name
        tried += 1
    assert tried > 80


def test_the_plan_and_the_report_list_unset_values_by_effect(tmp_path):
    of = about("limited_slip")
    planned = [line.split("not set", 1)[1].strip() for line in ask({"ask": "plan", "of": of})["text"].splitlines() if " not set " in line]
    groups = {line.partition(": ")[0]: line for line in planned}
    assert {"geometry", "limited_slip", "half_shaft"} <= set(groups)
    assert "stiffness = 100000 N.m/rad" in groups["limited_slip"] and "preload" not in groups["limited_slip"]
    # the loads are set, and change later
    assert "drives and loads" not in groups and "lock" not in groups
    page = tmp_path / "page.html"
    command(f"report limited_slip --quick --out {page}")
    text = page.read_text(encoding="utf-8")
    assert "Values that act and that nobody set" in text and groups["half_shaft"] in text


def test_the_plan_warns_of_loads_that_turn_the_wheels_backward(scene_file):
    with pytest.warns(DifferentialWarning, match="nobody set left.load_torque = 835 N.m"):
        ask({"ask": "plan", "of": about(scene_file(BY_TORQUE | {"carrier.torque_command": 300.0}))})


def test_python_warns_of_their_number_in_one_line_and_lists_them():
    with Differential({"geometry.module": "5 mm", "contact.law": "line"}) as differential:
        found = listed(differential.nobody_set())
        assert found["right.load_torque"] == "835 N.m" and "geometry.module" not in found
        line, = short(lambda: differential.run(stop=0.002))
    assert line.startswith(f"{len(found)} start values") and "nobody_set()" in line and "accept_start_values" in line and "\n" not in line


def test_accepted_start_values_are_not_mentioned():
    own = {"geometry.module": "5 mm", "scene.gear_contact": "ideal"}
    accepted = ["right.load_torque", "inertia.carrier"]
    whole = listed(Differential(own).nobody_set())
    for kind in (lambda **more: Differential(own, **more),
                 lambda **more: Scene("own", outputs=["left.speed"], stop=0.002, set=own, **more)):
        with kind(accept_start_values=accepted) as some, kind(accept_start_values=True) as every:
            assert short(lambda: some.run(stop=0.002))[0].startswith(f"{len(whole) - 2} start values")
            assert set(listed(some.nobody_set())) == set(whole) - set(accepted)
            assert not short(lambda: every.run(stop=0.002)) and every.nobody_set() == ""
    car = {"motor": Motor(9.5, peak=300.0)}
    assert len(short(lambda: Car(own, **car).run(stop=0.01))) == 1
    with warnings.catch_warnings():
        warnings.filterwarnings("error", ".*nobody set")
        Car(own, accept_start_values=True, **car).run(stop=0.01)


@pytest.mark.parametrize("accepted, left", [("true", ""), ('["geometry.side_teeth", "inertia.carrier"]', "2 fewer"), ("false", "all"), (None, "all")])
def test_a_scene_file_accepts_start_values_in_all_its_runs(accepted, left, scene_file):
    key = "" if accepted is None else f"accept_start_values = {accepted}"
    file = scene_file({"geometry.module": "5 mm", "scene.gear_contact": "ideal"}, stop=0.002, more=key)
    with Scene.load(file) as scene:
        whole = len(listed(Differential(scene.values).nobody_set()))
        count = {"": 0, "2 fewer": whole - 2, "all": whole}[left]
        # the scene keeps it when it is sent to workers and to the library
        for kept in (scene, Scene(**scene.__getstate__())):
            assert kept.nobody_set().count(" = ") == count
            assert len(short(lambda: ask({"ask": "plan", "of": about(kept)}))) == bool(count)
    # the sweep varies one of the values
    for line, less in ((f"run {file}", 0), (f"sweep --scene {file} --vary left.load_torque=1,2 --plan grid --want left.speed --workers 0", 1)):
        warned = [text for text in command(line).warnings if "nobody set" in text]
        assert [text.split()[1] for text in warned] == ([str(count - less)] if count else [])


@pytest.mark.parametrize("accepted, part", [('["geometry.modul"]', "did you mean geometry.module"), ('["left.speed"]', "left.speed is an output"),
                                            ("3", "true, false, or a list"), ("[3]", "3 is not a name")])
def test_wrong_names_of_accepted_start_values_are_reported(accepted, part, scene_file):
    with refused(part):
        Scene.load(scene_file(more=f"accept_start_values = {accepted}"))
    with pytest.raises(DifferentialError, match="calculated|did you mean geometry.module|is a list|list of names"):
        Differential(accept_start_values={"3": "geometry.module", "[3]": "x"}.get(accepted, [accepted[2:-2]]))


@pytest.mark.parametrize("oil", [253.15, 393.15])
def test_an_oil_temperature_without_effect_is_reported(opened, oil):
    opened.initialise({"oil.temperature": oil})
    assert list(opened.unfelt) == ["oil.temperature"]
    opened.initialise({"effects.thrust_friction": True, "thrust_friction.cold_factor": 1.2, "oil.temperature": oil})
    assert not opened.unfelt


def test_an_oil_temperature_set_while_the_oil_warms_up_is_reported_to_change_nothing(started):
    warm = {"scene.gear_contact": "ideal", "effects.warm_up": True}
    for given in (False, True):
        opened = started({**warm, "warm_up.sump_given": given, "oil.temperature": 330.0})
        opened.step(0.1)
        assert not opened.unfelt
        opened.set({"oil.temperature": 340.0})
        opened.set({"oil.temperature": 341.0})
        opened.step(0.1)
        assert list(opened.unfelt) == ([] if given else ["oil.temperature"])
        assert (opened.get("temperature.oil") == 341.0) == given


def test_a_car_lists_the_values_that_nobody_gave():
    motor = Motor(9.5, peak=300.0)
    assert set(motor.unset) == {"inertia", "knee", "lag"}
    assert Motor(*[1.0] * 5).unset == {} and set(Tyre().unset) == set(Tyre.described())
    car = Car({"scene.gear_contact": "ideal"}, motor=motor, body=Body(mass=1700.0))
    assert car.unset["body.track"] == 1.5 and "body.mass" not in car.unset and "motor.ratio" not in car.unset
    with pytest.warns(DifferentialWarning, match="nobody set.*motor.inertia = 0.03.*left_tyre.radius = 0.334") as caught:
        for _ in range(2):
            car.run(stop=0.01)
    assert sum("values of a passenger car" in str(one.message) for one in caught) == 1
    with warnings.catch_warnings():
        warnings.filterwarnings("error", ".*values of a passenger car")
        Car({"scene.gear_contact": "ideal"}).run(stop=0.01)
