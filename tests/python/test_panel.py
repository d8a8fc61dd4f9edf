"""Panels convert data to the units of their axes, share axes, and show labels only outside."""

import numpy as np
import pytest
from bevel_differential.panel import Axis, Mark, Panel, curve, picture, scaled_axis, time_axis


def test_data_are_in_the_units_of_the_axes_and_none_is_a_gap():
    time = time_axis(0.05)
    marks = [curve([0.0, 0.01, 0.02], [1500.0, None, 3000.0], "force"), Mark("stackplot", [0.0, 0.02], [1.0, 2.0]), Mark("axvline", 0.01)]
    panel, = picture([[Panel(time, scaled_axis("force", "N", [np.array([3000.0])]), marks)]], "text", None, 3.0).axes
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("time, ms", "force, kN")
    assert panel.lines[0].get_xdata() == pytest.approx([0.0, 10.0, 20.0])
    assert panel.lines[0].get_ydata() == pytest.approx([1.5, np.nan, 3.0], nan_ok=True)
    assert panel.lines[1].get_xdata()[0] == pytest.approx(10.0)
    assert panel.collections[0].get_datalim(panel.transData).x1 == pytest.approx(20.0)


def test_panels_with_the_same_axis_share_limits_and_only_the_outer_one_has_its_label():
    along, up = Axis("torque, N.m"), Axis("ratio")
    rows = [[Panel(along, up, [curve([0.0, 1.0], [0.0, 1.0])]), Panel(along, up, [curve([0.0, 5.0], [0.0, 7.0])])],
            [Panel(along, "loss, W", [curve([0.0, 9.0], [0.0, 1.0])]), None]]
    first, second, below = picture(rows, "text", None, 4.0).axes
    assert first.get_xlim() == second.get_xlim() == below.get_xlim() and first.get_ylim() == second.get_ylim() != below.get_ylim()
    # nothing is below the second panel, so it has the label of its horizontal axis
    assert [panel.get_xlabel() for panel in (first, second, below)] == ["", "torque, N·m", "torque, N·m"]
    assert [panel.get_ylabel() for panel in (first, second, below)] == ["ratio", "", "loss, W"]


def test_logarithmic_axes_have_plain_numbers_unless_they_are_very_wide():
    panels = [Panel("x", "y", [curve([1.0, 2.0], [1.0, most])], yscale="log") for most in (30.0, 1e5, 1e12)]
    figure = picture([panels], "text", None, 4.0)
    figure.draw_without_rendering()
    short, long, widest = ([label.get_text() for label in panel.get_yticklabels()] for panel in figure.axes)
    assert {"1", "2", "5", "10", "20"} <= set(short) and "2" not in long and "10 000" in long and not {"1", "10"} & set(widest)
