"""Ripple of the side gears' speeds in the study's turn, against contact constants; writes docs/figures/ripple.png.

usage, from the top of the repository, after `cargo run --release`:
    target/python/bin/python docs/scripts/ripple.py [FMU]

Prints the table of docs/study.md. The FMU gives all columns except the last two.
"""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "python" / "src"))
from bevel_differential import Differential, style  # noqa: E402

FIGURES = ROOT / "docs" / "figures"
FMU = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "target" / "fmu" / "BevelDifferential.fmu")

# the study's turn
CARRIER, SPIN, LOAD = 954.0, 200.0, 835.0  # deg/s, deg/s, N.m
Z_P, Z_S, MODULE, FACE, ALPHA = 10, 16, 4.5e-3, 20e-3, np.radians(20.0)
STIFFNESS, DAMPING = 5.77e5 * 1e3**1.5, 5e4  # N/m^1.5, N.s/m
LINE = 14e9  # N/m², a single pair of steel teeth by ISO 6336-1: 14 N/(mm·µm)
PERIOD = 360.0 / (Z_P * SPIN)  # s, one tooth
DIFFERENCE = SPIN * Z_P / Z_S  # deg/s
SIDES = [("left", CARRIER + DIFFERENCE), ("right", CARRIER - DIFFERENCE)]

# geometry, ISO 23509 symbols
PITCH_P = np.arctan2(Z_P, Z_S)
PITCH_S = np.pi / 2 - PITCH_P
R_E = MODULE * Z_P / (2 * np.sin(PITCH_P))
R_M = R_E - FACE / 2
BASE_P, BASE_S = (np.arcsin(np.sin(d) * np.cos(ALPHA)) for d in (PITCH_P, PITCH_S))
ADDENDUM_S = (0.540 + 0.460 / (Z_S / Z_P) ** 2) * MODULE  # Gleason, u_v = (z_s/z_p)² at 90°
TIP_P, TIP_S = (d + np.arctan2(h, R_E) for d, h in ((PITCH_P, 2 * MODULE - ADDENDUM_S), (PITCH_S, ADDENDUM_S)))


def gap(delta, pitch, base, tip, mate_pitch, mate_base):
    """Gap of a tip corner to the mate's flank, the arc Δ past the end of the path [rad]; docs/inside/theory.md."""
    arc = lambda b, polar: np.arccos(np.cos(polar) / np.cos(b))  # noqa: E731
    inv = lambda b, polar: arc(b, polar) / np.sin(b) - np.arctan2(np.tan(arc(b, polar)), np.sin(b))  # noqa: E731
    at_end, at_pitch = (np.arctan2(np.tan(arc(base, polar)), np.sin(base)) for polar in (tip, pitch))
    chi = at_end - at_pitch + delta / np.sin(base)
    eta = np.arctan2(np.sin(chi) * np.sin(tip), np.cos(tip))  # about the mate's axis, at 90° to the gear's
    polar = np.arccos(np.cos(chi) * np.sin(tip))
    turn = eta - inv(mate_base, polar) + inv(mate_base, mate_pitch)
    return arc(base, tip) - arc(base, pitch) + delta - np.sin(mate_base) * turn


DELTA = np.linspace(0.0, 0.12, 24001)
GAP_P = gap(DELTA, PITCH_P, BASE_P, TIP_P, PITCH_S, BASE_S)
GAP_S = gap(DELTA, PITCH_S, BASE_S, TIP_S, PITCH_P, BASE_P)


def quasi_static(te_one, exponent):
    """Ripple, peak to peak [%], of massless, undamped teeth whose single pair bends by te_one [m]."""
    one = te_one / R_M
    arc = np.linspace(0.0, 1.3 * np.interp(one, GAP_P, DELTA), 4001)
    approach = np.linspace(0.5 ** (1 / exponent), 1.0, 801)[1:-1] * one
    # force balance with a corner pair: a^e + (a − g)^e (1 − λ) = one^e. At the planet's tip λ = 0; at the side gear's tip λ = g′,
    # because its corner moves with the approach a: Δ = s_lo − s + a
    slopes = []
    for full, rides in (GAP_P, 0.0), (GAP_S, 1.0):
        table = np.interp(arc, DELTA, full)
        slope = np.interp(arc, DELTA, np.gradient(full, DELTA))
        load = lambda a: a**exponent + np.maximum(a - table, 0.0) ** exponent * (1 - rides * slope) - one**exponent  # noqa: E731
        delta = np.empty_like(approach)
        for i, a in enumerate(approach):
            crossing = np.flatnonzero(load(a)[1:] < 0.0)[0]
            low, high = load(a)[crossing], load(a)[crossing + 1]
            delta[i] = arc[crossing] + (arc[1] - arc[0]) * low / (low - high)
        slopes.append(np.max(np.gradient(approach, delta - rides * approach)))
    return [100.0 * DIFFERENCE / speed * sum(slopes) for _, speed in SIDES]


def steepest(exponent):
    """Steepest growth κ of the deflection as a corner leaves, dimensionless: max dy/du of y^e + (y − u²)^e = 1."""
    u = np.linspace(0.0, 1.0, 2001)[:-1]
    low, high = np.maximum(u**2, 0.5 ** (1 / exponent)), np.ones_like(u)
    for _ in range(60):
        y = 0.5 * (low + high)
        above = y**exponent + np.maximum(y - u**2, 0.0) ** exponent > 1.0
        high, low = np.where(above, y, high), np.where(above, low, y)
    v, w = y ** (exponent - 1), np.maximum(y - u**2, 1e-300) ** (exponent - 1)
    return float(np.max(2 * u * w / (v + w)))


def square_root(te_one, exponent):
    """Ripple by the short formula κ √(a₁ c). The coefficient c = g/Δ² is taken at a gap equal to the single pair's approach a₁."""
    one = te_one / R_M
    slope = steepest(exponent) * sum(one / np.interp(one, table, DELTA) for table in (GAP_P, GAP_S))
    return [100.0 * DIFFERENCE / speed * slope for _, speed in SIDES]


def turn(changes, step=1e-4):
    """Returns a record of the turn with changed start values, from the end of the first tooth on."""
    values = {"scene.planet_spin": "imposed", "spin.command": (SPIN, "deg/s"), "carrier.speed_command": (CARRIER, "deg/s")}
    outputs = [f"{side}.speed" for side, _ in SIDES] + ["planet[1].left_transmission_error"]
    with Differential(values | changes, fmu=FMU) as differential:
        record = differential.run(outputs=outputs, stop=3 * PERIOD, step=step)
    return record[record["time"] > PERIOD]


def measured(changes, step=1e-4):
    """Deflection with one and with two pairs [m], ripple of both sides peak to peak [%]."""
    record = turn(changes, step)
    error = record["planet[1].left_transmission_error"]
    ripple = [100.0 * np.ptp(np.degrees(record[f"{side}.speed"])) / speed for side, speed in SIDES]
    return np.max(error), np.min(error), ripple


def per_pair_force():
    """Normal force of a mesh [N]."""
    return LOAD / (2 * R_M * np.sin(BASE_S))


def variants():
    """Rows of the table: name, changed start values, exponent, output interval [s]."""
    yield "the study's constants", {}, 1.5, 1e-4
    for factor in [0.25, 4, 16, 64]:
        yield f"K × {factor:g}", {"contact.stiffness": STIFFNESS * factor}, 1.5, 1e-4
    for factor in [0.1, 10, 0]:
        yield f"C × {factor:g}", {"contact.damping": DAMPING * factor}, 1.5, 1e-4
    # the same force at the study's single-pair deflection
    force = per_pair_force()
    depth = (force / STIFFNESS) ** (1 / 1.5)
    for exponent in [1.0, 2.0]:
        yield f"e = {exponent:g}, same force at {depth * 1e6:.1f} µm", {
            "contact.exponent": exponent, "contact.stiffness": force / depth**exponent}, exponent, 1e-4
    yield f"e = 1, K = c′b = {LINE * FACE:.1e} N/m", {
        "contact.exponent": 1.0, "contact.stiffness": LINE * FACE}, 1.0, 1e-4
    yield "4 planets", {"geometry.planet_count": 4}, 1.5, 1e-4
    yield "half the load", {"left.load_torque": LOAD / 2, "right.load_torque": LOAD / 2}, 1.5, 1e-4
    yield "all speeds × 10", {"carrier.speed_command": (CARRIER * 10, "deg/s"),
                              "spin.command": (SPIN * 10, "deg/s")}, 1.5, 1e-5
    # contact laws that follow from the tooth shape; the two formulas do not apply to them
    for law in ["line", "line_weber"]:
        yield f"law `{law}`", {"contact.law": law}, None, 1e-4
    yield "`line_weber`, elastic bodies", {"contact.law": "line_weber", "effects.body_compliance": True}, None, 1e-4
    bores = {"contact.law": "line_weber", "effects.body_compliance": True, "geometry.planet_bore": 16e-3,
             "geometry.side_bore": 30e-3}
    yield "`line_weber`, elastic bodies on bores ⌀ 16/30 mm", bores, None, 1e-4
    relief = {"effects.tooth_errors": True, "tooth_errors.planet_tip_relief": 30e-6, "tooth_errors.side_tip_relief": 30e-6}
    yield "the same with tip relief of 30 µm", bores | relief, None, 1e-4
    yield "no corner contact", {"effects.corner_contact": False}, 1.5, 2e-6


def both(values):
    return "{:.2f} / {:.2f}".format(*values)


def main():
    style.apply()
    print("| variant | TE₁, µm | TE₂, µm | ripple measured, % | quasi-static, % | formula, % |")
    print("|---|---:|---:|---:|---:|---:|")
    points = []
    for name, changes, exponent, step in variants():
        one, two, ripple = measured(changes, step)
        if "speeds" in name:  # in per cent of the case's own speeds
            ripple = [r / 10 for r in ripple]
        calculated = ["–", "–"]
        if exponent and "corner" not in name:
            calculated = [both(rule(one, exponent)) for rule in (quasi_static, square_root)]
            points.append((name, exponent, one, ripple[0]))
        print(f"| {name} | {one * 1e6:.1f} | {two * 1e6:.1f} | {both(ripple)} | "
              f"{calculated[0]} | {calculated[1]} |", flush=True)
    print("κ(e):", {e: round(steepest(e), 3) for e in [1.0, 1.5, 2.0]})
    print("c at the study's deflection, planet's and side gear's tip:",
          [float(round(a / np.interp(a, t, DELTA) ** 2, 3)) for t in (GAP_P, GAP_S) for a in [depth_of_study() / R_M]])
    draw(points)


def depth_of_study():
    return (per_pair_force() / STIFFNESS) ** (1 / 1.5)


def draw(points):
    figure, (errors, speeds, rule) = style.panels(1, 3, 5.2)
    left = SIDES[0][1]
    for name, factor in [("study's K", 1), ("K × 4", 4), ("K × 16", 16)]:
        record = turn({"contact.stiffness": factor * STIFFNESS})
        record = record[record["time"] < 2 * PERIOD]
        time = 1e3 * (record["time"] - PERIOD)
        errors.plot(time, 1e6 * record["planet[1].left_transmission_error"], label=name)
        speeds.plot(time, 100 * (np.degrees(record["left.speed"]) / left - 1), label=name)
    errors.set(xlabel="time in one tooth cycle, ms", ylabel="transmission error, left, µm", ylim=(0, None), xlim=(0, 1e3 * PERIOD),
               title="Deflection: one pair, two pairs")
    speeds.set(xlabel="time in one tooth cycle, ms", ylabel="deviation of the left speed, %", xlim=(0, 1e3 * PERIOD),
               title="Ripple: its rate of change")
    errors.legend(loc="center", bbox_to_anchor=(0.42, 0.43))
    speeds.legend(loc="upper right")
    deflections = np.geomspace(4, 300, 16) * 1e-6
    # the study's exponent in the colour of the study's stiffness
    for exponent, color in [(1.0, style.RED), (1.5, style.BLUE), (2.0, style.GREEN)]:
        rule.loglog(deflections * 1e6, [quasi_static(one, exponent)[0] for one in deflections], color=color,
                    label=f"quasi-static, e = {exponent:g}")
        chosen = [(one, ripple) for name, e, one, ripple in points if e == exponent and name != "C × 0"]
        rule.loglog([one * 1e6 for one, _ in chosen], [ripple for _, ripple in chosen], "o", color=color, markersize=6)
    for ticks, axis in [([0.2, 0.5, 1, 2], rule.yaxis), ([5, 10, 20, 50, 100, 200], rule.xaxis)]:
        axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.set_ticks([], minor=True)
    rule.set(xlabel="deflection of a single pair, µm", ylabel="ripple, left, peak to peak, %", title="Points: through the FMU")
    rule.legend(loc="upper left")
    style.caption(figure, "Ripple in the study's turn. Left: one pair of teeth bends more than two, and stiffer teeth bend less. Middle: the "
                  "speed leaves its mean only while the deflection changes, as a tip corner hands the load over. Right: ripple grows "
                  "with about the square root of the deflection; lines are calculated from the tooth form for massless, undamped teeth "
                  "with contact exponent e, points are measured with other stiffness, damping, exponent, load and number of planets.")
    style.save(figure, FIGURES / "ripple.png")


if __name__ == "__main__":
    main()
