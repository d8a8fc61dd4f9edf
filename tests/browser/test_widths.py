"""In windows from phone to desktop width, every view of every scene plays, and every control can be pressed."""

import pytest

from conftest import close
from live import PATIENCE

WIDTHS = [390, 600, 768, 1024, 1100]
VIEWS = ["whole", "mesh", "side", "flank"]


@pytest.fixture(scope="module")
def playing(opened):
    """A page whose picture plays, but draws only the frames that a test requests."""
    live = opened("scene=study_straight", ["covered.js"])
    live.ask("ear.hold()")
    yield live
    close(live)


@pytest.fixture(scope="module", params=WIDTHS)
def sized(request, playing):
    """The page in a window of this width."""
    playing.page.set_viewport_size({"width": request.param, "height": 800})
    playing.wait("width => innerWidth === width", request.param)
    # a failed test leaves the walk open
    playing.ask("page.walk.close()")
    yield playing
    assert playing.faults == []


def look(live, view):
    """Selects a view and waits for its run and its gears."""
    live.ask("view => document.querySelector(`[data-camera=${view}]`).click()", view)
    live.answer("points", "refused")
    live.wait("page.view.differential.gears && page.shapes.waiting.length === 0")


# true if the picture's time advances and the gears are drawn within `patience` [ms]
GOES_ON = """async (patience) => {
    const [time, drawn, begin] = [page.player.time, page.view.renderer.info.render.frame, performance.now()];
    const goesOn = () => page.player.time !== time && page.view.renderer.info.render.frame > drawn;
    while (!goesOn() && performance.now() - begin < patience) await ear.frame();
    return goesOn();
}"""


def test_every_view_of_every_scene_plays_on(sized, scene_names, found):
    # one view per scene and width, so that all widths together check every view of every scene
    turn = WIDTHS.index(sized.ask("innerWidth"))
    for k, scene in enumerate(scene_names):
        view = VIEWS[(k + turn) % len(VIEWS)]
        sized.go(f"scene={scene}", "started")
        look(sized, view)
        assert sized.ask(GOES_ON, PATIENCE), f"{scene}, {view}"
    found(f"{sized.ask('innerWidth')} px")


# covered controls and overlapping boxes that remain after boxes had up to `patience` [ms] to make room for each other
CLEARS = """async (patience) => {
    const begin = performance.now();
    let left;
    do {
        await ear.frame();
        left = covered();
    } while (left.length > 0 && performance.now() - begin < patience);
    return left;
}"""


def uncovered(live, view):
    look(live, view)
    live.ask("ear.frame()")
    assert live.ask("covered()") == [], view


def test_nothing_covers_a_control(sized, found):
    sized.go("scene=study_turning", "started")
    for view in VIEWS:
        uncovered(sized, view)
    assert sized.ask("document.documentElement.scrollWidth <= innerWidth"), "the page is wider than its window"
    found(f"{sized.ask('innerWidth')} px")


def test_nothing_covers_a_control_when_the_page_says_something(sized, found):
    sized.go("scene=study_turning&geometry.face_width=0.5", "refused")
    assert sized.message()
    for view in ("whole", "flank"):
        uncovered(sized, view)
    sized.page.locator("#walk-open").click()
    assert sized.ask(CLEARS, 20_000) == []
    sized.page.locator("[data-walk=close]").click()
    found(f"{sized.ask('innerWidth')} px")
