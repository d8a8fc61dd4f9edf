"""Dog clutches and clutches on command in the page: they are drawn only with their effects, and show phase and torque."""

import numpy as np
import pytest

from live import address_of

SHORT = {"scene": "study_straight", "stop_time": "0.2"}
# a dog clutch needs a wheel with inertia
DOG = {**SHORT, "effects.half_shaft": "true", "inertia.left_end": "0.5", "inertia.right_end": "0.5", "effects.disconnect": "true"}
# wheels so heavy that a clutch does not stop them within the run
HEAVY = {"effects.half_shaft": "true", "inertia.left_end": "50", "inertia.right_end": "50"}
CLUTCHES = {**SHORT, "effects.clutches": "true"}
SIDES = ["left", "right"]
# [time, values]: the right dog clutch is to open under load, opens without load, and cannot close again, because its wheel becomes slow
CHANGES = [[0.05, {"right.dog_command": 0.0}], [0.1, {"left.load_torque": 0.0, "right.load_torque": 0.0}],
           [0.11, {"right.load_torque": 500.0}], [0.15, {"right.dog_command": 1.0}]]
PHASES = {0.04: "closed", 0.09: "waits for low torque", 0.14: "open", 0.19: "waits for speed"}


def drawn(live):
    """Waits for gears with the clutches of the set-up. Returns those with a dog clutch and those with plates, by side."""
    live.wait("!page.shapes.waiting.length && page.view.differential.halfShafts")
    dogs, plates = live.ask("((shafts) => [shafts.map(({ sleeve }) => Boolean(sleeve)), shafts.map(({ plates }) => plates.length > 0)])"
                            "(page.view.differential.halfShafts)")
    return [[side for side, is_there in zip(SIDES, each) if is_there] for each in (dogs, plates)]


def visible(live):
    """Names of the visible lines about clutches among the numbers next to the picture."""
    return [name for part in ("dog", "clutch") for name in (f"{side}-{part}" for side in SIDES) if live.page.locator(f"#{name}").is_visible()]


def show(live, time):
    """Shows the picture at a time."""
    live.ask("async (time) => { page.seek(time); await ear.frame(); }", time)


def test_dog_clutches_and_plates_are_drawn_only_with_their_effects(live):
    live.go(address_of(SHORT))
    assert drawn(live) == [[], []] and visible(live) == []
    plain = live.ask("page.view.differential.end")
    for sides, wanted in [("right", ["right"]), ("left", ["left"]), ("both", SIDES)]:
        live.go(address_of({**DOG, "disconnect.sides": sides}))
        assert drawn(live) == [wanted, []] and visible(live) == [f"{side}-dog" for side in wanted], sides
    assert live.ask("page.view.differential.end") > plain
    live.go(address_of(CLUTCHES))
    assert drawn(live) == [[], SIDES] and visible(live) == [f"{side}-clutch" for side in SIDES]
    assert "over" in live.put("effects.clutches", False)
    assert drawn(live) == [[], []] and visible(live) == [] and live.ask("page.view.differential.end") == plain


@pytest.fixture
def changed(live):
    """changed(changes): the scene with other changes of its inputs. The end of the test restores them."""
    before = live.ask("page.setup.scene.changes")

    def change(changes):
        number = live.number
        live.ask("changes => { page.setup.scene.changes = changes; page.changed(); }", changes)
        live.wait("number => ear.asked.number > number", number)
        return live.answer()

    yield change
    live.ask("before => { page.table.scene('study_straight').changes = before; }", before)


def test_rings_are_apart_while_the_dog_clutch_is_open_and_the_phase_has_words(live, changed, found):
    live.go(address_of(DOG))
    assert "over" in changed(CHANGES)
    assert drawn(live) == [["right"], []]
    record = live.record(["right.angle", "right.wheel_angle", "right.dog_phase"])
    for time, words in PHASES.items():
        show(live, time)
        assert live.text("right-dog") == words
        assert not {"cameras overlaps figures", "figures overlaps cameras"} & set(live.ask("covered()")), words
        place, slide, gear, wheel = live.ask(
            "(({ sleeve, slide, parts: { gear, wheel } }) => [sleeve.position.x, slide, gear.rotation.x, wheel.rotation.x])"
            "(page.view.differential.halfShafts[1])")
        assert slide > 0.0 and place == (0.0 if words in ("closed", "waits for low torque") else -slide)
        angles = [np.interp(time, record["time"], record[f"right.{name}"]) for name in ("angle", "wheel_angle")]
        assert np.allclose([gear, wheel], angles, rtol=1e-9)
    # at last, the wheel is more than a tooth behind
    assert abs(gear - wheel) > 2.0 * np.pi / 24
    found(f"{len(PHASES)} phases")


def test_plates_are_lit_in_proportion_to_the_torque(live, found):
    live.go(address_of({**CLUTCHES, **HEAVY, "clutches.left_ratio": "0"}))
    drawn(live)

    def seen():
        show(live, 0.1)
        return live.text("left-clutch"), live.ask("page.view.differential.halfShafts.map(({ plates: [, drum] }) => drum.color.r)")

    dark, (own, _) = seen()
    assert dark == "0 N·m"
    reds = []
    for command in ("0.25", "0.5", "1"):
        assert "over" in live.put("left.clutch_command", command)
        text, (left, right) = seen()
        assert text == f"−{1000 * float(command):g} N·m" and right == own
        reds.append(left)
    assert own < reds[0] < reds[1] and np.isclose(reds[2] - reds[1], 2.0 * (reds[1] - reds[0]), rtol=1e-3)
    # the shaft of a clutch with the ratio 0 stands still
    assert live.ask("page.view.differential.halfShafts.map(({ parts: { drum } }) => drum.rotation.x === 0)") == [True, False]
    found(", ".join(f"{red:.2f}" for red in reds))
