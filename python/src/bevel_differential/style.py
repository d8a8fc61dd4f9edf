"""Common style of all pictures of the project: colours, fonts, widths, caption and file.

`apply` sets it for the process, `styled` for a block. Units are written in one way: N·m, rpm, N/mm; a label is
"quantity, unit". Every picture ends with a caption that describes it.
"""

import io
import re
import textwrap
from pathlib import Path

from . import extras
from .output_file import checked
from .panel import BLUE, CYCLE, FAINT, GREEN, INK, PALE_BLUE, PALE_GREY, RED, SMALL, TEXT, VIOLET  # noqa: F401
from .readable import plain, printed
from .values import DifferentialError
from .writing import write_whole

matplotlib = extras.matplotlib("plot")

# after the choice of the backend, which comes with the first import
from cycler import cycler  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402
from PIL import Image  # noqa: E402

MARKERS = ["o", "s", "^", "v", "D", "P", "X", "<"]
# width of a picture, inches: one width for all, so that letters have one size on a page
WIDTH = 13.0
DPI = 130
# ratios of the ends of a short logarithmic axis, and of the widest one with plain numbers
SHORT, WIDEST = 100.0, 1e9
COLOURS = 256
# caption: characters per inch of width, height of a line in inches, font size
CAPTION_DENSITY, CAPTION_LINE, CAPTION_SIZE = 12.4, 0.20, 11

STYLE = {
    "font.size": 11.5, "axes.titlesize": 11.0, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.labelsize": 11.5,
    "legend.fontsize": 10.5,
    "axes.prop_cycle": cycler(color=CYCLE), "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "legend.framealpha": 0.8, "legend.edgecolor": "white", "lines.linewidth": 1.7,
    "figure.facecolor": "white", "savefig.dpi": DPI, "figure.titlesize": 12.5, "figure.titleweight": "bold",
    "axes.formatter.useoffset": False,
}


def apply() -> None:
    """Sets the style for the process."""
    matplotlib.rcParams.update(STYLE)


def styled():
    """Context with the style, for pictures that are created in it."""
    return matplotlib.rc_context(STYLE)


def figure(height):
    """Empty picture of the common width; panels are arranged automatically."""
    return Figure(figsize=(WIDTH, height), layout="constrained")


def panels(rows, columns, height, **options):
    """Picture of the common width with its panels, as `Figure.subplots` returns them."""
    picture = figure(height)
    return picture, picture.subplots(rows, columns, **options)


def caption(picture, text):
    """Adds a caption in lines below the panels."""
    # a number and its unit stay on one line
    text = re.sub(r"(?<=\d) (?=(%|[µmk]?[smN]|kg|rpm|deg/s|Hz|MPa)\b|%)", "\N{NO-BREAK SPACE}", printed(text))
    lines = textwrap.wrap(text, int(CAPTION_DENSITY * picture.get_figwidth()))
    height = (CAPTION_LINE * len(lines) + 0.2) / picture.get_figheight()
    picture.get_layout_engine().set(rect=(0.0, height, 0.995, 0.99 - height), hspace=0.04, wspace=0.03)
    picture.text(0.02, height - 0.08 / picture.get_figheight(), "\n".join(lines), va="top", fontsize=CAPTION_SIZE,
                 color=TEXT, linespacing=1.3)


def plain_decades(axis):
    """Writes the powers of ten of a logarithmic axis as plain numbers: 0.01, 0.1, 1, 10 000. A short axis has 2 and 5 between them. Axes
    that are linear or very wide remain as they are."""
    low, high = axis.get_view_interval()
    if axis.get_scale() != "log" or high >= WIDEST * low:
        return
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < SHORT * low else (1.0,), numticks=12))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    axis.set_minor_formatter(NullFormatter())


def in_rpm(axes):
    """Adds a second y axis in rpm to axes in deg/s."""
    second = axes.secondary_yaxis("right", functions=(lambda speed: speed / 6.0, lambda speed: speed * 6.0))
    second.set_ylabel("speed, rpm")
    second.spines["right"].set_visible(True)
    return second


def note(axes, x, y, text, **options):
    """Adds a remark, right-aligned at a position in fractions of the panel."""
    axes.text(x, y, text, transform=axes.transAxes, **{"ha": "right", "va": "center", "color": TEXT, **options})


def save(picture, path, shaded=False):
    """Writes the file. Lines and letters need few colours, so a colour table reduces the file to a third. Pictures with `shaded` surfaces
    keep all colours."""
    checked(path, "picture")
    # drawn in memory, because on a full disk libraries would leave incomplete files
    drawn, kind = io.BytesIO(), Path(path).suffix.lower().removeprefix(".")
    try:
        picture.savefig(drawn, format=kind)
    except ValueError as error:
        raise DifferentialError(f"{path}: {error}", kind="failed") from None
    if kind == "png":
        with Image.open(drawn) as image:
            smaller = image.convert("RGB")
        if not shaded:
            smaller = smaller.quantize(COLOURS, dither=Image.Dither.NONE)
        drawn = io.BytesIO()
        smaller.save(drawn, format=kind, optimize=True)
    write_whole(path, drawn.getvalue())
