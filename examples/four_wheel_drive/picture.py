"""Picture of the launch: wheel speeds, torques of the shafts and speed of the car."""

from math import pi

from bevel_differential import style

from car import NAMES, STEP

# rpm for 1 rad/s
RPM = 30.0 / pi
# distance of the dots, in points of the record
DOT = 25
PANELS = {
    "wheel speed, rpm": {"front left wheel, on ice": ("front_left.speed", RPM), "rear left wheel, on ice": ("rear_left.speed", RPM),
                         "each right wheel, on dry road": ("rear_right.speed", RPM)},
    "torque, N·m": {"each propeller shaft": ("rear.propeller_torque", 1.0), "each front half-shaft": ("front_left.shaft_torque", 1.0),
                    "each rear half-shaft": ("rear_left.shaft_torque", 1.0)},
    "speed of the car, m/s": {"car": ("body.speed", 1.0)},
}


def draw(times, units, right, file):
    """Draws values of `NAMES` at `times`: lines are one integration of all equations, dots are the coupled units."""
    style.apply()
    figure, axes = style.panels(len(PANELS), 1, 10.0, sharex=True)
    for axis, (label, lines) in zip(axes, PANELS.items()):
        for name, (value, factor) in lines.items():
            k = NAMES.index(value)
            line, = axis.plot(times, factor * right[:, k], label=name)
            axis.plot(times[::DOT], factor * units[::DOT, k], ".", color=line.get_color(), markersize=7)
        axis.set_ylabel(label)
        if len(lines) > 1:
            axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes[0].set_title("Launch with four-wheel drive: left wheels on ice, right wheels on dry road")
    axes[-1].set(xlabel="time, s", xlim=(0.0, times[-1]))
    style.caption(figure, "All three differentials are open, so the ice under the left wheels limits the torque of every shaft, and front and rear "
                  "half-shafts transmit the same torque. The left wheels spin, and the right ones roll with the car. After 0.8 s, the driver "
                  "releases the pedal. Around 1.1 s and 1.3 s, a left wheel grips again, and the shafts swing. Lines: one integration of all "
                  f"equations. Dots: three coupled units in steps of {1e3 * STEP:g} ms. Ideal gears.")
    style.save(figure, file)
