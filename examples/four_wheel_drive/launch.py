"""Launch of a car with four-wheel drive on split friction: three units, coupled, and one integration of all equations.

    python launch.py [PICTURE]

Prints the longest stable step, and the results at the moment at which the driver releases the pedal: of the units with ideal gears, of one
integration of all equations, and of the units with teeth.
"""

import sys

import numpy as np
from bevel_differential.text import aligned

from car import BODY, MOTOR, NAMES, PEDAL, STEP, STOP, FourWheelDrive
from whole import whole

TEETH = {unit: {"scene.gear_contact": "tooth", "contact.law": "line"} for unit in ("centre", "front", "rear")}
# distance of compared points [s], and time at which the pedal is released [s]
GRID, RELEASED = 1e-3, PEDAL[0][2]


def compared():
    """Times, the values of `NAMES` there by the units and by one integration, and the car."""
    car = FourWheelDrive()
    record = car.run()[::round(GRID / STEP)]
    times = np.linspace(0.0, STOP, len(record))
    return times, np.column_stack([record[name] for name in NAMES]), whole(car, times, MOTOR, BODY, PEDAL), car


def deviations(units, right):
    """Largest difference of each value over all times, over the largest magnitude of the value."""
    return np.abs(units - right).max(axis=0) / np.abs(right).max(axis=0)


def unit_of(name):
    return "N.m" if "torque" in name else "m/s" if name == "body.speed" else "rad/s"


def main():
    times, units, right, car = compared()
    made = car.coupling()
    print(f"longest stable step: {1e3 * made.limit:.3g} ms; step of the launch: {1e3 * STEP:g} ms")
    for (master, inputs), limit in made.limits().items():
        print(f"    {master}, inputs {'on lines' if inputs == 'lines' else inputs}: {1e3 * limit:.3g} ms")
    teeth = FourWheelDrive(changes=TEETH).run()
    at, row = round(RELEASED / GRID), teeth[round(RELEASED / STEP)]
    found = deviations(units, right)
    head = (f"at {RELEASED:g} s", "unit", "three units", "all equations", "deviation, %", "with teeth")
    print("\n" + "\n".join(aligned([head, *(
        (name, unit_of(name), f"{units[at, k]:.3f}", f"{right[at, k]:.3f}", f"{100.0 * found[k]:.4f}", f"{row[name]:.3f}")
        for k, name in enumerate(NAMES))])))
    print(f"\nlargest deviation over all times, over the largest value: {100.0 * found.max():.4f} %")
    if len(sys.argv) > 1:
        from picture import draw

        draw(times, units, right, sys.argv[1])


if __name__ == "__main__":
    main()
