"""Published measurements (tests/data/published_measurements.toml) against results of the FMU with the published inputs.

Nothing is fitted. docs/design.md shows the results, and each test finds its result there."""

import tomllib
from math import log10
from pathlib import Path

import numpy as np
import pytest
from bevel_differential import Scene
from bevel_differential.bench import scene_file

ROOT = Path(__file__).parents[2]
MEASURED = tomllib.loads((ROOT / "tests/data/published_measurements.toml").read_text(encoding="utf-8"))
PAGE = (ROOT / "docs/design.md").read_text(encoding="utf-8")
# usual radius of a wheel, m, because the publication gives the speed of the car
ZERO_CELSIUS, WHEEL = 273.15, 0.31
# carrier and sides turn at one speed, and only viscous drag takes power
VISCOUS = {"scene.gear_contact": "ideal", "carrier.speed_command": 30.0, "effects.bearing_drag": True,
           "bearing_drag.viscosity_from_oil": True, "bearing_drag.carrier_viscous": 0.01,
           **{f"bearing_drag.{name}": 0.0 for name in ("carrier_torque", "carrier_churning", "side_torque", "side_viscous")}}
# start values, because no density is published
DENSITY, FALL = 870.0, 0.65


def oil(*points):
    """Oil whose viscosity line goes through two points, degC and Pa.s."""
    def place(celsius):
        return log10(celsius + ZERO_CELSIUS)

    (begin, low), (end, high) = [(place(celsius), log10(log10(1e6 * viscosity / (DENSITY - FALL * (celsius - 15.0)) + 0.7)))
                                 for celsius, viscosity in points]
    return {f"oil.viscosity_{celsius}": 1e-6 * (10.0 ** 10.0 ** (low + (high - low) * (place(celsius) - begin) / (end - begin)) - 0.7)
            for celsius in (40, 100)}


def drag(drive, fluid, celsius, reference):
    """Heat of drag in a second at a temperature, with the given viscous drag at the reference temperature."""
    return drive(VISCOUS | fluid | {"oil.temperature": celsius + ZERO_CELSIUS, "bearing_drag.reference_temperature": reference
                                    + ZERO_CELSIUS}).to(1.0, 0.1)["heat.drag"]


def test_an_oil_between_two_measured_viscosities_has_the_third_one(drive):
    errors = []
    for _, at_30, at_60, at_100 in MEASURED["oils"]["rows"]:
        fluid = oil((30.0, 1e-3 * at_30), (100.0, 1e-3 * at_100))
        errors.append(drag(drive, fluid, 60.0, 30.0) / drag(drive, fluid, 30.0, 30.0) * at_30 / at_60 - 1.0)
    sizes = np.sort(np.abs(errors))
    worst = MEASURED["oils"]["rows"][np.argmax(np.abs(errors))][0]
    said = f"| at most {100.0 * sizes[-2]:.1f} %, except {100.0 * sizes[-1]:.0f} % for a {worst} |"
    # a straight line of log η over T instead of Walther's is off by 23 to 67 %
    assert sizes[-2] < 0.1 and sizes[-1] < 0.2
    assert said in PAGE, said


def test_cold_drag_falls_with_the_viscosity_of_the_oil(drive):
    """Two fluids that differ when cold and agree at 100 °C, where viscous drag has its given value."""
    measured = MEASURED["transaxle"]
    cold = measured["temperature"]
    thick, thin = (drag(drive, oil((cold, viscosity), (100.0, 6e-3)), cold, 100.0) for viscosity in measured["viscosities"])
    fall = 1.0 - thin / thick
    # with the root of viscosity it would be 19 %, with its square 58 %
    assert fall == pytest.approx(measured["fall"], abs=0.1)
    assert f"| −{100.0 * fall:.0f} % |" in PAGE, fall


def test_a_cold_gearbox_warms_up_within_minutes(fmu_file):
    """The axle of the bench's winter start, at the speed, power and temperatures of the measurement."""
    measured = MEASURED["gearbox"]
    power, speed = measured["difference"] / measured["share"], measured["speed"] / 3.6 / WHEEL
    losses = {}
    for celsius in measured["temperatures"]:
        with Scene.load(scene_file("winter_start"), fmu=fmu_file) as scene:
            kelvin, load = celsius + ZERO_CELSIUS, 0.5 * power / speed
            scene.set({"oil.temperature": kelvin, "warm_up.ambient_temperature": kelvin, "carrier.speed_command": speed,
                       "left.load_torque": load, "right.load_torque": load})
            record = scene.run(["power.loss"], stop=measured["duration"])
        # without the first step, in which everything starts to move
        losses[celsius] = record["time"][1:], record["power.loss"][1:]
    cold, mild = measured["temperatures"]
    (time, loss), (_, mild_loss) = losses[cold], losses[mild]
    early = time <= measured["early"]
    done = (loss[0] - loss[early][-1]) / (loss[0] - loss[-1])
    more = (np.trapezoid(loss[early], time[early]) / np.ptp(time[early]) - loss[-1]) / power
    difference = loss[-1] - mild_loss[-1]
    assert done > 0.9
    # thick oil causes this much more loss than the oil that has warmed up
    assert 0.0 < more < measured["increase"]
    # for another machine, only the order of magnitude can agree
    assert 0.1 < difference / measured["difference"] < 10.0
    for said in (f"| {100.0 * done:.0f} % |", f"| {1e-3 * difference:.2f} kW |"):
        assert said in PAGE, said
