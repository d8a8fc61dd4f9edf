"""Pictures of contact patterns, from the files of the command."""

from pathlib import Path

import numpy as np

from ..panel import BLUE, RED, SMALL, TEXT, Axis, Mark, Panel, curve, picture
from ..records import read
from ..report.pattern import LEAST_RADIUS
from ..style import WIDTH

# after the style, which chooses the backend
from matplotlib import colormaps  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402

PRESSURE, LOAD, CENTROID = "magma_r", BLUE, RED
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
# cases of the documentation whose lines of contact are drawn; the first two available ones count
LINES = ["aligned", "hypoid_forward", "planet_out"]
INSTANTS = 6
COLUMNS = 3
# inches: largest height of a flank; room next to a flank, and above and below a flank with its line load
HIGHEST, BESIDE, AROUND = 5.0, 0.55, 0.95
# height of the panel of the line load, over the width of the flank
LOAD_HEIGHT = 0.19
# smallest half-width of a line of contact in the picture, mm
THINNEST = 0.12
# sizes of the units of pictures, by column: lengths in mm, line loads in N/mm, pressures in MPa, force in kN
UNITS = {**dict.fromkeys(("cone", "width", "height", "planet_height", "side_height", "radius", "half_width", "centroid", "toe_cone",
                          "toe_height", "heel_cone", "heel_height"), 1e3), "line_load": 1e-3, "pressure": 1e-6, "force": 1e-3}


class Case:
    """Case of a picture. `result`: its findings; `outline`: rows of its flank by mark; `pattern` and `contacts`: its rows, `followed` those of
    the followed pair. `wide` and `high`: ranges of cone distance and height of the flank's panel, mm."""

    def __init__(self, result, tables):
        self.name, self.title, self.result = result["case"], result["title"], result
        self.pattern, self.contacts, outline = ([row for row in rows if row["case"] == self.name] for rows in tables)
        self.outline = {row["mark"]: row for row in outline}
        self.followed = [row for row in self.contacts if row["followed"]]
        tip, root = self.outline["tip"], self.outline["root"]
        self.wide, self.high = (tip["toe_cone"] - 1.3, tip["heel_cone"] + 1.3), (root["heel_height"] - 0.3, tip["heel_height"] + 0.4)

    @property
    def line_load(self):
        """Cone distances and line loads at the instant of the findings, shape (points, 2)."""
        return np.array([(row["cone"], row["line_load"]) for row in self.followed if row["time"] == self.result["time"]])


def draw(folder: Path, of_documentation: bool) -> list[str]:
    """Draws the patterns whose files are in `folder`. Returns the names of the pictures. `of_documentation`: true for the cases of the
    documentation, which have remarks; scenes of users may have the same names."""
    results, *tables = ([_drawn(row) for row in read(folder / f"{name}.csv")[1]] for name in ["summary", "pattern", "contacts", "outline"])
    cases = [Case(result, tables) for result in results]
    patterns(folder / "contact_pattern.png", cases, REMARKS if of_documentation else {})
    lines(folder / "contact_lines.png", cases, of_documentation)
    return ["contact_pattern.png", "contact_lines.png"]


def _drawn(row):
    """Row of a file, in SI, in the units of the pictures: mm, N/mm, MPa and kN."""
    return {name: value * UNITS[name] if name in UNITS else value for name, value in row.items()}


def tooth(outline, names=False):
    """Marks of the unrolled flank: toe left, heel right, tip at the top, pitch line at zero."""
    tip, root = outline["tip"], outline["root"]
    toe, heel = tip["toe_cone"], tip["heel_cone"]
    yield Mark("fill", [toe, heel, heel, toe], [root["toe_height"], root["heel_height"], tip["heel_height"], tip["toe_height"]], fill=False,
               ec=TEXT, lw=1.3, zorder=4)
    for mark, form, name in [("pitch", "-.", "pitch line"), ("base", ":", "base circle: end of the involute"),
                             ("start", "--", "rigid contact begins")]:
        yield curve([toe, heel], [outline[mark]["toe_height"], outline[mark]["heel_height"]], name, TEXT, form, lw=0.9, zorder=4)
    if names:
        yield Mark("text", toe - 0.25, 0.0, "toe", rotation=90, ha="right", va="center", fontsize=9.5)
        yield Mark("text", heel + 0.25, 0.0, "heel", rotation=90, ha="left", va="center", fontsize=9.5)
        yield Mark("text", 0.5 * (toe + heel), 0.5 * (tip["toe_height"] + tip["heel_height"]) + 0.35, "tip", ha="center", fontsize=9.5)


def flank(x, y, case, marks, title="", **look):
    """Panel of a flank, with equal scales in both directions."""
    return Panel(x, y, marks, title, legend="", grid="", aspect="equal", anchor="N", **{"xlim": case.wide, "ylim": case.high, **look})


def patterns(file, cases, remarks):
    columns = min(COLUMNS, len(cases))
    rows = -(-len(cases) // columns)
    # height of a flank and of its line load, over its width: all flanks have the same scale in both directions
    shape = max(np.ptp(case.high) / np.ptp(case.wide) for case in cases)
    room = (WIDTH - BESIDE * columns) / columns
    width = min(room, HIGHEST / shape)
    # flanks that would be too high are narrower than their column
    margin = 1e-3 + (0.5 * (room - width) / (width + BESIDE) if columns == 1 else 0.0)
    most_load = max(case.line_load[:, 1].max() for case in cases)
    engaged, rated = words_of(cases)
    scale = Normalize(0.0, top_of(cases))
    panels = [_pattern(case, scale, remarks.get(case.name, ""), most_load, i % columns == 0, i >= len(cases) - columns)
              for i, case in enumerate(cases)]
    panels += [None] * (rows * columns - len(panels))
    grid = [[None, *panels[i:i + columns], None] for i in range(0, len(panels), columns)]
    where = ("the study's turn (835 N·m on each half-shaft)" if remarks else f"the scene {cases[0].title}" if len(cases) == 1 else
             "the given scenes")
    shared = "One scale for all panels; only" if len(cases) > 1 else "Only"
    errors = ("Offsets bring one end of the face into contact first, and the load moves there; an error of the shaft angle turns the "
              "gears about their common apex, and all sections change alike. A pin out of place loads one planet and unloads the "
              "opposite one. ") if remarks else ""
    picture(grid, f"Contact patterns of planet 1 with the left side gear in {where}, {teeth_of(cases)}. The planet's flank is a "
            f"trapezoid with the small end (toe) left; colour is the largest pressure at each spot while {engaged}, "
            f"as marking compound would show it. {shared} the seam at the base "
            f"circle exceeds the scale, because the flank has no radius there. Blue: line load over the face {rated}. "
            f"Red: the pair's force and its centroid, measured from mid-face toward the heel. {errors}Where a "
            "tip corner touches, the pressure is calculated with the flanks' radii; the true one is higher.",
            file, (width * (shape + LOAD_HEIGHT) + AROUND) * rows + 2.5, shaded=True, legend="upper center",
            width_ratios=[margin, *[1.0] * columns, margin],
            bar={"norm": scale, "cmap": PRESSURE, "label": "largest Hertz pressure of the engagement, MPa", "orientation": "horizontal",
                 "shrink": 1.0 if columns == 1 else 0.5, "aspect": 50, "extend": "max"})


def _pattern(case, scale, remark, most_load, is_first, is_lowest):
    """Flank with the largest pressure at each position, and the line load below it."""
    cones = len({row["cone"] for row in case.pattern})
    cone, height, pressure = [np.array([row[key] for row in case.pattern]).reshape(cones, -1) for key in ["cone", "height", "pressure"]]
    load = line_load(case, most_load, is_first, is_lowest)
    # the line load is a part of the flank's panel, so that both show the same places along the face whatever the shape of the flank
    own = LOAD_HEIGHT * np.ptp(case.wide) / np.ptp(case.high)
    return flank("", "height, mm" if is_first else "", case, [
        Mark("pcolormesh", cone, height, np.ma.masked_less(pressure, 1.0), cmap=PRESSURE, norm=scale, shading="gouraud"), *tooth(case.outline, True),
        Mark("tick_params", labelbottom=False),
        Mark("set_title", f"{case.title} ({case.result['flank']} flank)", pad=19 if remark else None),
        # between flank and title, whatever the height of the flank
        Mark("annotate", remark, (0.0, 1.0), xycoords="axes fraction", xytext=(0, 5), textcoords="offset points", fontsize=SMALL, color=TEXT,
             annotation_clip=False),
        Mark(lambda axes: load.draw(axes.inset_axes([0.0, -1.2 * own, 1.0, own], sharex=axes)))])


def words_of(cases):
    """Phrases for captions: the motion of the pairs, and the instant of their line loads."""
    whole = [bool(case.result["whole"]) for case in cases]
    engaged, rated = "one pair goes from first touch to parting", "while the pair is nearest to the pitch line"
    if all(whole):
        return engaged, rated
    partly, largest = "the most loaded pair stays in touch (none touched and parted)", "at the pair's largest force"
    return (f"{engaged}, or {partly}", f"{rated}, or {largest}") if any(whole) else (partly, largest)


def teeth_of(cases):
    """Kinds of teeth in all cases, for captions."""
    return " or ".join(dict.fromkeys(TEETH[case.result["teeth"]] for case in cases))


def line_load(case, most, is_first, is_lowest):
    """Panel of the load over the face, and the force at its centroid."""
    result, points = case.result, case.line_load.T
    centroid = 0.5 * sum(case.wide) + result["centroid"]
    shift = f"{round(result['centroid'], 1) + 0.0:+.1f}".replace("-", "−")
    return Panel("cone distance R, mm" if is_lowest else "", "line load,\nN/mm" if is_first else "", [
        Mark("fill_between", *points, 0.0, color=LOAD, alpha=0.25, lw=0), curve(*points, None, LOAD, lw=1.5),
        Mark("axvline", centroid, color=CENTROID, lw=1.3),
        Mark("text", centroid + 0.15, 1.4 * most, f"{result['force']:.1f} kN, {shift} mm", color=CENTROID, fontsize=SMALL, va="top")],
        ylim=(0, 1.45 * most))


def top_of(cases):
    """Upper end of the colours, MPa: the largest pressure outside the seam at the foot, where the flanks' radius vanishes."""
    shown = [row for case in cases for row in case.followed]
    # relative radii per cone distance; the contact nearest to the pitch point gives the value there
    pitch = min(shown, key=lambda row: abs(row["s"]))
    least = LEAST_RADIUS * pitch["radius"] / pitch["cone"]
    sound = [row["pressure"] for row in shown if row["radius"] / row["cone"] > least and not row["corner"]]
    return 100.0 * np.ceil(max(sound or [row["pressure"] for row in shown]) / 100.0)


def lines(file, cases, of_documentation):
    named = {case.name: case for case in cases}
    chosen = [named[name] for name in (LINES if of_documentation else named) if name in named][:2]
    # one column for each of two cases; a single case fills two columns, row by row
    high = INSTANTS if len(chosen) == 2 else INSTANTS // 2
    colours, scale = colormaps[PRESSURE], Normalize(0.0, top_of(cases))
    # room for the forces on the right, and at least as wide as a panel of the grid
    wide, tall = np.array([case.wide for case in chosen]), [case.high for case in chosen]
    toe = wide.min()
    ends = toe, max(wide.max() + 6.2, toe + (2.6 if len(chosen) == 2 else 2.0) * np.ptp(tall))
    cones, heights = Axis("cone distance R, mm"), Axis("height, mm")
    panels = []
    for case in chosen:
        followed = sorted({row["time"] for row in case.followed})
        picks = [followed[round(i * (len(followed) - 1) / (INSTANTS - 1))] for i in range(INSTANTS)]
        for i, time in enumerate(picks):
            marks = [*tooth(case.outline, i == 0)]
            now = [row for row in case.contacts if row["time"] == time]
            for pair in sorted({(row["planet_tooth"], row["side_tooth"]) for row in now}):
                line = [row for row in now if (row["planet_tooth"], row["side_tooth"]) == pair]
                marks += line_marks(line, case.outline["tip"]["heel_cone"], lambda pressure: colours(scale(pressure)), 20 if i == 0 else 5)
            share = (time - picks[0]) / ((picks[-1] - picks[0]) or 1.0)
            panels.append(flank(cones, heights, case, marks, f"{case.title}, {100.0 * share:.0f} % of "
                                f"{'the engagement' if case.result['whole'] else 'its part'}, {1e-3 * force_of(now):.1f} kN in all", xlim=ends))
    grid = zip(panels[:INSTANTS], panels[INSTANTS:]) if len(chosen) == 2 else zip(panels[::2], panels[1::2])
    # only for the turn of the documentation
    spin = ("In this direction of spin contact moves from the root of the planet's tooth to its tip; a pair begins with the tip corner of "
            "the side gear and ends with its own. ") if of_documentation else ""
    picture(grid, f"Lines of contact on the planet's flank while {words_of(cases)[0]}, "
            f"in steps of {100 // (INSTANTS - 1)} %, {teeth_of(cases)}, with the loads of all pairs of the mesh, drawn on one flank. Teeth are straight, so a line runs along "
            f"a ray through the apex. Strips thinner than {2.0 * THINNEST:g} mm are drawn that wide. {spin}White marks: centroid of "
            "each line's load, a circle for the pair that is followed and a square for its neighbours.",
            file, (2.4 if len(chosen) == 2 else 3.0) * high + 1.8, shaded=True, legend="upper center",
            bar={"norm": scale, "cmap": colours, "label": "Hertz pressure, MPa", "shrink": 0.5, "aspect": 40, "extend": "max"})


def line_marks(line, heel, colour, indent):
    """Line of contact of one pair with its force beyond the heel. The line is as wide as the contact, or the smallest visible width."""
    for row in line:
        half = max(row["half_width"], THINNEST)
        ends = np.array([row["cone"] - 0.5 * row["width"], row["cone"] + 0.5 * row["width"]])
        heights = row["planet_height"] * ends / row["cone"]
        yield Mark("fill", [*ends, *ends[::-1]], [*(heights - half), *(heights[::-1] + half)], lw=0.4, color=colour(row["pressure"]))
    force = force_of(line)
    centre = sum(row["line_load"] * row["width"] * row["cone"] for row in line) / force
    height = np.interp(centre, [row["cone"] for row in line], [row["planet_height"] for row in line])
    own = bool(line[0]["followed"])
    yield curve(centre, height, None, None, "o" if own else "s", mfc="white", mec=CENTROID, ms=6, zorder=6)
    size = f"{1e-3 * force:.1f} kN" if force >= 50.0 else f"{force:.0f} N"
    name = f"{'this pair' if own else 'neighbour'} {size}{', tip corner' if line[0]['corner'] else ''}"
    # on the ray through the apex that the line follows
    yield Mark("annotate", name, (heel, line[-1]["planet_height"] * heel / line[-1]["cone"]), xytext=(indent, 0), textcoords="offset points",
               fontsize=9.5, va="center", annotation_clip=False)


def force_of(rows):
    """Force of the rows, N."""
    return sum(row["line_load"] * row["width"] for row in rows)
