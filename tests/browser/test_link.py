"""A link is a set-up: an address that is opened elsewhere gives the same values and the same record."""

import numpy as np
import pytest
from live import address_of

OWN = {"geometry.planet_count": "4", "geometry.module": "4.8", "contact.law": "line", "effects.bearing_drag": True,
       "left.load_torque": "650.25", "solver.tolerance": "3e-7"}
OUTPUTS = ["left.speed", "right.speed", "left.normal_force", "planet[1].left_normal_force", "heat.drag", "solver.energy_residual"]


def test_a_link_restores_all_values_and_gives_the_same_record(live, fresh, found):
    live.go(address_of({"scene": "torque_bias", "show": "left.normal_force left.speed"}))
    for name, value in OWN.items():
        answer = live.put(name, value)
        assert "over" in answer, f"{name}: {answer}"
    live.page.locator("#duration").fill("0.31")
    before = live.number
    live.page.locator("#duration").press("Enter")
    live.wait("before => ear.asked.number > before", before)
    assert "over" in live.answer()
    address = live.page.url
    other = fresh(address.split("#")[1])
    assert other.page.url == address
    values = "page.table.variables.filter(({ causality }) => ['parameter', 'input'].includes(causality)).map(({ name }) => [name, page.setup.value(name)])"
    assert other.ask(values) == live.ask(values)
    assert {*OWN} <= {*other.link()}
    for name in OWN:
        assert other.page.locator(f'[id="set {name}"]').evaluate("c => c.value + c.checked") == live.page.locator(
            f'[id="set {name}"]').evaluate("c => c.value + c.checked"), name
    assert other.ask("ear.asked.scene") == live.ask("ear.asked.scene")
    one, two = live.record(OUTPUTS), other.record(OUTPUTS)
    for name in ["time", *OUTPUTS]:
        assert np.array_equal(one[name].view(np.uint64), two[name].view(np.uint64)), name
    assert one["time"][-1] == 0.31
    found(f"{len(OWN)} values and the duration; {len(one['time'])} points × {len(OUTPUTS)} outputs, same bits")


@pytest.mark.parametrize("odd, said", [
    ("scene=nonsense", "scene nonsense"),
    ("scene=study_straight&geometry.module=thick", "geometry.module=thick"),
    ("scene=study_straight&no.such=1", "no.such=1"),
    ("scene=study_straight&effects.tooth_friction=maybe", "effects.tooth_friction=maybe"),
    ("scene=study_straight&left.speed=3", "left.speed=3"),
    ("scene=study_straight&geometry.planet_teeth=10.5", "geometry.planet_teeth=10.5"),
    ("scene=study_straight&tooth_errors.seed=4294967301", "tooth_errors.seed=4294967301"),
])
def test_what_an_address_has_wrong_is_said_and_the_rest_is_simulated(live, odd, said):
    before = live.number
    live.ask("fragment => { location.hash = fragment; }", odd)
    live.wait("before => ear.asked.number > before", before)
    assert "over" in live.answer()
    assert said in live.message()


def test_a_number_of_no_choice_in_an_address_is_refused_by_the_fmu(live, fmu):
    answer = live.go("scene=study_straight&contact.law=99")
    with fmu.open() as instance:
        with pytest.raises(Exception):
            instance.raw.setInteger([fmu.variable("contact.law").reference], [99])
        assert answer["refused"] == instance.messages[-1]
    assert live.complaints() == {"contact.law": answer["refused"].split(": ", 1)[1]}
    assert "over" in live.put("contact.law", "line") and live.complaints() == {}


def test_the_link_is_copied(fresh):
    live = fresh("scene=clunk&geometry.module=0.0051", permissions=["clipboard-read", "clipboard-write"])
    live.page.locator("#copy").click()
    live.wait("document.getElementById('message').textContent === 'Link copied.'")
    assert live.ask("navigator.clipboard.readText()") == live.page.url
