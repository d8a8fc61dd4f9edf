"""Axle disconnect: a car coasts, opens the dog clutch of its right half-shaft to save drag, and closes it again while it drives.

    python disconnect.py [PICTURE]

With the right half-shaft open, the drag of the motor brings motor and carrier to rest. The left wheel then only turns the planets, and the
right side gear backward. Before the clutch closes, the motor turns the right side gear almost to the speed of its wheel.
"""

import sys

import numpy as np

from bevel_differential.panel import Panel, curve, layered, picture, time_axis
from bevel_differential.vehicle import Car

SPEED, STOP = "90 km/h", 20.0
# times of the commands, s; torque of the motor per difference of the speeds while it synchronises, N.m.s/rad
OPENS, CLOSES, GAIN = 1.0, 16.0, 1.0
OUTPUTS = ["right.dog_phase", "carrier.speed", "right.wheel_speed", "right.speed", "right.shaft_torque", "body.speed", "heat.drag"]
OPEN, CLOSED, PHASES = 0, 3, ("open", "waits for equal speeds", "waits for a gap", "closed", "waits for low torque")
# drag of the motor at the carrier, and of a side gear, N.m
DRAG, SIDE = 30.0, 1.0
GEARS = {"scene.gear_contact": "ideal", "effects.half_shaft": True, "effects.disconnect": True, "effects.bearing_drag": True,
         "bearing_drag.carrier_torque": DRAG, "bearing_drag.side_torque": SIDE}


def command(time, values):
    """Opens the clutch, and closes it after the motor has turned the right side gear almost to the speed of its wheel."""
    commanded = time < OPENS or time >= CLOSES
    is_late = time >= CLOSES and values["right.dog_phase"] != CLOSED
    return {"right.dog_command": float(commanded),
            "motor.request": GAIN * (values["right.wheel_speed"] - values["right.speed"]) if is_late else 0.0}


def coasted(opens, fmu=None):
    """Record of a car that opens its clutch, or never does."""
    car = Car(GEARS, accept_start_values=True, fmu=fmu)
    return car.run(OUTPUTS, stop=STOP, step="1 ms", speed=SPEED, controller=command if opens else None)


def changes(record):
    """Rows at the start and at each change of the phase."""
    return record[np.flatnonzero(np.diff(record["right.dog_phase"], prepend=-1.0))]


def draw(records, file):
    """Draws both cars, and the phases of the car that opens its clutch."""
    time, record = time_axis(STOP), records["opens"]

    def panel(label, curves, **look):
        return [Panel(time, label, curves, xlim=(0.0, STOP), **look)]

    def both(name):
        return layered({case: (each["time"], each[name]) for case, each in records.items()}, "Real", 1.4)

    speeds = [curve(record["time"], record[name], label) for name, label in (("carrier.speed", "carrier"), ("right.speed", "right side gear"),
                                                                            ("right.wheel_speed", "right wheel"))]
    picture([panel("phase", [curve(record["time"], record["right.dog_phase"], drawstyle="steps-post")], yticks=range(5), yticklabels=PHASES),
             panel("speed if it\nopens, rad/s", speeds, legend="lower right"), panel("heat of drag, J", both("heat.drag")),
             panel("car, m/s", both("body.speed"))],
            "With an open half-shaft, the carrier comes to rest, and the right side gear turns backward. Drag then produces almost no heat. The "
            "motor turns the right side gear to the speed of its wheel before the clutch closes, which costs some of the saved energy.",
            file, 10.0, title="Axle disconnect of a car that coasts from 90 km/h")


def main():
    records = {"opens": coasted(True), "closed": coasted(False)}
    print(f"{'time, s':>9}  {'right dog clutch':<24}{'right side gear, rad/s':>23}{'right wheel, rad/s':>20}")
    for row in changes(records["opens"]):
        print(f"{row['time']:>9.3f}  {PHASES[int(row['right.dog_phase'])]:<24}{row['right.speed']:>23.2f}{row['right.wheel_speed']:>20.2f}")
    for name, record in records.items():
        before = record[record["time"] <= CLOSES][-1]
        print(f"{name}: {before['body.speed']:.3f} m/s at {CLOSES:g} s, {before['heat.drag']:.0f} J of drag")
    if len(sys.argv) > 1:
        draw(records, sys.argv[1])


if __name__ == "__main__":
    main()
