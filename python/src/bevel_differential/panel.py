"""Pictures as data: panels with axes, marks and a legend, in rows, with a caption. `compose` draws all panels of the package, those of files
and those of reports."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .extras import matplotlib
from .readable import printed, time_scale
from .values import FileName

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# colours of files; reports have their own ones, for light and dark pages
BLUE, RED, GREEN, OCHRE, VIOLET, BROWN = "#1f6fb4", "#d1495b", "#4f8a5b", "#b7791f", "#7b5ea7", "#8a5a44"
PALE_BLUE, GREY, PALE_GREY = "#9bbfe0", "#6b7280", "#dddddd"
# black for theory, text, and secondary text
INK, TEXT, FAINT = "#111111", "#333333", "#666666"
# colours of successive curves
CYCLE = [BLUE, RED, GREEN, OCHRE, VIOLET, BROWN, GREY, "#d98cb3"]
SMALL = 10

# axes whose units the first data of a mark have, by the method of matplotlib that draws it; other data are not converted
ALONG = {"plot": "xy", "step": "xy", "bar": "xy", "text": "xy", "axvline": "x", "axhline": "y", "axvspan": "xx", "vlines": "xyy",
         "fill_between": "xyy", "pcolormesh": "xy", "stackplot": "x"}
# legends outside a panel; all others are at a location of matplotlib
OUTSIDE = {"right": {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}, "above": {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0)}}


@dataclass(frozen=True, eq=False)
class Axis:
    """Axis of a panel. `label`: quantity and unit. `values`: converts data to this unit."""

    label: str
    values: Callable[[Any], Any] = np.asarray


def time_axis(duration: float) -> Axis:
    """Axis of times [s], in the unit that suits a `duration` [s]."""
    factor, unit = time_scale(duration)
    return Axis(f"time, {unit}", lambda times: factor * times)


def scaled_axis(name: str, unit: str, values: Iterable[np.ndarray]) -> Axis:
    """Axis of displayed values, in thousands of their unit if the largest magnitude is 1000 or more."""
    is_large = max(float(np.max(np.abs(each), initial=0.0)) for each in values) >= 1e3
    return Axis(f"{name}, {'k' * is_large}{unit}", lambda given: given / (1e3 if is_large else 1.0))


class Mark:
    """Something drawn in a panel. `kind`: method of matplotlib's axes, or a function of the axes. `data`: its arguments, which
    the axes of the panel convert to their units (`ALONG`). `bar`: label and options of a colour bar. `look`: options of the method."""

    def __init__(self, kind: str | Callable[..., Any], *data: Any, bar: Mapping[str, Any] | None = None, **look: Any):
        self.kind, self.data, self.bar, self.look = kind, data, bar, look

    def draw(self, axes: "Axes", panel: "Panel") -> None:
        """Draws the mark, with a colour bar next to the panel."""
        from . import style

        if callable(self.kind):
            self.kind(axes, *self.data, **self.look)
            return
        along = ALONG.get(self.kind, "")
        # without a value, such as None, there is a gap
        shown = [getattr(panel, name).values(np.asarray(values, float)) for name, values in zip(along, self.data)]
        drawn = getattr(axes, self.kind)(*shown, *self.data[len(along):], **self.look)
        if self.bar:
            bar = axes.figure.colorbar(drawn, ax=axes, **{"pad": 0.01, "aspect": 25, **self.bar})
            style.plain_decades(bar.ax.yaxis)


def curve(x: Any, y: Any, label: str | None = None, colour: str | None = None, form: str = "-", **look: Any) -> Mark:
    """Curve or points; `form`: dashes and symbols, as matplotlib writes them."""
    return Mark("plot", x, y, form, label=label, color=colour, **look)


def layered(curves: Mapping[str, tuple[Any, Any]], kind: str, thin: float, forms: Sequence[str] = "-") -> list[Mark]:
    """Curves by name, of which the first is the widest, so that it remains visible below equal curves. Values of a `kind` other than Real
    are constant until the next one."""
    return [curve(*data, name, form=forms[index % len(forms)], linewidth=thin + 2.0 * (len(curves) - 1 - index) / len(curves),
                  drawstyle="default" if kind == "Real" else "steps-post") for index, (name, data) in enumerate(curves.items())]


class Panel:
    """Panel of a picture.

    `x`, `y`: labels of axes, or axes with a unit. Panels with the same axis have the same limits, and only the outer one has its label.
    `legend`: location of the legend, if marks have labels; `columns`: number of its columns. `grid`: axes whose grid is drawn. `look`:
    further properties of matplotlib's axes, such as limits."""

    def __init__(self, x: Any, y: Any, marks: Iterable[Mark], title: str = "", *, legend: str = "best", columns: int = 1, grid: str = "xy",
                 **look: Any):
        self.x, self.y = (Axis(axis) if isinstance(axis, str) else axis for axis in (x, y))
        self.marks, self.title, self.legend, self.columns, self.grid, self.look = marks, title, legend, columns, grid, look

    def draw(self, axes: "Axes") -> None:
        """Draws the panel."""
        from . import style

        for mark in self.marks:
            mark.draw(axes, self)
        axes.set(xlabel=printed(self.x.label), ylabel=printed(self.y.label), **self.look)
        if self.title:
            axes.set_title(self.title)
        for name, axis in (("x", axes.xaxis), ("y", axes.yaxis)):
            if name not in self.grid:
                axes.grid(False, axis=name)
            style.plain_decades(axis)
        if self.legend and axes.get_legend_handles_labels()[0]:
            axes.legend(**OUTSIDE.get(self.legend, {"loc": self.legend}), ncols=self.columns)


def compose(figure: "Figure", rows: Iterable[Iterable[Any]], legend: str = "", bar: Mapping[str, Any] | None = None, **layout: Any) -> None:
    """Draws panels into a figure. `rows`: panels in rows, where equal neighbours are one panel and None is empty; or blocks of such rows
    below each other, whose columns are independent. `legend`: location of a legend of all panels, outside them. `bar`: label and options of
    a colour bar of all panels. `layout`: ratios of heights and widths."""
    rows = [list(row) for row in rows]
    if isinstance(rows[0][0], Sequence):
        for part, block in zip(figure.subfigures(len(rows), 1, squeeze=False, **layout)[:, 0], rows):
            compose(part, block, legend)
            legend = ""
        return
    drawn = figure.subplot_mosaic(rows, empty_sentinel=None, gridspec_kw=layout)
    first = {}
    for panel, axes in drawn.items():
        for name in "xy":
            shared = first.setdefault((name, getattr(panel, name)), axes)
            if shared is not axes:
                getattr(axes, f"share{name}")(shared)
    for panel, axes in drawn.items():
        panel.draw(axes)
        _hide_inner_labels(panel, axes, drawn)
    if legend:
        handles, labels = next(iter(drawn.values())).get_legend_handles_labels()
        figure.legend(handles, labels, loc=f"outside {legend}", ncols=len(labels))
    if bar:
        from matplotlib.cm import ScalarMappable

        options = dict(bar)
        figure.colorbar(ScalarMappable(options.pop("norm"), options.pop("cmap")), ax=list(drawn.values()), **{"pad": 0.01, **options})
    figure.align_ylabels()


def _hide_inner_labels(panel, axes, drawn):
    """Hides the labels of a shared axis if a panel below, or on the left, has them."""
    own = axes.get_subplotspec()
    for other, its in ((other, each.get_subplotspec()) for other, each in drawn.items()):
        if other.x is panel.x and its.colspan == own.colspan and its.rowspan.start > own.rowspan.start:
            axes.tick_params(labelbottom=False)
            axes.set_xlabel("")
        if other.y is panel.y and its.rowspan == own.rowspan and its.colspan.start < own.colspan.start:
            axes.tick_params(labelleft=False)
            axes.set_ylabel("")


def picture(rows: Iterable[Iterable[Any]], caption: str, file: FileName | None, height: float, *, title: str = "", shaded: bool = False,
            **options: Any) -> "Figure":
    """Picture of the common width with a caption below its panels, written if a `file` is given. `height` in inches; `options` of
    `compose`; `shaded` as in `style.save`. The figure does not belong to pyplot, so it need not be closed."""
    matplotlib("plot")
    from . import style

    with style.styled():
        figure = style.figure(height)
        compose(figure, rows, **options)
        if title:
            figure.suptitle(title)
        style.caption(figure, caption)
        if file is not None:
            style.save(figure, file, shaded)
    return figure


def shades(*colours: tuple[str, float]) -> Any:
    """Colour map through colours, each with its opacity."""
    from matplotlib.colors import LinearSegmentedColormap, to_rgba

    return LinearSegmentedColormap.from_list("shades", [to_rgba(*each) for each in colours])
