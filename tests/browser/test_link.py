"""A link contains the whole set-up: opened in another page, it gives the same values and the same record."""

import numpy as np
import pytest

from live import address_of

OWN = {"geometry.planet_count": "4", "geometry.module": "4.8", "contact.law": "line", "effects.bearing_drag": True,
       "carrier.torque_command": "1650.25", "solver.relative_tolerance": "3e-7"}
# a short run, because a few points are enough
SHORT = "scene=study_straight&left.load_torque=800&stop_time=0.02"
OUTPUTS = ["left.speed", "right.speed", "left.normal_force", "planet[1].left_normal_force", "left.angle", "solver.energy_residual"]


def test_a_link_restores_all_values_and_gives_the_same_record(live, fresh, fmu, found):
    live.go(address_of({"scene": "torque_bias", "show": "left.normal_force left.speed"}))
    for name, value in OWN.items():
        answer = live.put(name, value, "started", "refused")
        assert "started" in answer, f"{name}: {answer}"
    live.page.locator("#duration").fill("0.31")
    before = live.number
    live.page.locator("#duration").press("Enter")
    live.wait("before => ear.asked.number > before", before)
    assert "over" in live.answer()
    address = live.page.url
    other = fresh(address.split("#")[1])
    assert other.page.url == address
    settable = [each.name for each in fmu.variables.values() if each.causality in ("parameter", "input")]
    values = "names => names.map((name) => page.setup.value(name))"
    assert other.ask(values, settable) == live.ask(values, settable)
    assert {*OWN} <= {*other.link()}
    shown = "names => names.map((name) => document.getElementById(`set ${name}`)).map((c) => [c.value, c.checked])"
    assert other.ask(shown, settable) == live.ask(shown, settable)
    assert other.ask("ear.asked.scene") == live.ask("ear.asked.scene")
    one, two = live.record(OUTPUTS), other.record(OUTPUTS)
    for name in ["time", *OUTPUTS]:
        assert np.array_equal(one[name].view(np.uint64), two[name].view(np.uint64)), name
    assert one["time"][-1] == 0.31
    found(f"{len(OWN)} values and the duration; {len(one['time'])} points × {len(OUTPUTS)} outputs, same bits")


def follow(live, fragment):
    """Opens a link that may contain errors. Returns the answer to its run."""
    before = live.number
    live.ask("fragment => { location.hash = fragment; }", fragment)
    live.wait("before => ear.asked.number > before", before)
    return live.answer()


@pytest.mark.parametrize("odd", ["scene=nonsense", "no.such=1", "left.speed=3", "stop_time=-1", "show=no.such"])
def test_words_of_an_address_that_mean_nothing_are_named_and_the_rest_is_simulated(live, odd):
    # these links contain no valid scene, so the first scene runs to its end
    others = "left.load_torque=800" if odd.startswith(("scene", "stop_time")) else SHORT
    assert "over" in follow(live, f"{others}&{odd}")
    assert odd in live.message() and live.value("left.load_torque") == 800.0


@pytest.mark.parametrize("name, text", [
    ("geometry.module", "thick"), ("geometry.planet_teeth", "10.5"), ("tooth_errors.seed", "4294967301"),
    ("effects.tooth_friction", "maybe"), ("contact.law", "99"),
])
def test_values_of_an_address_that_are_none_are_named_at_their_controls_and_the_rest_is_simulated(live, name, text):
    assert "over" in follow(live, f"{SHORT}&{name}={text}")
    assert name in live.message() and live.value("left.load_torque") == 800.0
    assert [*live.complaints()] == [name] and text in live.complaints()[name]
    assert name not in live.link()


def test_the_link_is_copied(live):
    live.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    live.go("scene=clunk&geometry.module=0.0051")
    live.page.locator("#copy").click()
    live.wait("document.getElementById('message').textContent === 'Link copied.'")
    assert live.ask("navigator.clipboard.readText()") == live.page.url
