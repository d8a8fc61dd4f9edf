"""Pictures of the command `pattern`: a flank and its line load have the same axis along the face; captions follow the scenes."""

import pytest
from command_line import command
from bevel_differential.pattern.picture import REMARKS
from matplotlib.text import Text

# gears with long and low flanks, and with short and high ones
GEARS = [("4.5mm", "20mm"), ("6mm", "6mm"), ("3mm", "12mm")]


@pytest.mark.parametrize("module, width", GEARS)
def test_the_line_load_is_drawn_below_its_place_on_the_flank(module, width, tmp_path, figures):
    command(f"pattern study_turning --quick --set geometry.module={module} --set geometry.face_width={width} --out {tmp_path / 'out'}")
    figures[0].draw_without_rendering()
    flank = figures[0].axes[0]
    load = flank.child_axes[0]
    ends = [(axes.get_window_extent().x0, axes.get_window_extent().x1, *axes.get_xlim()) for axes in (flank, load)]
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)
    # equal scales in both directions
    box = flank.get_window_extent()
    assert box.width / box.height == pytest.approx((ends[0][3] - ends[0][2]) / (flank.get_ylim()[1] - flank.get_ylim()[0]), rel=1e-6)


@pytest.mark.parametrize("names", [["aligned"], ["planet_out", "hypoid_forward"], ["aligned", "mine"]])
def test_pictures_of_scenes_say_nothing_about_the_documentation_s_cases(names, tmp_path, scene_file, figures):
    """The documentation's cases have names, which a user's scene file may have, too."""
    files = " ".join(str(scene_file({"spin.command": "200 deg/s", "scene.planet_spin": "imposed"}, name, 0.02)) for name in names)
    command(f"pattern {files} --quick --out {tmp_path / 'out'}")
    patterns, lines = figures
    texts = " ".join(text.get_text() for figure in figures for text in figure.findobj(Text))
    assert not [remark for remark in REMARKS.values() if remark in texts]
    assert "the study" not in texts and "pin out of place" not in texts and "direction of spin" not in texts
    # all scenes are in both pictures
    assert all(any(name in axes.get_title(loc="left") for axes in figure.axes) for name in names for figure in (patterns, lines))
