"""A table whose cells are coloured by their values."""

import numpy as np

from bevel_differential import style


def draw_cells(axes, values, texts, colors, limits, is_dark, size=style.SMALL):
    """`texts[i][j]` in the colour of `values[i, j]`; white where `is_dark(value)`."""
    axes.imshow(np.where(np.isfinite(values), values, 0.0), cmap=colors, norm=limits, aspect="auto")
    for (i, j), value in np.ndenumerate(values):
        axes.text(j, i, texts[i][j], ha="center", va="center", fontsize=size, color="white" if is_dark(value) else style.INK)
    axes.set(xticks=range(values.shape[1]), yticks=range(values.shape[0]))
    axes.grid(False)
    axes.tick_params(length=0)
