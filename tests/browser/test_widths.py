"""Windows from a telephone's to a desk's: every view of every scene plays on, and every control can be pressed."""

import pytest

WIDTHS = [390, 600, 768, 1024, 1100]
VIEWS = ["whole", "mesh", "side", "flank"]


@pytest.fixture(scope="module", params=WIDTHS)
def sized(request, opened):
    """A page in a window of this width, whose picture is drawn seldom."""
    live = opened("scene=study_straight", ["covered.js"])
    live.page.set_viewport_size({"width": request.param, "height": 800})
    live.ask("ear.pictures = 0.2")
    yield live
    assert live.faults == []
    live.page.context.close()


def look(live, view):
    live.ask("view => document.querySelector(`[data-camera=${view}]`).click()", view)
    live.answer("started", "refused")


def goes_on(live):
    """Waits until the time of the picture has moved."""
    live.wait("before => page.player.time !== before", live.ask("page.player.time"))


def test_every_view_of_every_scene_plays_on(sized, scene_names, found):
    # a view of each scene, another at the next width: each view of each scene at one width or more
    turn = WIDTHS.index(sized.ask("innerWidth"))
    for k, scene in enumerate(scene_names):
        sized.go(f"scene={scene}", "started")
        look(sized, VIEWS[(k + turn) % len(VIEWS)])
        goes_on(sized)
    found(f"{sized.ask('innerWidth')} px")


def test_nothing_covers_a_control(sized, found):
    sized.go("scene=study_turning", "started")
    for view in VIEWS:
        look(sized, view)
        assert sized.ask("covered()") == [], view
    assert sized.ask("document.documentElement.scrollWidth <= innerWidth"), "the page is wider than its window"
    found(f"{sized.ask('innerWidth')} px")


def test_nothing_covers_a_control_when_the_page_says_something(sized, found):
    sized.go("scene=study_turning&geometry.face_width=0.5", "refused")
    assert sized.message()
    for view in ("whole", "flank"):
        look(sized, view)
        assert sized.ask("covered()") == [], view
    sized.page.locator("#walk-open").click()
    # boxes make room for each other within some frames, which take long without a graphics processor
    sized.page.wait_for_function("covered().length === 0", timeout=20_000)
    sized.page.locator("[data-walk=close]").click()
    found(f"{sized.ask('innerWidth')} px")
