"""Pictures of the command `pattern`: a flank and its line load have the same axis along the face."""

import pytest
from bevel_differential import style
from bevel_differential.command import main
from bevel_differential.pattern.picture import with_lines

# gears with long and low flanks, and with short and high ones
GEARS = [("4.5 mm", "20 mm"), ("6 mm", "6 mm"), ("3 mm", "12 mm")]


@pytest.mark.parametrize("module, width", GEARS)
def test_the_line_load_is_drawn_below_its_place_on_the_flank(module, width, tmp_path, monkeypatch):
    figures = []
    monkeypatch.setattr(style, "save", lambda figure, file, shaded=False: figures.append(figure))
    assert main(["pattern", "study_turning", "--quick", "--set", f"geometry.module={module}", "--set", f"geometry.face_width={width}",
                 "--out", str(tmp_path / "out")]) == 0
    figures[0].draw_without_rendering()
    flank = figures[0].axes[0]
    load = flank.child_axes[0]
    ends = [(axes.get_window_extent().x0, axes.get_window_extent().x1, *axes.get_xlim()) for axes in (flank, load)]
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)
    # equal scales in both directions
    box = flank.get_window_extent()
    assert box.width / box.height == pytest.approx((ends[0][3] - ends[0][2]) / (flank.get_ylim()[1] - flank.get_ylim()[0]), rel=1e-6)


def test_lines_of_contact_of_two_scenes_are_both_drawn_whatever_their_names():
    for names in (["aligned", "mine"], ["mine", "aligned"], ["planet_out", "mine"], ["a", "b"]):
        assert set(with_lines(names)) == set(names)
    assert with_lines(["side_in", "aligned", "hypoid_forward"]) == ["aligned", "hypoid_forward"] and with_lines(["one"]) == ["one"]
