"""Pictures of contact patterns, from the files of the command."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from .. import style
from ..records import read

PRESSURE, LOAD, CENTROID = "magma_r", style.BLUE, style.RED
# remarks on the cases of the documentation
REMARKS = {
    "aligned": "even load; dark band: only one pair is loaded",
    "crowned": "load moves from both ends to the middle",
    "angle_wide": "even along the face; less load at the root",
    "angle_narrow": "even along the face; more load at the root",
    "planet_out": "to the heel, and from the tip to the root",
    "planet_in": "to the toe, and from the root to the tip",
    "side_out": "to the heel, and from the root to the tip",
    "side_in": "to the toe, and from the tip to the root",
    "pin_ahead": "more load, and it moves to the toe",
    "pin_behind": "less load, and it moves to the heel",
    "hypoid_forward": "planet 1 carries twice its share, at the toe",
    "hypoid_backward": "drive flank free, coast flank jams at the toe",
}
# kinds of teeth, for captions
TEETH = {"solid": "solid teeth", "impact": "teeth with contact.law = impact", "line": "teeth with contact.law = line",
         "line_weber": "teeth with contact.law = line_weber"}
# cases whose lines of contact are drawn; the first two available ones count
LINES = ["aligned", "hypoid_forward", "planet_out"]
INSTANTS = 6
# relative radius of the flanks over its value at the pitch point, below which the foot is a seam (as in the report and on the page)
LEAST_RADIUS = 0.25
COLUMNS = 3
# smallest half-width of a line of contact in the picture, mm
THINNEST = 0.12
# height for the legend above the panels, inches
LEGEND = 0.4


def draw(folder: Path) -> list[str]:
    """Draws the patterns whose files are in `folder`. Returns the names of the pictures."""
    data = {name: read(folder / f"{name}.csv")[1] for name in ["pattern", "contacts", "summary", "outline"]}
    outlines = {}
    for row in data["outline"]:
        outlines.setdefault(row["case"], {})[row["mark"]] = row
    cases = [(row["case"], row["title"]) for row in data["summary"]]
    patterns(folder, data, outlines, cases)
    lines(folder, data, outlines, cases)
    return ["contact_pattern.png", "contact_lines.png"]


def tooth(axes, outline, names=False):
    """Draws the unrolled flank: toe left, heel right, tip at the top, pitch line at zero."""
    toe, heel = outline["tip"]["toe_cone"], outline["tip"]["heel_cone"]
    corners = [(toe, outline["root"]["toe_height"]), (heel, outline["root"]["heel_height"]),
               (heel, outline["tip"]["heel_height"]), (toe, outline["tip"]["toe_height"])]
    axes.add_patch(plt.Polygon(corners, closed=True, fill=False, ec=style.TEXT, lw=1.3, zorder=4))
    marks = [("pitch", "-.", "pitch line"), ("base", ":", "base circle: end of the involute"),
             ("start", "--", "rigid contact begins")]
    for mark, line, name in marks:
        row = outline[mark]
        axes.plot([toe, heel], [row["toe_height"], row["heel_height"]], ls=line, color=style.TEXT, lw=0.9, zorder=4,
                  label=name)
    if names:
        axes.text(toe - 0.25, 0.0, "toe", rotation=90, ha="right", va="center", fontsize=9.5)
        axes.text(heel + 0.25, 0.0, "heel", rotation=90, ha="left", va="center", fontsize=9.5)
        axes.text(0.5 * (toe + heel), 0.5 * (outline["tip"]["toe_height"] + outline["tip"]["heel_height"]) + 0.35,
                  "tip", ha="center", fontsize=9.5)
    axes.set(xlim=(toe - 1.3, heel + 1.3), ylim=(outline["root"]["heel_height"] - 0.3,
                                                 outline["tip"]["heel_height"] + 0.4))
    axes.set_aspect("equal")
    axes.grid(False)


def patterns(folder, data, outlines, cases):
    columns = min(COLUMNS, len(cases))
    rows = -(-len(cases) // columns)
    height = {1: 6.8, 2: 4.8, 3: 3.55}[columns]
    figure = style.figure(height * rows + 2.2)
    # rows of the grid: flank, line load, and a gap above the title of the next case
    # a single flank gets margins, so that its load curve below it has the same width
    margins = 1 if columns == 1 else 0
    grid = figure.add_gridspec(3 * rows, columns + 2 * margins, height_ratios=[2.6, 1, 0.3] * rows,
                               width_ratios=[0.4, 1, 0.4] if margins else None)
    most_load = max(max(load for _, load in strip(data, name)) for name, _ in cases)
    scale, first = plt.Normalize(0.0, top_of(data, cases)), None
    for i, (name, title) in enumerate(cases):
        row, column = divmod(i, columns)
        axes = figure.add_subplot(grid[3 * row, column + margins])
        first = first or axes
        result = next(one for one in data["summary"] if one["case"] == name)
        flank(axes, outlines[name], [one for one in data["pattern"] if one["case"] == name], scale)
        axes.set_title(f"{title} ({result['flank']} flank)", fontsize=11.5, loc="left", pad=19)
        style.note(axes, 0.0, 1.07, REMARKS.get(name, ""), ha="left", fontsize=style.SMALL)
        below = figure.add_subplot(grid[3 * row + 1, column + margins], sharex=axes)
        line_load(below, outlines[name]["tip"], np.array(strip(data, name)), result, most_load)
        if column == 0:
            axes.set_ylabel("height, mm")
            below.set_ylabel("N/mm")
        if i >= len(cases) - columns:
            below.set_xlabel("cone distance R, mm")
    bar = figure.colorbar(plt.cm.ScalarMappable(scale, PRESSURE), ax=figure.axes, orientation="horizontal", shrink=0.5,
                          aspect=50, extend="max", pad=0.01)
    bar.set_label("largest Hertz pressure of the engagement, MPa")
    legend(figure, first)
    is_study = REMARKS.keys() >= dict(cases).keys()
    where = "the study's turn (835 N·m on each half-shaft)" if is_study else "the given scenes"
    errors = ("Offsets bring one end of the face into contact first, and the load moves there; an error of the shaft angle turns the "
              "gears about their common apex, and all sections change alike. A pin out of place loads one planet and unloads the "
              "opposite one. ") if is_study else ""
    style.caption(figure, f"Contact patterns of planet 1 with the left side gear in {where}, {teeth_of(data)}. The planet's flank is a "
                  "trapezoid with the small end (toe) left; colour is the largest pressure at each spot while one pair goes from "
                  "first touch to parting, as marking compound would show it. One scale for all panels; only the seam at the base "
                  "circle exceeds it, as the flank has no radius there. Blue: line load over the face while the pair is nearest to "
                  f"the pitch line. Red: the pair's force and its centroid, measured from mid-face toward the heel. {errors}Where a "
                  "tip corner carries, the pressure is calculated with the flanks' radii; the true one is higher.", LEGEND)
    style.save(figure, folder / "contact_pattern.png")


def teeth_of(data):
    """Kinds of teeth in all cases, for captions."""
    return " or ".join(dict.fromkeys(TEETH[row["teeth"]] for row in data["summary"]))


def flank(axes, outline, rows, scale):
    """Draws the flank with the largest pressure at each position."""
    cones = sorted({row["cone"] for row in rows})
    shape = (len(cones), len(rows) // len(cones))
    cone, height, pressure = [np.array([row[key] for row in rows]).reshape(shape) for key in ["cone", "height", "pressure"]]
    axes.pcolormesh(cone, height, np.ma.masked_less(pressure, 1.0), cmap=PRESSURE, norm=scale, shading="gouraud")
    tooth(axes, outline, True)
    axes.tick_params(labelbottom=False)


def line_load(axes, tip, points, result, most):
    """Draws the load over the face, and the force at its centroid."""
    axes.fill_between(*points.T, color=LOAD, alpha=0.25, lw=0)
    axes.plot(*points.T, color=LOAD, lw=1.5)
    middle = 0.5 * (tip["toe_cone"] + tip["heel_cone"])
    centroid = middle + result["centroid"]
    axes.axvline(centroid, color=CENTROID, lw=1.3)
    axes.text(centroid + 0.15, 1.4 * most, f"{result['force']:.1f} kN, {round(result['centroid'], 1) + 0.0:+.1f} mm",
              color=CENTROID, fontsize=style.SMALL, va="top")
    axes.set(ylim=(0, 1.45 * most))


def legend(figure, axes):
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=3, bbox_to_anchor=(0.5, 1.0))


def top_of(data, cases):
    """Upper end of the colours, MPa: the largest pressure outside the seam at the foot, where the flanks' radius vanishes."""
    shown = [row for row in data["contacts"] if row["followed"] and row["case"] in dict(cases)]
    # relative radii per cone distance; the contact nearest to the pitch point gives the value there
    pitch = min(shown, key=lambda row: abs(row["s"]))
    least = LEAST_RADIUS * pitch["radius"] / pitch["cone"]
    sound = [row["pressure"] for row in shown if row["radius"] / row["cone"] > least and not row["corner"]]
    return 100.0 * np.ceil(max(sound or [row["pressure"] for row in shown]) / 100.0)


def strip(data, name):
    """Cone distance and line load at the time nearest to the pitch point."""
    rows = [row for row in data["contacts"] if row["case"] == name and row["followed"]]
    time = min(rows, key=lambda row: abs(row["s"]))["time"]
    return [(row["cone"], row["line_load"]) for row in rows if row["time"] == time]


def lines(folder, data, outlines, cases):
    names = dict(cases)
    chosen = [name for name in LINES if name in names][:2] or [name for name, _ in cases][:2]
    figure, grid = style.panels(INSTANTS, len(chosen), 2.4 * INSTANTS + 1.8, squeeze=False, sharex=True, sharey=True)
    colours, scale = plt.get_cmap(PRESSURE), plt.Normalize(0.0, top_of(data, cases))
    for column, name in enumerate(chosen):
        rows = [row for row in data["contacts"] if row["case"] == name]
        followed = sorted({row["time"] for row in rows if row["followed"]})
        picks = [followed[round(i * (len(followed) - 1) / (INSTANTS - 1))] for i in range(INSTANTS)]
        for i, time in enumerate(picks):
            axes = grid[i, column]
            tooth(axes, outlines[name], i == 0)
            now = [row for row in rows if row["time"] == time]
            for pair in sorted({(row["planet_tooth"], row["side_tooth"]) for row in now}):
                line = [row for row in now if (row["planet_tooth"], row["side_tooth"]) == pair]
                draw_line(axes, line, lambda pressure: colours(scale(pressure)), 20 if i == 0 else 5)
            share = (time - picks[0]) / ((picks[-1] - picks[0]) or 1.0)
            axes.set_title(f"{names[name]}, {100.0 * share:.0f} % of the engagement, {1e-3 * force_of(now):.1f} kN in all",
                           fontsize=11, loc="left")
    for axes in grid[:, 0]:
        axes.set_ylabel("height, mm")
    for axes in grid[-1]:
        axes.set_xlabel("cone distance R, mm")
    tips = [outlines[name]["tip"] for name in chosen]
    for axes in grid.flat:
        axes.set_xlim(min(tip["toe_cone"] for tip in tips) - 1.3, max(tip["heel_cone"] for tip in tips) + 7.5)
    bar = figure.colorbar(plt.cm.ScalarMappable(scale, colours), ax=grid, shrink=0.5, aspect=40, pad=0.01, extend="max",
                          panchor=False if len(chosen) == 1 else (1.0, 0.5))
    bar.set_label("Hertz pressure, MPa")
    legend(figure, grid[0, 0])
    # only for the turn of the documentation
    spin = ("In this direction of spin contact moves from the root of the planet's tooth to its tip; a pair begins with the tip corner of "
            "the side gear and ends with its own. ") if names.keys() <= REMARKS.keys() else ""
    style.caption(figure, "Lines of contact on the planet's flank while one pair goes from first touch (top) to parting (bottom), "
                  f"{teeth_of(data)}, with the loads of all pairs of the mesh, drawn on one flank. Teeth are straight, so a line runs along "
                  f"a ray through the apex. Strips thinner than {2.0 * THINNEST:g} mm are drawn that wide. {spin}White marks: centroid of "
                  "each line's load, a circle for the pair that is followed and a square for its neighbours.", LEGEND)
    style.save(figure, folder / "contact_lines.png")


def draw_line(axes, line, colour, indent):
    """Draws the line of contact of one pair with its force. The line is as wide as the contact, or the smallest visible width."""
    for row in line:
        half = max(row["half_width"], THINNEST)
        ends = [row["cone"] - 0.5 * row["width"], row["cone"] + 0.5 * row["width"]]
        heights = [row["planet_height"] * end / row["cone"] for end in ends]
        corners = [(ends[k], heights[k] + side * half) for k, side in [(0, -1), (1, -1), (1, 1), (0, 1)]]
        axes.add_patch(plt.Polygon(corners, lw=0.4, color=colour(row["pressure"])))
    force = force_of(line)
    centre = sum(row["line_load"] * row["width"] * row["cone"] for row in line) / force
    height = np.interp(centre, [row["cone"] for row in line], [row["planet_height"] for row in line])
    own = bool(line[0]["followed"])
    axes.plot(centre, height, ls="", marker="o" if own else "s", mfc="white", mec=CENTROID, ms=6, zorder=6)
    name = f"{'this pair' if own else 'neighbour'} {1e-3 * force:.1f} kN{', tip corner' if line[0]['corner'] else ''}"
    axes.annotate(name, (line[-1]["cone"] + 0.5 * line[-1]["width"], line[-1]["planet_height"]), xytext=(indent, 0),
                  textcoords="offset points", fontsize=9.5, va="center", annotation_clip=False)


def force_of(rows):
    """Force of the rows, N."""
    return sum(row["line_load"] * row["width"] for row in rows)
