"""Directional derivatives at the ends of ranges against one-sided differences of independent instances: all inputs and real
parameters in initialisation mode, and all inputs during simulation."""

import numpy as np
import pytest
import theory
from bevel_differential import DifferentialError
from bevel_differential.instance import Instance
from braking import BRAKED, brakes, drive_torque
from driving import GIVEN, STEADY_TURN

WHEELS = {"inertia.left_end": 0.6, "inertia.right_end": 0.9}
HOT = {"scene.gear_contact": "ideal", "effects.warm_up": True, "scene.start": "steady_heat", **theory.CLUTCHES, **theory.DRAG,
       "bearing_drag.viscosity_from_oil": True, "limited_slip.torque_coefficient": 0.0, "limited_slip.preload": 40.0,
       "limited_slip.hot_factor": 0.7, "scene.planet_spin": "imposed", "spin.command": 10.0}
STARTS = {
    "steady heat": HOT,
    "lumped": STEADY_TURN | BRAKED | WHEELS | theory.CLUTCHES | {"scene.gear_contact": "lumped", "effects.half_shaft": True,
                                                                "effects.thrust_friction": True},
    "tooth errors": STEADY_TURN | {"contact.law": "line", "effects.tooth_errors": True, "tooth_errors.crowning": 5e-6},
}
OUTPUTS = ["left.shaft_torque", "carrier.torque", "power.loss", "planet[1].left_transmission_error", "planet[1].left_normal_force",
           "left.thrust_force", "temperature.oil", "temperature.clutch", "right.speed", "left.twist"]
# allowed relative difference of derivatives; noise of an equilibrium, relative to its values
CLOSE, NOISE = 1e-4, 1e-9
# steps of differences, as a fraction of the value or, at 0, of the range up to 1 SI unit
STEPS = (1e-4, 2.5e-5)


class Starting(Instance):
    """Instance in initialisation mode."""

    def begin(self, values):
        if not self._is_fresh:
            self.reset()
        self._is_fresh = False
        self.check(self._setup(self._component, 0, 0.0, 0.0, 0, 0.0), "setup")
        self._write(self.fmu.numbers(values))
        self.check(self._enter(self._component), "enter")
        return np.array(self.read(OUTPUTS))

    def derivative(self, outputs, name):
        references = [self.fmu.variable(output).reference for output in outputs]
        known = [self.fmu.variable(name).reference]
        return np.array(self._through("a derivative", self.raw.getDirectionalDerivative, references, known, [1.0]))


def one_sided(variable, at, value, middle):
    """Differences of order 2 from the end `value` of a range into the range, and their uncertainty; `at` evaluates."""
    inward = 1.0 if value == variable.minimum else -1.0
    width = min(1.0, variable.maximum - variable.minimum)
    found = []
    for part in STEPS:
        step = inward * part * max(abs(value), 0.0 if value else width)
        found.append((-3.0 * middle + 4.0 * at(value + step) - at(value + 2.0 * step)) / (2.0 * step))
    return found[1], np.abs(found[1] - found[0]) + NOISE * np.maximum(np.abs(middle), 1.0) / abs(step)


def changing(fmu):
    """Inputs and real parameters with ranges of more than one value."""
    return [variable for variable in fmu.variables.values() if variable.kind == "Real" and variable.causality in ("input", "parameter")
            and variable.minimum is not None and variable.maximum - variable.minimum > 1e-5]


@pytest.mark.parametrize("name", STARTS)
def test_initial_values_have_one_sided_derivatives_at_the_ends_of_all_ranges(fmu, name):
    scene, compared, moving = STARTS[name], 0, 0
    with Starting(fmu) as instance:
        for variable in changing(fmu):
            for value in (variable.minimum, variable.maximum):
                # plates that a gear presses take the place of its washer immediately
                if (variable.name, value) == ("limited_slip.thrust_arm", 0.0):
                    continue

                def at(changed):
                    return instance.begin(scene | {variable.name: changed})

                try:
                    middle = at(value)
                except DifferentialError:
                    # such a start does not exist
                    continue
                try:
                    difference, uncertain = one_sided(variable, at, value, middle)
                except DifferentialError:
                    at(value)
                    with pytest.raises(DifferentialError, match="initialisation fails close to these values"):
                        instance.derivative(OUTPUTS, variable.name)
                    continue
                at(value)
                derivative = instance.derivative(OUTPUTS, variable.name)
                allowed = CLOSE * np.maximum(np.abs(derivative), np.abs(difference)) + uncertain
                assert np.all(np.abs(derivative - difference) <= allowed), (variable.name, value, derivative, difference)
                compared += 1
                moving += np.any(np.abs(difference) > 10.0 * uncertain)
    assert compared > 250 and moving > 20, (compared, moving)


def test_the_lock_of_steady_heat_has_its_derivative_at_and_near_the_end_of_its_range(fmu):
    with Starting(fmu) as instance:
        for command in (0.0, 1e-6, 0.5, 1.0):
            def at(changed):
                return instance.begin(HOT | {"lock.command": changed})

            inward, step = (1.0 if command < 0.5 else -1.0), 1e-5
            middle = at(command)
            difference = (-3.0 * middle + 4.0 * at(command + inward * step) - at(command + 2.0 * inward * step)) / (2.0 * inward * step)
            at(command)
            assert instance.derivative(OUTPUTS, "lock.command") == pytest.approx(difference, rel=1e-5, abs=1e-3), command


RUNNING = {
    "ideal": BRAKED | WHEELS | drive_torque(700.0) | {"scene.gear_contact": "ideal"},
    "lumped": BRAKED | WHEELS | drive_torque(700.0) | {"scene.gear_contact": "lumped"},
    "tooth": BRAKED | WHEELS | drive_torque(700.0) | {"carrier.speed_command": -40.0},
    "half-shafts": BRAKED | WHEELS | drive_torque(700.0) | {"effects.half_shaft": True},
    "standing": BRAKED | WHEELS | drive_torque(300.0) | brakes(0.0, 500.0) | {"scene.start": "rest"},
    "clutches": BRAKED | WHEELS | drive_torque(700.0) | theory.CLUTCHES,
}
SHOWN = ["left.acceleration", "right.acceleration", "carrier.acceleration", "left.shaft_torque", "right.shaft_torque", "power.out",
         "power.loss", "left.speed", "carrier.speed"]


@pytest.mark.parametrize("name", RUNNING)
def test_outputs_have_one_sided_derivatives_by_inputs_at_the_ends_of_their_ranges(fmu, name):
    with Starting(fmu) as instance:
        instance.initialise(RUNNING[name])
        instance.step(0.01)
        for variable in changing(fmu):
            if variable.causality != "input":
                continue
            before = instance.get(variable.name)
            for value in (variable.minimum, variable.maximum):
                def at(changed):
                    instance.set({variable.name: changed})
                    return np.array(instance.read(SHOWN))

                middle = at(value)
                derivative = instance.derivative(SHOWN, variable.name)
                difference, uncertain = one_sided(variable, at, value, middle)
                allowed = CLOSE * np.maximum(np.abs(derivative), np.abs(difference)) + uncertain + 1e-6
                assert np.all(np.abs(derivative - difference) <= allowed), (variable.name, value, derivative, difference)
            instance.set({variable.name: before})


@pytest.mark.parametrize("speed", [40.0, -40.0])
def test_a_brake_that_is_put_on_slows_its_wheel_by_its_torque(fmu, speed):
    # a rigid end turns with its side gear
    values = BRAKED | GIVEN | WHEELS | drive_torque(0.0) | {"scene.gear_contact": "lumped", "carrier.speed_command": speed}
    with Starting(fmu) as instance:
        instance.initialise(values)
        instance.step(0.01)
        for side in ("left", "right"):
            inertia = instance.get(f"inertia.{side}_end") + instance.get("inertia.side_gear")
            [found] = instance.derivative([f"{side}.acceleration"], f"{side}.brake_torque")
            assert found == pytest.approx(-np.sign(speed) / inertia, rel=1e-6)
