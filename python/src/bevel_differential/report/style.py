"""One style for all pictures of a report. Letters and axes take the colour of the page's text: they show in light and dark."""

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from ..extras import needed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BLUE, RED, GREEN, OCHRE, VIOLET, BROWN, GREY = "#2f7fc1", "#d1495b", "#4a9a5a", "#c58a1f", "#8d6cc0", "#a06a50", "#808890"
CYCLE = [BLUE, RED, GREEN, OCHRE, VIOLET, BROWN, GREY, "#d08cb0"]
# inches
WIDTH = 10.0
# stands for the colour of the page's text, and becomes it when a picture is written
INK = "#0a0b0d"
# what artists that show data are called in the file, so that an empty picture can be told
MARK = "mark"


@contextmanager
def styled() -> Iterator[None]:
    """The style, for pictures made within."""
    matplotlib = needed("matplotlib", "report")
    from cycler import cycler

    with matplotlib.rc_context({
            "text.color": INK, "axes.edgecolor": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK,
            "grid.color": INK, "grid.alpha": 0.14, "axes.grid": True, "axes.axisbelow": True, "axes.spines.top": False,
            "axes.spines.right": False, "axes.facecolor": "none", "figure.facecolor": "none", "savefig.facecolor": "none",
            "axes.prop_cycle": cycler(color=CYCLE), "legend.frameon": False, "font.size": 9.5, "axes.titlesize": 10.0,
            "axes.titleweight": "bold", "axes.titlelocation": "left", "legend.fontsize": 9.0, "lines.linewidth": 1.4,
            "svg.fonttype": "none", "svg.hashsalt": "report", "figure.dpi": 110, "axes.formatter.useoffset": False,
            "axes.unicode_minus": True, "axes.xmargin": 0.01}):
        yield


def kilo(values: Sequence[np.ndarray]) -> tuple[float, str]:
    """What values are divided by to be shown, and the prefix of their unit: thousands where the largest has some."""
    largest = max(float(np.max(np.abs(each), initial=0.0)) for each in values)
    return (1e3, "k") if largest >= 1e3 else (1.0, "")


def figure(height: float, width: float = WIDTH) -> "Figure":
    """An empty picture; its panels arrange themselves."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def svg(picture: "Figure", name: str) -> str:
    """The picture as an `svg` element. `name` stands before its ids, which would clash with those of other pictures."""
    _mark(picture)
    written = io.StringIO()
    picture.savefig(written, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None}, dpi=130)
    text = written.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", text).replace("xlink:href=", "href=")
    text = re.sub(r'(<svg[^>]*?)\swidth="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(<svg[^>]*?)\sheight="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(?<=\bid=")|(?<=url\(#)|(?<=href="#)', f"{name}-", text)
    # others where a machine does not have the first
    text = text.replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")
    return text.replace(INK, "currentColor").strip()


def _mark(picture):
    """Names all that shows data; grids, axes and letters are not among it."""
    count = 0
    for axes in picture.get_axes():
        if axes.get_label() == "<colorbar>":
            continue
        for artist in [*axes.lines, *axes.collections, *axes.patches, *axes.images]:
            count += 1
            artist.set_gid(f"{MARK}-{count}")
