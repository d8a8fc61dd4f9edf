"""Style of all pictures in a report. Letters and axes have the colour of the page's text, light or dark."""

import io
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..extras import matplotlib
from ..panel import compose
from .blocks import Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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


def picture(name: str, rows: Iterable[Iterable[Any]], caption: str, height: float = 4.0, **options: Any) -> Picture:
    """Picture of panels, with a caption. Its ids start with `name`; `height` in inches; `rows` and `options` of `compose`."""
    found = matplotlib("report")
    from cycler import cycler
    from matplotlib.figure import Figure

    with found.rc_context({**STYLE, "axes.prop_cycle": cycler(color=CYCLE)}):
        figure = Figure(figsize=(WIDTH, height), layout="constrained")
        compose(figure, rows, **options)
        return Picture(name, _svg(figure, name), caption)


def _svg(figure: "Figure", name: str) -> str:
    """Picture as an `svg` element. Its ids start with `name`, so that they do not clash with those of other pictures."""
    # artists that show data, without grids, axes and letters
    shown = [artist for axes in figure.get_axes() if axes.get_label() != "<colorbar>"
             for artist in (*axes.lines, *axes.collections, *axes.patches, *axes.images)]
    for number, artist in enumerate(shown, 1):
        artist.set_gid(f"{MARK}-{number}")
    written = io.StringIO()
    figure.savefig(written, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None}, dpi=130)
    text = written.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", text).replace("xlink:href=", "href=")
    text = re.sub(r'(<svg[^>]*?)\swidth="[^"]*"\sheight="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(?<=\bid=")|(?<=url\(#)|(?<=href="#)', f"{name}-", text)
    # further fonts for machines without DejaVu Sans
    text = text.replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")
    return text.replace(TEXT_COLOUR, "currentColor").strip()
