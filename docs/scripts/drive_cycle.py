"""Drive cycle of the scene drive_cycle: the course of a car, with torque and speeds of its axle. Writes scenes/drive_cycle.csv.

usage, from the top of the repository:
    target/python/bin/python docs/scripts/drive_cycle.py
"""

from pathlib import Path

import numpy as np

FILE = Path(__file__).resolve().parents[2] / "scenes" / "drive_cycle.csv"

MASS, RADIUS, TRACK = 1600.0, 0.32, 1.55  # kg, m (rolling radius of the wheels), m
TURNING, ROLLING, DRAG = 1.05, 0.012, 0.65  # factor of the mass for rotating wheels, fraction of the weight, m2 (area times coefficient)
AIR, GRAVITY = 1.2, 9.81  # kg/m3, m/s2
# lowest carrier torque: CREEP, N.m, up to CREEPS, m/s, and ENGINE_BRAKING, N.m, from BRAKES, m/s. Wheel brakes do the rest
CREEP, CREEPS, ENGINE_BRAKING, BRAKES = 150.0, 3.0, -150.0, 6.0
SMOOTHING = np.array([1.0, 2.0, 3.0, 2.0, 1.0]) / 9.0  # weights of successive seconds

# time, s: speed, km/h
SPEED = {
    # town
    0: 0, 4: 0, 12: 40, 15: 20, 20: 20, 26: 42, 30: 20, 35: 20, 42: 45, 47: 45, 54: 0, 68: 0, 79: 50, 95: 50, 103: 0, 118: 0, 128: 45,
    140: 50, 147: 25, 157: 25, 166: 50, 185: 50, 194: 0, 204: 0,
    # country road
    214: 50, 228: 90, 238: 90, 244: 68, 252: 68, 264: 95, 284: 95, 291: 62, 306: 62, 318: 92, 342: 92, 356: 0, 362: 0, 367: 18, 371: 20,
    # motorway, and back into town
    383: 70, 390: 60, 402: 60, 420: 115, 430: 130, 495: 130, 500: 122, 514: 68, 526: 68, 536: 50, 556: 50, 561: 20, 566: 20, 573: 40,
    581: 40, 589: 0, 600: 0,
}
# from, s: to, s, radius, m; a left turn is positive
TURNS = {
    16: (19, -10.0), 31: (34, 10.0), 85: (93, -300.0), 147: (149, -18.0), 150: (154, 14.0), 155: (157, -18.0),
    245: (251, 130.0), 292: (297, -95.0), 299: (304, 95.0), 325: (337, -400.0), 365: (370, 9.0),
    391: (401, -90.0), 436: (450, 1200.0), 460: (478, -1500.0), 515: (525, -110.0), 562: (565, 10.0),
}


def main():
    time = np.arange(0.0, 601.0)
    speed = smooth(np.interp(time, list(SPEED), np.array(list(SPEED.values())) / 3.6))
    curvature = np.zeros_like(time)
    for begin, (end, radius) in TURNS.items():
        curvature += np.interp(time, [begin - 1, begin, end, end + 1], [0.0, 1.0 / radius, 1.0 / radius, 0.0])
    moving = speed > 0.0
    force = TURNING * MASS * np.gradient(speed, time) + moving * ROLLING * MASS * GRAVITY + 0.5 * AIR * DRAG * speed**2
    torque = np.maximum(force * RADIUS, np.interp(speed, [CREEPS, BRAKES], [CREEP, ENGINE_BRAKING]))
    left, right = (speed * (1.0 + side * curvature * TRACK / 2.0) / RADIUS for side in (-1.0, 1.0))
    print(f"{np.trapezoid(speed, time) / 1e3:.1f} km, {speed.max() * 3.6:.0f} km/h, {torque.min():.0f} to {torque.max():.0f} N.m, "
          f"at most {np.abs(speed**2 * curvature).max():.1f} m/s2 to the side")
    rows = [f"{t:g},{m:.0f},{a:.2f},{b:.2f}\n" for t, m, a, b in zip(time, torque, left, right)]
    FILE.write_text(HEAD + "".join(rows), encoding="utf-8", newline="\n")


def smooth(values):
    """Moving weighted mean of `values`."""
    ends = len(SMOOTHING) // 2
    return np.convolve(np.pad(values, ends, mode="edge"), SMOOTHING, mode="valid")


HEAD = f"""\
# ten minutes of a car: town, country road from 204 s, motorway from 390 s, back into town at 536 s; by docs/scripts/drive_cycle.py
# {MASS:g} kg, wheels of {RADIUS:g} m, track {TRACK:g} m, air {DRAG:g} m2, rolling resistance {ROLLING:g}; an automatic creeps
# with {CREEP:g} N.m, the engine brakes with {-ENGINE_BRAKING:g} N.m, brakes at the wheels do the rest
time [s],carrier.torque_command [N·m],left.speed_command [rad/s],right.speed_command [rad/s]
"""

if __name__ == "__main__":
    main()
