"""Time of the picture: slider, playing and keys change it, and picture, traces and readings follow it."""

import numpy as np
import pytest

DEGREES = 180.0 / np.pi


@pytest.fixture
def turn(live):
    """The page after a run with changing speeds. The picture is drawn but paused."""
    live.go("scene=one_wheel_on_ice&show=left.speed right.speed")
    live.pause()
    live.ask("ear.free()")
    yield live
    live.pause()


def scrub(live, time):
    # rounded, because the slider loses the last bits of its value
    time = round(float(time), 6)
    live.page.locator("#time").fill(repr(time))
    live.wait("time => page.player.time === time && page.traces.now === time && !page.moved", time)


def reading(text):
    """A displayed number and its unit."""
    number, unit = text.replace("−", "-").split(" ", 1)
    return float(number), unit


def line_at(live, share):
    """True if the first plot has its time cursor at the fraction `share` of its width."""
    return live.ask("""(share) => {
        const { plot } = page.traces.plots[0];
        const { left, top, width, height } = plot.bbox;
        const [x, y] = [left + share * width, top + 0.5 * height].map(Math.round);
        const colour = getComputedStyle(document.documentElement).getPropertyValue("--accent").trim();
        const wanted = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)).join();
        const { data } = plot.ctx.getImageData(x - 2, top, 5, height);
        let whole = 0;
        for (let row = 0; row < height; row += 1) {
            for (let k = 0; k < 5; k += 1) whole += [...data.slice(4 * (5 * row + k), 4 * (5 * row + k) + 3)].join() === wanted;
        }
        return whole > 0.9 * height;
    }""", share)


# rotation angle of a drawn gear about the axis of the side gears
DRAWN = "name => { const e = page.view.differential[name].matrix.elements; return Math.atan2(e[6], e[5]); }"


def test_gears_readings_and_trace_cursor_follow_the_scrubbed_time(turn, found):
    sides = ("left", "right")
    record = turn.record([f"{side}.{what}" for side in sides for what in ("speed", "angle")])
    stop = float(record["time"][-1])
    at = {}
    for time in (round(share * stop, 6) for share in (0.0, 0.13, 0.52, 0.9)):
        scrub(turn, time)
        now = {name: np.interp(time, record["time"], column) for name, column in record.items()}
        legend = turn.ask("[...document.querySelectorAll('.legend span')].map((each) => each.textContent)")
        for side in sides:
            number, unit = reading(turn.text(f"{side}-speed"))
            # the page shows four digits
            assert unit == "°/s" and np.isclose(number, DEGREES * now[f"{side}.speed"], rtol=6e-4)
            shown = next(text for text in legend if text.startswith(f"{side} speed"))
            assert reading(shown.removeprefix(f"{side} speed ")) == (number, unit)
        assert float(turn.text("clock").split(" ")[0]) == pytest.approx(time, abs=1e-3)
        cursor = [line_at(turn, share) for share in (time / stop, (time / stop + 0.45) % 1.0)]
        assert cursor[0] and not cursor[1], f"the line in the plots is not at {time} s"
        at[time] = [turn.ask(DRAWN, side) for side in sides], [now[f"{side}.angle"] for side in sides]
    for time, (drawn, angles) in at.items():
        # the picture and the record turn equally, except for whole turns
        turned = np.subtract(drawn, at[0.0][0]) - np.subtract(angles, at[0.0][1])
        assert np.allclose(np.exp(1j * turned), 1.0, atol=1e-6), time
    assert len({angles[0] for _, angles in at.values()}) == len(at)
    found(f"{len(at)} times")


def test_the_picture_plays_and_pauses(turn):
    scrub(turn, 0.0)
    turn.page.locator("#play").click()
    turn.wait("page.player.playing && page.player.time > 0")
    turn.page.locator("#play").click()
    turn.wait("!page.player.playing")
    at = turn.ask("page.player.time")
    # two more frames
    turn.ask("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert turn.ask("page.player.time") == at > 0.0
    assert turn.text("play") == "▶"


def test_keys_do_what_the_page_says(turn):
    keys = turn.page.keyboard
    scrub(turn, 0.0)
    turn.page.locator("#canvas").focus()
    stop = turn.ask("page.player.stop")
    keys.press("End")
    assert turn.ask("page.player.time") == stop
    keys.press("Home")
    assert turn.ask("page.player.time") == 0.0
    keys.press("ArrowRight")
    keys.press("ArrowRight")
    keys.press("ArrowLeft")
    assert np.isclose(turn.ask("page.player.time"), 0.01 * stop)
    for key, view in [("2", "mesh"), ("3", "side"), ("1", "whole")]:
        keys.press(key)
        assert turn.page.locator(f'[data-camera={view}][aria-pressed="true"]').count() == 1
        assert turn.page.locator('[data-camera][aria-pressed="true"]').count() == 1
    rate = turn.ask("page.player.rate")
    keys.press("ArrowDown")
    slower = turn.ask("page.player.rate")
    keys.press("ArrowUp")
    assert slower < rate and np.isclose(turn.ask("page.player.rate"), rate)
    before = turn.ask("page.view.camera.position.toArray()")
    keys.press("Shift+ArrowLeft")
    after = turn.ask("page.view.camera.position.toArray()")
    # the camera moves around the gears at constant distance
    assert np.linalg.norm(np.subtract(after, before)) > 1.0 and np.isclose(np.linalg.norm(after), np.linalg.norm(before))
    keys.press(" ")
    assert turn.ask("page.player.playing")
    keys.press(" ")
    assert not turn.ask("page.player.playing")
    keys.press("w")
    assert turn.page.locator("#walk").is_visible()
    keys.press("Escape")
    assert not turn.page.locator("#walk").is_visible()


def test_a_field_keeps_its_keys(turn):
    time = turn.ask("page.player.time")
    turn.page.locator("#search").press("ArrowRight")
    turn.page.locator("#search").press("1")
    assert turn.page.locator("#search").input_value() == "1" and turn.ask("page.player.time") == time
    turn.page.locator("#search").fill("")


def test_a_press_in_a_plot_seeks(turn):
    box = turn.page.locator("#traces .u-over").first.bounding_box()
    turn.page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    stop = turn.ask("page.player.stop")
    assert abs(turn.ask("page.player.time") - 0.25 * stop) < 2.0 / box["width"] * stop
