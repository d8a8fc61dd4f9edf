"""Values at the ends of ranges: a value that exceeds a range by rounding becomes its limit, and a refused call sets nothing."""

import math
import random

import numpy as np
import pytest
from bevel_differential import Differential, DifferentialError
from bevel_differential.vehicle import Car, Motor
from braking import BRAKED
from driving import put
from fmi3 import Unit3

ROUNDING = 1e-9
CLUTCHES = {"effects.limited_slip": True, "scene.gear_contact": "lumped"}


def ranged(fmu, *kinds):
    return [variable for variable in fmu.variables.values() if variable.kind == "Real" and variable.minimum is not None
            and (variable.causality == "input" or variable.variability == "tunable") and variable.causality in kinds]


@pytest.fixture
def running(started):
    instance = started(BRAKED | {"effects.limited_slip": True, "effects.warm_up": True})
    instance.step(1e-3)
    return instance


def test_inputs_and_tunable_parameters_take_the_limit_that_rounding_exceeds(fmu, running):
    for variable in ranged(fmu, "input", "parameter"):
        for limit, outward in ((variable.minimum, -1.0), (variable.maximum, 1.0)):
            for last in (limit, 0.5 * (variable.minimum + variable.maximum)):
                put(running, variable.name, last)
                allowed = ROUNDING * max(1.0, abs(last))
                put(running, variable.name, limit + outward * 0.9 * allowed)
                assert running.get(variable.name) == limit
                put(running, variable.name, last)
                # a double does not resolve less at the ends of wide ranges
                beyond = max(1.1 * allowed, 2.0 * math.ulp(limit))
                with pytest.raises(DifferentialError, match=rf"{variable.name}.* is outside"):
                    put(running, variable.name, limit + outward * beyond)
                assert running.get(variable.name) == last
    assert running.messages == [message for message in running.messages if "rounding" not in message]


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_values_that_are_not_finite_stay_errors(fmu, running, value):
    for variable in ranged(fmu, "input", "parameter"):
        before = running.get(variable.name)
        with pytest.raises(DifferentialError, match="not a finite number"):
            put(running, variable.name, value)
        assert running.get(variable.name) == before


def test_inputs_take_the_limit_before_the_start_and_fixed_parameters_stay_as_they_are_given(fmu):
    with fmu.open() as instance:
        put(instance, "lock.command", 1.0000000000000009)
        assert instance.get("lock.command") == 1.0
        put(instance, "limited_slip.preload", -1e-12)
        assert instance.get("limited_slip.preload") == 0.0
    with fmu.open() as instance, pytest.raises(DifferentialError, match="geometry.backlash"):
        put(instance, "geometry.backlash", -1e-12)
        instance.initialise()


def test_a_call_of_several_values_sets_all_or_none(fmu, running):
    names = ["right.load_torque", "left.brake_torque", "limited_slip.preload"]
    before = running.read(names)
    for bad, place in ((-5.0, 1), (1e9, 0), (-5.0, 2)):
        values = [100.0, 20.0, 30.0]
        values[place] = bad
        with pytest.raises(DifferentialError, match=f"{names[place]}.*; none of the 3 values"):
            running.set(dict(zip(names, values)))
        assert running.read(names) == before
    with pytest.raises(DifferentialError) as alone:
        running.set({"left.brake_torque": -5.0})
    assert "none of" not in str(alone.value)


def test_a_mixed_set_of_several_kinds_sets_all_or_none(fmu):
    names = ["left.load_torque", "geometry.planet_teeth", "scene.gear_contact", "effects.backlash"]
    with fmu.open() as instance:
        before = instance.read(names)
        with pytest.raises(DifferentialError, match="left.load_torque.*; none of the 4 values was set"):
            instance.set({"left.load_torque": 1e9, "geometry.planet_teeth": 11, "scene.gear_contact": "ideal", "effects.backlash": False})
        assert instance.read(names) == before
        instance.initialise()
        before = instance.read(names)
        with pytest.raises(DifferentialError, match="effects.backlash.*; none of the 2 values was set"):
            instance.set({"left.load_torque": 100.0, "effects.backlash": False})
        assert instance.read(names) == before


def test_fmi_3_takes_limits_and_sets_all_or_none(fmu3):
    with Unit3(fmu3) as unit:
        unit.initialise({"effects.wheel_brake": True})
        unit.step(0.0, 1e-3)
        unit.set({"left.brake_torque": -1e-12, "lock.command": 1.0000000000000009})
        assert list(unit.reals(["left.brake_torque", "lock.command"])) == [0.0, 1.0]
        names = ["right.load_torque", "left.brake_torque"]
        before, references = list(unit.reals(names)), [unit.variables[name].valueReference for name in names]
        with pytest.raises(Exception, match="fmi3SetFloat64"):
            unit.raw.setFloat64(references, [500.0, -5.0])
        assert list(unit.reals(names)) == before
        assert "none of the 2 values of this call was set" in unit.messages[-1][1]


def test_ramps_by_input_derivatives_may_end_at_a_limit(started):
    chance = random.Random(1)
    instance = started(BRAKED | {"scene.gear_contact": "ideal"})
    for _ in range(100):
        begin, count, size = chance.uniform(0.01, 3000.0), chance.randint(1, 40), chance.choice([1e-3, 1.0 / 60.0, 3e-3])
        instance.set({"left.brake_torque": begin, "lock.command": 0.0})
        for _ in range(count):
            instance.set_slopes({"left.brake_torque": -begin / (count * size), "lock.command": 1.0 / (count * size)})
            instance.step(size)
        assert instance.get("left.brake_torque") == pytest.approx(0.0, abs=1e-9 * begin)
        assert instance.get("lock.command") == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("beyond, taken", [(0.5, True), (3.0, False)])
def test_an_input_whose_derivative_leads_beyond_its_limit_by_rounding_keeps_the_limit(fmu, started, beyond, taken):
    # an input without effect in this scene, so that any value is harmless
    name, size = "carrier.torque_command", 1e-3
    limit = fmu.variable(name).maximum
    instance = started({"scene.gear_contact": "ideal"})
    instance.set({name: limit - 1.0})
    instance.set_slopes({name: (1.0 + beyond * ROUNDING * limit) / size})
    if not taken:
        with pytest.raises(DifferentialError, match=name):
            instance.step(size)
        return
    instance.step(size)
    assert instance.get(name) == limit
    # the state can be saved and restored
    instance.restore(instance.save())


def test_tables_and_controllers_may_exceed_a_range_by_rounding(fmu_file):
    times = np.linspace(0.0, 0.01, 11)
    commands = np.linspace(0.0, 1.0, 11) * (1.0 + 4e-16)
    commands[0] = -1e-15
    with Differential(CLUTCHES, fmu=fmu_file) as differential:
        differential.run(outputs=["left.speed"], stop=0.01, step=1e-3, inputs={"lock.command": (times, commands)})
        differential.run(outputs=["left.speed"], stop=0.01, step=1e-3, inputs={"lock.command": (times, commands)}, input_slopes=False)


def test_a_controller_of_a_car_sets_all_or_none_and_may_round(fmu_file):
    values = {"effects.wheel_brake": True, "scene.gear_contact": "ideal"}
    Car(values, motor=Motor(ratio=9.0), fmu=fmu_file).run(["left.speed"], stop=0.002, request=50.0,
                                                          controller=lambda *_: {"left.brake_torque": -1e-15})
    with pytest.raises(DifferentialError, match="right.brake_torque.*none of the 2 values"):
        Car(values, motor=Motor(ratio=9.0), fmu=fmu_file).run(
            ["left.speed"], stop=0.002, request=50.0, controller=lambda *_: {"left.brake_torque": 10.0, "right.brake_torque": -1.0})
