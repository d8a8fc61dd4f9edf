"""Style of all pictures in a report. Letters and axes have the colour of the page's text, light or dark."""

import io
import re
from collections.abc import Callable, Iterable, Sequence
from functools import wraps
from typing import TYPE_CHECKING

import numpy as np

from ..extras import matplotlib
from ..plot import by_unit, draw_panel, shown_times

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .simulated import Simulated

BLUE, RED, GREEN, OCHRE, VIOLET, BROWN, GREY = "#2f7fc1", "#d1495b", "#4a9a5a", "#c58a1f", "#8d6cc0", "#a06a50", "#808890"
CYCLE = [BLUE, RED, GREEN, OCHRE, VIOLET, BROWN, GREY, "#d08cb0"]
# width of a picture, inches
WIDTH = 10.0
# placeholder for the colour of the page's text; `_svg` replaces it by `currentColor`
TEXT_COLOUR = "#0a0b0d"
# prefix of the ids of artists that show data, by which tests find empty pictures
MARK = "mark"


STYLE = {
    **dict.fromkeys(("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color", "grid.color"), TEXT_COLOUR),
    "grid.alpha": 0.14, "axes.grid": True, "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
    "axes.facecolor": "none", "figure.facecolor": "none", "savefig.facecolor": "none", "legend.frameon": False, "font.size": 9.5,
    "axes.titlesize": 10.0, "axes.titleweight": "bold", "axes.titlelocation": "left", "legend.fontsize": 9.0,
    "lines.linewidth": 1.4, "svg.fonttype": "none", "svg.hashsalt": "report", "figure.dpi": 110,
    "axes.formatter.useoffset": False, "axes.unicode_minus": True, "axes.xmargin": 0.01,
}


def drawn(name: str, height: float = 4.0) -> Callable[[Callable[..., None]], Callable[..., str]]:
    """Decorator for a function that draws into its first argument, an empty picture. The decorated function creates the picture and
    returns it as an `svg` element, whose ids start with `name`. Panels are arranged automatically; `height` in inches."""
    def decorated(draw):
        @wraps(draw)
        def written(*arguments):
            found = matplotlib("report")
            from cycler import cycler
            from matplotlib.figure import Figure

            with found.rc_context({**STYLE, "axes.prop_cycle": cycler(color=CYCLE)}):
                picture = Figure(figsize=(WIDTH, height), layout="constrained")
                draw(picture, *arguments)
                return _svg(picture, name)
        return written
    return decorated


def unit_prefix(values: Sequence[np.ndarray]) -> tuple[float, str]:
    """Divisor of displayed values and prefix of their unit: (1000, "k") if the largest magnitude is 1000 or more, else (1, "")."""
    largest = max(float(np.max(np.abs(each), initial=0.0)) for each in values)
    return (1e3, "k") if largest >= 1e3 else (1.0, "")


def over_time(picture: "Figure", run: "Simulated", names: Iterable[str], panel_height: float, held: bool = False) -> np.ndarray:
    """Draws outputs over time, with a panel for each unit. Values that are `held` between communication points are drawn as steps."""
    names = list(names)
    record = run.record if held or not set(names) <= set(run.drawn.dtype.names or ()) else run.drawn
    panels = by_unit(run.scene.fmu, record, names)
    picture.set_figheight(panel_height * len(panels) + 0.6)
    axes = picture.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    times, label = shown_times(record["time"])
    for panel, ((unit, kind), curves) in zip(axes, panels.items()):
        draw_panel(panel, times, unit, "held" if held else kind, curves)
    axes[-1].set_xlabel(label)
    return axes


def _svg(picture: "Figure", name: str) -> str:
    """Picture as an `svg` element. Its ids start with `name`, so that they do not clash with those of other pictures."""
    # artists that show data, without grids, axes and letters
    shown = [artist for axes in picture.get_axes() if axes.get_label() != "<colorbar>"
             for artist in (*axes.lines, *axes.collections, *axes.patches, *axes.images)]
    for number, artist in enumerate(shown, 1):
        artist.set_gid(f"{MARK}-{number}")
    written = io.StringIO()
    picture.savefig(written, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None}, dpi=130)
    text = written.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", text).replace("xlink:href=", "href=")
    text = re.sub(r'(<svg[^>]*?)\swidth="[^"]*"\sheight="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(?<=\bid=")|(?<=url\(#)|(?<=href="#)', f"{name}-", text)
    # further fonts for machines without DejaVu Sans
    text = text.replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")
    return text.replace(TEXT_COLOUR, "currentColor").strip()
