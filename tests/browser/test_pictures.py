"""Pictures of each view, theme and size of window: gears are seen in them, and they move."""

import io

import numpy as np
import pytest
from live import address_of
from PIL import Image

WINDOWS = {"desk": {"width": 1280, "height": 720}, "phone": {"width": 390, "height": 844}}
VIEWS = ["whole", "mesh", "side"]
SCENE = "scene=one_wheel_on_ice"
# parts of the run that stand in the two pictures
TIMES = [0.11, 0.83]


def picture(live, share, file):
    """The gears at a share of the run, shape (rows, columns, 3)."""
    live.page.locator("#time").fill(repr(share * live.ask("page.player.stop")))
    live.wait("!page.moved && !page.view.stale")
    if file:
        live.page.screenshot(path=file)
    shot = live.page.locator("#stage").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), float)


def shares(pixels):
    """Parts of a picture in the colours of planets (brass, red above blue) and of side gears (blue steel, blue above red)."""
    red, _, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return np.mean(red > blue + 45.0), np.mean(blue > red + 35.0)


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("window", WINDOWS)
def test_all_views_show_gears_that_move(fresh, found, pytestconfig, window, theme):
    folder = pytestconfig.getoption("shots")
    live = fresh(SCENE, viewport=WINDOWS[window], color_scheme=theme)
    assert "over" in live.answer()
    live.pause()
    live.wait("page.view.differential.gears")
    least = 1.0
    for view in VIEWS:
        live.page.locator(f"[data-camera={view}]").click()
        files = [folder and folder / f"{view}_{window}_{theme}_{n}.png" for n in (1, 2)]
        first, second = (picture(live, share, file) for share, file in zip(TIMES, files))
        planets, sides = shares(first)
        assert planets > 0.01 and sides > 0.01, f"{view}: {planets:.3f} of the picture is brass, {sides:.3f} is steel"
        moved = np.mean(np.abs(first - second).max(axis=-1) > 16.0)
        assert moved > 0.01, f"{view}: {moved:.4f} of the picture differs between two times"
        least = min(least, planets, sides, moved)
    # nothing is wider than the window
    assert live.ask("document.documentElement.scrollWidth <= innerWidth")
    back = live.ask("getComputedStyle(document.body).backgroundColor.match(/[\\d.]+/g).map(Number)")
    assert (np.mean(back[:3]) > 128.0) == (theme == "light")
    found(f"{window}, {theme}: {len(VIEWS)} views")
