"""The final drive in the page: its parts are drawn only with the effect, mesh at the ratio of their teeth, and follow the drive of the pinion."""

from math import cos, degrees

import numpy as np
import pytest

from live import address_of
from test_pictures import WINDOWS, picture, shares, sized  # noqa: F401

SHORT = {"scene": "study_straight", "stop_time": "0.05", "effects.final_drive": "true"}
PINION, RING = 10, 41
# times at which the picture is compared; between them, the pinion turns by less than half a revolution
TIMES = np.array([0.01, 0.016, 0.022])
BEVEL, HELICAL = "1.3264502315156905", "0"


def drive_of(live):
    """What is drawn of the final drive: None, or {visible, shaft}."""
    return live.ask("(({ drive }) => drive && { visible: drive.group.visible, shaft: Boolean(drive.shaft) })(page.view.differential)")


def drawn(live, is_drawn=True):
    """Waits until the final drive is drawn, or is not."""
    live.wait("is => page.view.differential.gears && Boolean(page.view.differential.drive) === is", is_drawn)


def frames(live, part, times):
    """Matrices of a part of the drive in the scene at these times, with shape (times, 4, 4)."""
    def at(time):
        live.ask("async (time) => { page.seek(time); await ear.frame(); }", time)
        return np.reshape(live.ask("part => part.split('.').reduce((of, key) => of[key], page.view.differential.drive).matrix.elements", part),
                          (4, 4)).T

    return np.array([at(time) for time in times])


def turns(matrices, axis):
    """Angles about an axis from the first matrix to the others, less than half a revolution from one to the next [rad]."""
    def angle(one, other):
        turn = other[:3, :3] @ one[:3, :3].T
        across = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2.0
        assert np.allclose(across, axis * (across @ axis), atol=1e-9), "the part turns about another axis"
        return np.arctan2(across @ axis, (np.trace(turn) - 1.0) / 2.0)

    return np.cumsum([angle(one, other) for one, other in zip(matrices, matrices[1:])])


def test_ring_gear_and_pinion_are_drawn_only_with_the_effect(live):
    button = live.page.locator("[data-camera=drive]")
    live.go("scene=study_straight&stop_time=0.02")
    drawn(live, False)
    assert not button.is_visible() and not live.page.locator("#pinion-speed").is_visible()
    assert "over" in live.put("effects.final_drive", True)
    drawn(live)
    assert drive_of(live) == {"visible": True, "shaft": False}
    assert button.is_visible() and live.page.locator("#pinion-speed").is_visible()
    assert "over" in live.put("effects.propeller_shaft", True)
    live.wait("page.view.differential.drive?.shaft")
    button.click()
    assert live.link()["view"] == "drive" and drive_of(live) == {"visible": True, "shaft": True}
    # in views of one mesh of the planets, the ring gear would cover it
    live.page.locator("[data-camera=mesh]").click()
    assert not drive_of(live)["visible"]
    button.click()
    for effect in ("propeller_shaft", "final_drive"):
        assert "over" in live.put(f"effects.{effect}", False)
    drawn(live, False)
    # a view of what is not there gives way to the whole
    assert not button.is_visible() and live.ask("page.setup.view") == "whole" and "view" not in live.link()


@pytest.mark.parametrize("pitch_angle", [BEVEL, HELICAL], ids=["bevel", "helical"])
@pytest.mark.parametrize("side, sign", [("left", 1.0), ("right", -1.0)])
def test_drawn_pinion_and_ring_gear_turn_at_the_ratio_of_their_teeth(live, side, sign, pitch_angle, found):
    live.go(address_of({**SHORT, "final_drive.ring_side": side, "final_drive.pitch_angle": pitch_angle}))
    live.wait("([side, angle]) => [page.view.differential.drive].some((d) => d?.place.side === side && Math.abs(d.pair.cone - angle) < 1e-9)",
              [sign, float(pitch_angle)])
    record = live.record(["carrier.angle", "pinion.angle"])
    ring, pinion = frames(live, "ring", TIMES), frames(live, "pinion", TIMES)
    carrier = np.interp(TIMES, record["time"], record["carrier.angle"])
    assert np.allclose(turns(ring, np.array([1.0, 0.0, 0.0])), carrier[1:] - carrier[0], rtol=1e-6)
    # the axis of the pinion points to its shaft
    axis = pinion[0][:3, 2]
    point, centre = np.array(live.ask("['pitchPoint', 'ringCentre'].map((name) => page.view.differential.drive.place[name].toArray())"))
    turned = turns(pinion, axis)
    assert np.allclose(turned, -sign * RING / PINION * (carrier[1:] - carrier[0]), rtol=1e-6)
    # both move the pitch point alike
    speeds = np.cross([carrier[1] - carrier[0], 0.0, 0.0], point - centre), np.cross(turned[0] * axis, point - pinion[0][:3, 3])
    assert np.allclose(*speeds, rtol=1e-6, atol=1e-6)
    assert np.sign(centre[0]) == sign
    found(f"{side}: {turned[-1] / (carrier[-1] - carrier[0]):.4f}")


def test_the_joint_of_the_drawn_propeller_shaft_turns_as_in_the_unit(live):
    joint = 0.5
    live.go(address_of({**SHORT, "effects.propeller_shaft": "true", "propeller_shaft.joint_angle": str(joint)}))
    live.wait("page.view.differential.drive?.shaft")
    record = live.record(["propeller.angle"])
    times = np.linspace(0.0, TIMES[-1], 12)
    tube, end = frames(live, "shaft.tube", times), frames(live, "shaft.end", times)
    angle = np.interp(times, record["time"], record["propeller.angle"])
    driven = turns(end, end[0][:3, 2])
    assert np.allclose(driven, -(angle[1:] - angle[0]), atol=1e-6)
    output = turns(tube, tube[0][:3, 2])
    assert np.allclose(np.tan(output), cos(joint) * np.tan(driven), rtol=1e-6)
    assert np.isclose(tube[0][:3, 2] @ end[0][:3, 2], cos(joint))


def test_the_drive_commands_the_pinion_and_no_longer_the_carrier(live, found):
    live.go(address_of(SHORT))
    speed = 100.0
    for name, value in [("pinion.speed_command", speed), ("carrier.speed_command", 20.0)]:
        answer = live.put(name, f"{degrees(value):.10g}")
        assert "over" in answer, answer
    record = live.record(["pinion.speed", "carrier.speed"])
    assert np.allclose(record["pinion.speed"], speed, rtol=1e-9)
    assert np.allclose(record["carrier.speed"], speed * PINION / RING, rtol=1e-9)
    warning = live.control("carrier.speed_command").locator("xpath=..").locator(".warning").text_content()
    assert "changes nothing" in warning and "effects.final_drive" in warning
    live.ask("async () => { page.seek(0.02); await ear.frame(); }")
    assert live.text("pinion-speed") == "5730 °/s"
    live.page.locator("#choose summary").click()
    before = live.number
    live.page.locator("#trace-list input[value='pinion.speed']").check()
    live.wait("before => ear.asked.number > before", before)
    assert "over" in live.answer() and "pinion.speed" in live.link()["show"].split(" ")
    live.page.locator("#choose summary").click()
    found(f"{speed:.0f} rad/s of the pinion, {record['carrier.speed'][-1]:.2f} rad/s of the carrier")


def test_forces_are_shown_in_one_unit(live):
    live.go("scene=study_straight&stop_time=0.05&show=left.normal_force")
    drawn(live, False)
    live.ask("async () => { page.seek(0.05); page.refresh(); await ear.frame(); }")
    traces = "[...document.querySelectorAll('.legend span')].map((each) => each.textContent)"
    texts = [live.text("scale"), live.text("legend"), *live.ask(traces)]
    assert all(text.endswith(" kN") for text in texts), texts
    assert live.ask("page.traces.plots[0].plot.axes[1].label") == "kN"
    # below 1 kN, all of them are in N
    live.go("scene=study_straight&stop_time=0.05&show=left.normal_force&left.load_torque=10&right.load_torque=10")
    live.ask("async () => { page.seek(0.05); page.refresh(); await ear.frame(); }")
    texts = [live.text("scale"), live.text("legend"), *live.ask(traces)]
    assert all(text.endswith(" N") for text in texts), texts
    assert live.ask("page.traces.plots[0].plot.axes[1].label") == "N"


@pytest.mark.parametrize("name, pitch_angle", [("bevel", BEVEL), ("helical", HELICAL)])
@pytest.mark.parametrize("side", ["left", "right"])
def test_its_view_shows_a_pinion_that_moves(sized, pytestconfig, side, name, pitch_angle):
    folder = pytestconfig.getoption("shots")
    live = sized(WINDOWS["desk"], "light")
    live.go(address_of({**SHORT, "final_drive.ring_side": side, "final_drive.pitch_angle": pitch_angle, "view": "drive"}))
    drawn(live)
    files = [folder and folder / f"drive_{name}_{side}_{n}.png" for n in (1, 2)]
    first, second = (picture(live, share, file) for share, file in zip((0.3, 0.31), files))
    copper, _ = shares(first)
    assert copper > 0.005, f"{copper:.3f} of the picture has the colour of the pinion"
    moved = np.mean(np.abs(first - second).max(axis=-1) > 16.0)
    assert moved > 0.004, f"{moved:.4f} of the picture differs between two times"
