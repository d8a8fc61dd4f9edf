"""Pictures in each view, theme and window size show gears that move."""

import io

import numpy as np
import pytest
from PIL import Image

from conftest import WINDOW

WINDOWS = {"desk": {"width": 1280, "height": 720}, "phone": {"width": 390, "height": 844}}
VIEWS = ["whole", "mesh", "side"]
SCENE = "scene=one_wheel_on_ice"
# times of the two pictures, as fractions of the run
TIMES = [0.11, 0.83]


def picture(live, share, file):
    """Picture of the gears after a fraction `share` of the run, with shape (rows, columns, 3)."""
    live.page.locator("#time").fill(repr(round(share * live.ask("page.player.stop"), 6)))
    live.wait("!page.moved && !page.view.stale")
    # a drawn picture is visible after the next frame
    live.ask("new Promise((seen) => requestAnimationFrame(() => requestAnimationFrame(seen)))")
    shot = Image.open(io.BytesIO(live.page.screenshot())).convert("RGB")
    if file:
        shot.save(file)
    box = live.page.locator("#stage").bounding_box()
    left, top, width, height = (round(box[key]) for key in ("x", "y", "width", "height"))
    return np.asarray(shot, float)[top:top + height, left:left + width]


def shares(pixels):
    """Fractions of a picture in the colours of planets (brass, red above blue) and side gears (blue steel, blue above red)."""
    red, _, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return np.mean(red > blue + 45.0), np.mean(blue > red + 35.0)


@pytest.fixture
def sized(live):
    """sized(window, theme): the page with another window size and theme. The end of the test restores both."""
    live.go(SCENE)
    live.ask("ear.free()")
    live.wait("page.view.differential.gears")

    def size(window, theme):
        live.page.emulate_media(color_scheme=theme)
        live.page.set_viewport_size(window)
        return live

    yield size
    live.page.locator("[data-camera=whole]").click()
    size(WINDOW, "light")


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("window", WINDOWS)
def test_all_views_show_gears_that_move(sized, found, pytestconfig, window, theme):
    folder = pytestconfig.getoption("shots")
    live = sized(WINDOWS[window], theme)
    for view in VIEWS:
        live.page.locator(f"[data-camera={view}]").click()
        files = [folder and folder / f"{view}_{window}_{theme}_{n}.png" for n in (1, 2)]
        first, second = (picture(live, share, file) for share, file in zip(TIMES, files))
        planets, sides = shares(first)
        assert planets > 0.01 and sides > 0.01, f"{view}: {planets:.3f} of the picture is brass, {sides:.3f} is steel"
        moved = np.mean(np.abs(first - second).max(axis=-1) > 16.0)
        assert moved > 0.01, f"{view}: {moved:.4f} of the picture differs between two times"
    assert live.ask("document.documentElement.scrollWidth <= innerWidth"), "the page is wider than its window"
    back = live.ask("getComputedStyle(document.body).backgroundColor.match(/[\\d.]+/g).map(Number)")
    assert (np.mean(back[:3]) > 128.0) == (theme == "light")
    found(f"{window} {theme}")
