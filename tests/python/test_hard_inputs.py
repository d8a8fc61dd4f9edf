"""Values that are not numbers, absurd, or out of range: refused with variable, value, unit and range, without harm."""

import math
import re

import pytest
from bevel_differential import DifferentialError
from driving import put

DISCARD, ERROR = 2, 3
NONE, ENDLESS = float("nan"), [float("inf"), float("-inf")]


def of(fmu, causality, kind):
    return [v for v in fmu.variables.values() if (v.causality, v.kind) == (causality, kind)]


def refusal(opened, name, value):
    """Line of the log that refuses a value, at the call that sets it or at the end of initialisation."""
    begin = len(opened.messages)
    with pytest.raises(DifferentialError) as failure:
        put(opened, name, value)
        opened.initialise()
    assert failure.value.status in (DISCARD, ERROR), (name, value)
    lines = "\n".join(opened.messages[begin:]).replace(": ", ":\n", 1).splitlines()
    messages = [line.strip() for line in lines if line.strip().startswith(f"{name}: ")]
    assert len(messages) == 1, (name, value, opened.messages[begin:])
    return messages[0]


def assert_usable_after_reset(opened):
    opened.reset()
    opened.initialise()
    opened.step(1e-3)
    assert opened.get("left.speed") == pytest.approx(math.radians(2861.0), rel=1e-6)
    assert abs(opened.get("solver.energy_residual")) < 1e-6 * opened.get("power.in") * 1e-3
    opened.reset()


def assert_message(message, variable, value):
    """Asserts that a message contains variable, value, unit and range."""
    unit = "" if variable.unit in (None, "1") else variable.unit
    assert unit in message, message
    if math.isfinite(value):
        shown = re.match(rf"{re.escape(variable.name)}: (\S+)", message)[1]
        assert float(shown.rstrip(",:;")) == pytest.approx(value, rel=1e-6), message
    else:
        assert "not a finite number" in message, message
    if variable.minimum is None:
        assert "[" not in message, message
        return
    if variable.maximum - variable.minimum < 1e-5 and math.isfinite(value):
        assert "is not 90 deg, the only possible value" in message, message
        return
    low, high = re.search(r"\[(\S+), (\S+)\]", message).groups()
    assert [float(low), float(high)] == pytest.approx([variable.minimum, variable.maximum], rel=1e-9), message


@pytest.mark.parametrize("value", [NONE, *ENDLESS, 1e300, -1e300])
def test_an_absurd_input_is_refused_by_name_value_unit_and_range_and_the_run_goes_on(fmu, outputs, value):
    with fmu.open() as undisturbed, fmu.open() as opened:
        for one in (undisturbed, opened):
            one.initialise()
            one.step(1e-3)
        for variable in of(fmu, "input", "Real"):
            kept, begin = opened.get(variable.name), len(opened.messages)
            with pytest.raises(DifferentialError) as failure:
                put(opened, variable.name, value)
            assert failure.value.status == DISCARD
            assert_message(opened.messages[begin].split(": ", 1)[1], variable, value)
            assert opened.get(variable.name) == kept
        for one in (undisturbed, opened):
            one.step(1e-3)
        assert opened.read(outputs) == undisturbed.read(outputs)
        assert_usable_after_reset(opened)


@pytest.mark.parametrize("causality", ["parameter", "input"])
def test_a_value_out_of_its_range_is_refused_by_name_value_unit_and_range(fmu, causality):
    with fmu.open() as opened:
        for variable in of(fmu, causality, "Real"):
            low, high = variable.minimum, variable.maximum
            outside = [low - max(abs(low), 2e-9 * max(1.0, high)), 2.0 * high] if low is not None else []
            for value in [*outside, NONE, *ENDLESS]:
                assert_message(refusal(opened, variable.name, value), variable, value)
                assert_usable_after_reset(opened)


def test_a_whole_number_out_of_its_range_is_refused_by_name_value_and_range(fmu):
    with fmu.open() as opened:
        for variable in of(fmu, "parameter", "Integer"):
            # a seed may be any number in its type
            for value in [v for v in (variable.minimum - 1, variable.maximum + 1) if -2**31 <= v < 2**31]:
                assert_message(refusal(opened, variable.name, value), variable, value)
                assert_usable_after_reset(opened)


def test_an_unknown_choice_is_refused_with_the_list_of_choices(fmu):
    with fmu.open() as opened:
        for variable in fmu.variables.values():
            if variable.kind == "Enumeration" and variable.causality == "parameter":
                literals = [f"{number} = {name}" for name, number in variable.literals.items()]
                for value in (0, -3, len(literals) + 1):
                    message = refusal(opened, variable.name, value)
                    assert all(literal in message for literal in literals), message
                    assert_usable_after_reset(opened)


def test_all_wrong_values_are_reported_together(fmu):
    wrong = {"geometry.face_width": -1.0, "inertia.carrier": 0.0, "contact.exponent": 7.0, "material.density": 1e9}
    with fmu.open() as opened:
        opened.set(wrong)
        with pytest.raises(DifferentialError) as failure:
            opened.initialise()
        assert failure.value.status == ERROR
        message = "\n".join(opened.messages)
        assert all(name in message for name in wrong), message
        assert_usable_after_reset(opened)


def test_loads_that_break_the_run_discard_the_step_and_leave_a_state_to_go_on_from(started, outputs):
    for load in (5e6, 1e8, -1e8):
        opened = started()
        opened.step(1e-3)
        kept, before = opened.raw.getFMUstate(), opened.read(outputs)
        opened.set({"right.load_torque": load})
        with pytest.raises(DifferentialError) as failure:
            opened.do_step(1e-3, 1e-3)
        assert failure.value.status == DISCARD
        assert "t = 0.001" in opened.messages[-1] and "fmi2SetFMUstate" in opened.messages[-1]
        assert all(map(math.isfinite, opened.read(outputs)))
        opened.raw.setFMUstate(kept)
        assert opened.read(outputs) == before
        opened.do_step(1e-3, 1e-3)
        assert abs(opened.get("solver.energy_residual")) < 1e-6 * opened.get("power.in") * 2e-3
        opened.raw.freeFMUstate(kept)
        assert_usable_after_reset(opened)
