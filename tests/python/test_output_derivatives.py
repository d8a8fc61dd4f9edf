"""Output derivatives against central differences of the outputs over small communication steps: every output, scenes with
effects, and the arrays of FMI 3.0."""

import ctypes

import numpy as np
import pytest
import theory
from bevel_differential.instance import Instance
from braking import BRAKED, brakes, drive_torque
from driving import BIAS, STEADY_TURN
from fmi3 import Unit3

WHEELS = {"inertia.left_end": 0.6, "inertia.right_end": 0.9, "left.load_torque": 500.0, "right.load_torque": 300.0}
WARM = {"effects.warm_up": True, "warm_up.gears_above_oil": 20.0, "warm_up.clutch_above_oil": 5.0, "warm_up.washers_above_oil": 10.0,
        "warm_up.clutch_capacity": 50.0}
RUBBING = {"effects.thrust_friction": True, **theory.CLUTCHES, **theory.DRAG}
DRIVEN = BRAKED | brakes(150.0, 100.0) | drive_torque(700.0) | WHEELS | {"carrier.speed_command": 40.0}
PINION = {"effects.final_drive": True, "pinion.torque_command": 150.0, "pinion.speed_command": 160.0, "final_drive.spiral_angle": 0.5,
          "final_drive.ring_side": "right"}
ERRORS = {"final_drive.elastic_mesh": True, "final_drive.error_1": 1e-6, "final_drive.pinion_runout": 1e-5}
# a start out of equilibrium keeps everything moving
SCENES = {
    "ideal": DRIVEN | WARM | {"scene.gear_contact": "ideal", **theory.DRAG, **theory.CLUTCHES, "limited_slip.torque_coefficient": 0.0,
                              "limited_slip.preload": 40.0, "bearing_drag.viscosity_from_oil": True},
    "sump": DRIVEN | WARM | {"scene.gear_contact": "ideal", **theory.DRAG, "warm_up.sump_given": True, "oil.temperature": 330.0},
    "lumped": DRIVEN | WARM | RUBBING | {"scene.gear_contact": "lumped", "scene.start": "rolling"},
    "tooth": DRIVEN | WARM | RUBBING | {"effects.tooth_friction": True, "effects.strength": True, "scene.start": "rolling"},
    "line": STEADY_TURN | WHEELS | WARM | RUBBING | {"contact.law": "line", "effects.tooth_friction": True, "effects.strength": True,
                                            "effects.tooth_errors": True, "tooth_errors.planet_runout": 1e-5},
    "four planets": STEADY_TURN | WHEELS | {"geometry.planet_teeth": 9, "geometry.side_teeth": 14, "geometry.planet_count": 4, "scene.planet_spin": "free", "scene.start": "rolling"},
    "half-shafts": BIAS | {"effects.half_shaft": True, "effects.pin_compliance": True, "effects.final_drive": True,
                           "pinion.torque_command": 1670.0 / 4.1, "pinion.speed_command": 205.0},
    "final drive": DRIVEN | PINION | {"final_drive.friction_torque": 1.0, "final_drive.viscous": 0.01, "effects.half_shaft": True},
    "propeller shaft": DRIVEN | PINION | ERRORS | {"scene.gear_contact": "ideal", "effects.propeller_shaft": True, "scene.carrier_drive": "speed",
                                                   "final_drive.ring_side": "left",
                                                   "propeller_shaft.joint_angle": 0.1, "scene.start": "rolling"},
    "clutches": BIAS | WARM | {"effects.clutches": True, "left.clutch_command": 0.2, "right.clutch_command": 0.1, "clutches.left_ratio": 1.1,
                               "clutches.stribeck_speed": 0.5, "clutches.static_ratio": 1.3, "effects.half_shaft": True},
    "actuators": DRIVEN | {"scene.gear_contact": "ideal", "scene.start": "rolling", "effects.clutches": True, "clutches.response_time": 0.02, "clutches.stroke_time": 0.3, "clutches.dead_band": 0.05,
                         "left.clutch_command": 0.2, "clutches.left_ratio": 1.1, "effects.half_shaft": True, "effects.disconnect": True,
                         "disconnect.ratchet_torque": 3.0, "disconnect.most_speed": 1e-3, "right.dog_command": 0.0},
    "half-shafts that warm up": DRIVEN | WARM | RUBBING | {"effects.half_shaft": True, "scene.start": "rolling"},
}
# inputs that change within the steps, per second
SLOPES = {"ideal": {"carrier.torque_command": 2e3, "left.brake_torque": 300.0, "warm_up.ambient_change": 5.0},
          "sump": {"warm_up.sump_change": 3.0, "right.load_torque": -1e3}, "lumped": {"left.load_torque": 1e3},
          "clutches": {"left.clutch_command": 2.0, "right.clutch_command": 1.0, "left.speed_command": 20.0},
          "actuators": {"left.clutch_command": 2.0, "right.clutch_command": 6.0, "right.dog_command": 200.0},
          "final drive": {"pinion.torque_command": 500.0}, "propeller shaft": {"pinion.speed_command": 50.0},
          "line": {"spin.command": 2.0, "carrier.speed_command": 10.0}}
# outputs that jump by the documentation: with completed steps, at events, and from tooth pair to tooth pair
JUMPS = ("damage.", "solver.", "held.", "safety.root_min", "safety.flank_min", "coupling.")
COUNTS = ("_peak_to_peak", "_pairs", ".tooth", ".dog_phase")
POINTS, STEP, SIZE = 4, 7e-3, 4e-6
# allowed error relative to the largest slope of an output in the run, or of the fastest temperature (the thermal network has order 2)
CLOSE = 2e-3
# tolerance of the solver, whose error in a step is in the slopes of its continuous extension; rounding error of differences
TOLERANCE, ROUNDING, TORQUES = 1e-10, 1e-15, 1e3


def jumps(name):
    return name.startswith(JUMPS) or name.endswith(COUNTS)


class Derivatives(Instance):
    """Instance whose outputs have rates."""

    def rates(self, names):
        references = [self.fmu.variable(name).reference for name in names]
        return np.array(self._through("rates", self.raw.getRealOutputDerivatives, references, [1] * len(names)))

    def around(self, names):
        """Rates, central differences and their uncertainty, after two short steps. Differences over two distances distinguish curvature
        and kinks from errors."""
        values = [self.read(names)]
        for k in range(4):
            self.step(SIZE)
            values.append(self.read(names))
            if k == 1:
                rates = self.rates(names)
        values = np.array(values)
        long, short = (values[4] - values[0]) / (4.0 * SIZE), (values[3] - values[1]) / (2.0 * SIZE)
        # accelerations follow from torques of some kN.m
        least = np.array([TORQUES if self.fmu.variable(name).unit == "rad/s2" else 0.0 for name in names])
        error = ROUNDING / SIZE + TOLERANCE / self.get("solver.step_size")
        return rates, short, np.abs(long - short) + error * np.maximum(np.abs(values[2]), least)


def along(fmu, values, slopes, outputs):
    """Rates, differences and uncertainties at points of a run, each of shape (points, outputs)."""
    found = []
    with Derivatives(fmu) as instance:
        instance.initialise({**values, "solver.relative_tolerance": TOLERANCE})
        instance.set_slopes(slopes)
        for _ in range(POINTS):
            instance.step(STEP)
            found.append(instance.around(outputs))
    return [np.array(each) for each in zip(*found)]


def scales(names, differences):
    """Largest slope of each output; for a temperature, that of all temperatures."""
    largest = np.abs(differences).max(axis=0)
    warm = np.array([name.startswith("temperature.") for name in names])
    return np.where(warm, largest[warm].max(), largest)


@pytest.mark.parametrize("name", SCENES)
def test_rates_are_central_differences_of_the_outputs(fmu, outputs, name):
    rates, differences, uncertain = along(fmu, SCENES[name], SLOPES.get(name, {}), outputs)
    allowed = CLOSE * scales(outputs, differences) + uncertain
    for k, output in enumerate(outputs):
        if jumps(output):
            assert not rates[:, k].any(), output
        else:
            assert np.all(np.abs(rates - differences)[:, k] <= allowed[:, k]), (output, rates[:, k], differences[:, k])


def test_every_output_that_moves_continuously_moves_in_one_of_the_scenes(fmu, outputs):
    moves = np.zeros(len(outputs), bool)
    for name, values in SCENES.items():
        rates, differences, uncertain = along(fmu, values, SLOPES.get(name, {}), outputs)
        moves |= np.any(np.abs(differences) > 10.0 * uncertain, axis=0) & rates.any(axis=0)
    still = [output for output, moved in zip(outputs, moves) if not moved and not jumps(output)]
    # a third loaded pair needs a contact ratio above 2
    assert [output for output in still if not output.startswith("mesh.pair[3]")] == []


def test_arrays_of_fmi_3_have_the_rates_of_their_elements(fmu3):
    with Unit3(fmu3) as unit:
        unit.initialise({"geometry.planet_teeth": 10, "geometry.side_teeth": 18, "geometry.planet_count": 3, "scene.start": 2,
                         "left.load_torque": 600.0, "inertia.left_end": 0.5})
        unit.step(0.0, 0.01)
        variables = unit.variables

        def rates(name, size):
            values, references = (ctypes.c_double * size)(), (ctypes.c_uint * 1)(variables[name].valueReference)
            unit.raw.fmi3GetOutputDerivatives(unit.raw.component, references, 1, (ctypes.c_int32 * 1)(1), values, size)
            return list(values)

        arrays = [name for name, variable in variables.items() if variable.dimensions and variable.type == "Float64"]
        moving = 0
        for array in arrays:
            is_pairs = array.startswith("mesh.")
            element = array.replace("pairs_", "pair[{}].") if is_pairs else array.replace("planets.", "planet[{}].")
            expected = [rates(element.format(k), 1)[0] for k in (1, 2, 3)]
            assert rates(array, 3) == expected, array
            moving += any(expected)
        assert moving >= 8
        assert rates("event.time", 1) == [0.0]
