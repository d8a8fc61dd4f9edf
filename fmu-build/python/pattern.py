"""Draws contact patterns from the CSV files of `fmu-build pattern`.

usage: pattern.py FOLDER
"""

import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from figures import caption, save

INK, LOAD, EDGE = "magma_r", "#1f6fb4", "#d1495b"
# what to see in the cases of the documentation
SEEN = {
    "aligned": "even load; dark band: one pair alone carries",
    "crowned": "load leaves both ends for the middle",
    "angle_wide": "even along the face; foot of the flank relieved",
    "angle_narrow": "even along the face; foot of the flank strained",
    "planet_out": "to the heel, and from the tip to the foot",
    "planet_in": "to the toe, and from the foot to the tip",
    "side_out": "to the heel, and from the foot to the tip",
    "side_in": "to the toe, and from the tip to the foot",
    "pin_ahead": "more load, and it moves to the toe",
    "pin_behind": "less load, and it moves to the heel",
    "hypoid_forward": "planet 1 bears twice its share, at the toe",
    "hypoid_backward": "drive flank bare, coast flank jams at the toe",
}
# cases whose lines of contact are drawn, the first ones that are there
LINES = ["aligned", "hypoid_forward", "planet_out"]
INSTANTS = 6
COLUMNS = 3
# pressure beyond which colours no longer differ, MPa: only spots near the base circle see more when aligned
TOP = 4000.0
# inches above the axes for the legend
LEGEND = 0.35


def main():
    folder = Path(sys.argv[1])
    data = {name: read(folder / f"{name}.csv") for name in ["pattern", "contacts", "summary", "outline"]}
    outlines = {}
    for row in data["outline"]:
        outlines.setdefault(row["case"], {})[row["mark"]] = row
    cases = [(row["case"], row["title"]) for row in data["summary"]]
    patterns(folder, data, outlines, cases)
    lines(folder, data, outlines, cases)


def read(path):
    rows = csv.DictReader(line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return [{key: number(value) for key, value in row.items()} for row in rows]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def tooth(axes, outline, names=False):
    """The flank unrolled: toe left, heel right, tip above, pitch line at zero."""
    toe, heel = outline["tip"]["toe_cone"], outline["tip"]["heel_cone"]
    corners = [(toe, outline["root"]["toe_height"]), (heel, outline["root"]["heel_height"]),
               (heel, outline["tip"]["heel_height"]), (toe, outline["tip"]["toe_height"])]
    axes.add_patch(plt.Polygon(corners, closed=True, fill=False, ec="#333333", lw=1.3, zorder=4))
    marks = [("pitch", "-.", "pitch line"), ("base", ":", "base circle: end of the involute"),
             ("start", "--", "rigid contact begins")]
    for mark, style, name in marks:
        row = outline[mark]
        axes.plot([toe, heel], [row["toe_height"], row["heel_height"]], ls=style, color="#333333", lw=0.9, zorder=4,
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
    height = {1: 6.6, 2: 4.6, 3: 3.35}[columns]
    figure = plt.figure(figsize=(13, height * rows + 1.8), layout="constrained")
    grid = figure.add_gridspec(2 * rows, columns, height_ratios=[2.6, 1] * rows)
    most_load = max(max(load for _, load in strip(data, name)) for name, _ in cases)
    top = top_of(data, cases)
    shown, first = None, None
    for i, (name, title) in enumerate(cases):
        axes = figure.add_subplot(grid[2 * (i // columns), i % columns])
        outline = outlines[name]
        seen = [row for row in data["pattern"] if row["case"] == name]
        cones = sorted({row["cone"] for row in seen})
        shape = (len(cones), len(seen) // len(cones))
        cone, height, pressure = [np.array([row[key] for row in seen]).reshape(shape)
                                  for key in ["cone", "height", "pressure"]]
        pressure = np.ma.masked_less(pressure, 1.0)
        shown = axes.pcolormesh(cone, height, pressure, cmap=INK, vmin=0.0, vmax=top, shading="gouraud")
        tooth(axes, outline, True)
        row = next(row for row in data["summary"] if row["case"] == name)
        axes.set_title(f"{title} ({row['flank']} flank)", fontsize=10.5, loc="left", pad=17)
        axes.text(0.0, 1.02, SEEN.get(name, ""), transform=axes.transAxes, fontsize=9, color="#333333")
        axes.tick_params(labelbottom=False)
        first = first or axes
        below = figure.add_subplot(grid[2 * (i // columns) + 1, i % columns], sharex=axes)
        at, load = np.array(strip(data, name)).T
        below.fill_between(at, load, color=LOAD, alpha=0.25, lw=0)
        below.plot(at, load, color=LOAD, lw=1.5)
        middle = 0.5 * (outline["tip"]["toe_cone"] + outline["tip"]["heel_cone"])
        below.axvline(middle + row["centroid"], color=EDGE, lw=1.3)
        told = f"{row['force']:.1f} kN, {round(row['centroid'], 1) + 0.0:+.1f} mm"
        below.text(middle + row["centroid"] + 0.15, 1.18 * most_load, told, color=EDGE, fontsize=9, va="top")
        below.set(ylim=(0, 1.25 * most_load))
        if i % columns == 0:
            axes.set_ylabel("height, mm")
            below.set_ylabel("N/mm")
        if i >= len(cases) - columns:
            below.set_xlabel("cone distance R, mm")
    bar = figure.colorbar(shown, ax=figure.axes, orientation="horizontal", shrink=0.5, aspect=50, extend="max",
                          pad=0.01)
    bar.set_label("largest Hertz pressure of the engagement, MPa")
    handles, labels = first.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=3, bbox_to_anchor=(0.47, 1.0), fontsize=10)
    where = "the study's turn (835 N·m on each half-shaft)" if documented(cases) else "scenes of your own"
    caption(figure, f"Contact patterns of planet 1 with the left side gear in {where}, solid teeth: the planet's flank as a "
            "trapezoid, small end (toe) left, and what pressure each spot of it sees while one pair goes from first "
            "touch to parting: the ink that an assembler "
            "would find rubbed off. Colour: one scale for all; the darkest seam at the base circle is beyond it, as the "
            "flank has no radius there. Blue: line load over the face when the pair touches at the pitch line; red: the "
            "pair's force and its centroid, from mid-face toward the heel. Offsets bring one end of the face together "
            "before the other, and the load goes there; an error of the shaft angle turns the gears about their common "
            "apex, to which every section is alike. A pin that is off loads one planet and unloads the one opposite. "
            "Where a tip corner bears, its pressure is told with the flanks' radii and is more.", LEGEND)
    save(figure, folder, "contact_pattern")


def documented(cases):
    return all(name in SEEN for name, _ in cases)


def top_of(data, cases):
    """Upper end of the colours, MPa: that of the documentation, or what but few spots of the user's scenes exceed."""
    if documented(cases):
        return TOP
    found = [row["pressure"] for row in data["pattern"] if row["pressure"] > 0.0]
    return 100.0 * np.ceil(np.percentile(found, 97.0) / 100.0)


def strip(data, name):
    """Cone distance and line load at the instant nearest to the pitch point."""
    rows = [row for row in data["contacts"] if row["case"] == name and row["followed"]]
    time = min(rows, key=lambda row: abs(row["s"]))["time"]
    return [(row["cone"], row["line_load"]) for row in rows if row["time"] == time]


def lines(folder, data, outlines, cases):
    names = dict(cases)
    chosen = [name for name in LINES if name in names][:2] or [name for name, _ in cases][:2]
    figure, grid = plt.subplots(INSTANTS, len(chosen), figsize=(13, 2.35 * INSTANTS + 1.2), layout="constrained",
                                squeeze=False, sharex=True, sharey=True)
    colours, scale = plt.get_cmap(INK), plt.Normalize(0.0, top_of(data, cases))
    for column, name in enumerate(chosen):
        outline = outlines[name]
        rows = [row for row in data["contacts"] if row["case"] == name]
        followed = sorted({row["time"] for row in rows if row["followed"]})
        picks = [followed[round(i * (len(followed) - 1) / (INSTANTS - 1))] for i in range(INSTANTS)]
        for i, time in enumerate(picks):
            axes = grid[i, column]
            tooth(axes, outline, i == 0)
            now = [row for row in rows if row["time"] == time]
            whole = sum(row["line_load"] * row["width"] for row in now)
            for pair in sorted({(row["planet_tooth"], row["side_tooth"]) for row in now}):
                line = [row for row in now if (row["planet_tooth"], row["side_tooth"]) == pair]
                own = bool(line[0]["followed"])
                for row in line:
                    # a strip as wide as the contact, and at least as wide as can be seen
                    half = max(row["half_width"], 0.12)
                    ends = [row["cone"] - 0.5 * row["width"], row["cone"] + 0.5 * row["width"]]
                    heights = [row["planet_height"] * end / row["cone"] for end in ends]
                    corners = [(ends[k], heights[k] + side * half) for k, side in [(0, -1), (1, -1), (1, 1), (0, 1)]]
                    axes.add_patch(plt.Polygon(corners, lw=0.4, color=colours(scale(row["pressure"]))))
                force = sum(row["line_load"] * row["width"] for row in line)
                centre = sum(row["line_load"] * row["width"] * row["cone"] for row in line) / force
                height = np.interp(centre, [row["cone"] for row in line], [row["planet_height"] for row in line])
                axes.plot(centre, height, ls="", marker="o" if own else "s", mfc="white", mec=EDGE, ms=6, zorder=6)
                corner = ", tip corner" if line[0]["corner"] else ""
                who = "this pair" if own else "another"
                axes.annotate(f"{who} {1e-3 * force:.1f} kN{corner}", (line[-1]["cone"] + 0.5 * line[-1]["width"],
                              line[-1]["planet_height"]), xytext=(20 if i == 0 else 5, 0),
                              textcoords="offset points", fontsize=8.5, va="center", annotation_clip=False)
            angle = (time - picks[0]) / (picks[-1] - picks[0])
            axes.set_title(f"{names[name]}, {100.0 * angle:.0f} % of the engagement, {1e-3 * whole:.1f} kN in all",
                           fontsize=10, loc="left")
            if column == 0:
                axes.set_ylabel("height, mm")
            if i == INSTANTS - 1:
                axes.set_xlabel("cone distance R, mm")
    tips = [outlines[name]["tip"] for name in chosen]
    for axes in grid.flat:
        axes.set_xlim(min(tip["toe_cone"] for tip in tips) - 1.3, max(tip["heel_cone"] for tip in tips) + 6.5)
    bar = figure.colorbar(plt.cm.ScalarMappable(scale, colours), ax=grid, shrink=0.5, aspect=40, pad=0.01,
                          extend="max")
    bar.set_label("Hertz pressure, MPa")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=3, bbox_to_anchor=(0.47, 1.0), fontsize=10)
    caption(figure, "Lines of contact on the planet's drive flank while one pair goes from first touch (above) to parting "
            "(below), with the loads of all pairs of the mesh, drawn on one flank. Teeth are straight, so that a line "
            "runs along a ray through the apex and over the whole face at once; misaligned teeth leave it only by as much "
            "as they give way. With this sense of spin contact climbs from the foot of the planet's tooth to its tip; "
            "the last of a pair is its tip corner, the first the side gear's. White marks: centroid of each line's load, a "
            "circle for the pair that is followed and a square for its neighbours.", LEGEND)
    save(figure, folder, "contact_lines")


if __name__ == "__main__":
    main()
