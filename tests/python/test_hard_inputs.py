"""Values that are no numbers, absurd, or out of range: refused with variable, value, unit and range, without harm."""

import math
import re

import pytest
from fmpy.fmi1 import FMICallException

DISCARD, ERROR = 2, 3
NONE, ENDLESS = float("nan"), [float("inf"), float("-inf")]


def reals(description, causality):
    return [v for v in description.modelVariables if v.causality == causality and v.type == "Real"]


def refusal(opened, name, value):
    """The line of the log that refuses a value, at the call that sets it or at the end of initialisation."""
    begin = len(opened.log)
    with pytest.raises(FMICallException) as failure:
        opened.set(name, value)
        opened.initialise()
    assert failure.value.status in (DISCARD, ERROR), (name, value)
    lines = "\n".join(opened.log[begin:]).replace(": ", ":\n", 1).splitlines()
    messages = [line.strip() for line in lines if line.strip().startswith(f"{name}: ")]
    assert len(messages) == 1, (name, value, opened.log[begin:])
    return messages[0]


def assert_usable_after_reset(opened):
    opened.fmu.reset()
    opened.initialise()
    opened.fmu.doStep(0.0, 1e-3)
    assert opened.get("left.speed") == pytest.approx(math.radians(2861.0), rel=1e-6)
    assert abs(opened.get("solver.energy_residual")) < 1e-6 * opened.get("power.in") * 1e-3
    opened.fmu.reset()


def assert_message(message, variable, value):
    """Variable, value, unit and range."""
    unit = "" if variable.unit in (None, "1") else variable.unit
    assert unit in message, message
    if math.isfinite(value):
        shown = re.match(rf"{re.escape(variable.name)}: (\S+)", message)[1]
        assert float(shown.rstrip(",:;")) == pytest.approx(value, rel=1e-6), message
    else:
        assert "not a finite number" in message, message
    low, high = re.search(r"\[(\S+), (\S+)\]", message).groups()
    assert [float(low), float(high)] == pytest.approx([float(variable.min), float(variable.max)], rel=1e-9), message


@pytest.mark.parametrize("value", [NONE, *ENDLESS, 1e300, -1e300])
def test_an_absurd_input_is_refused_by_name_value_unit_and_range_and_the_run_goes_on(open_fmu, description, value):
    with open_fmu() as undisturbed, open_fmu() as opened:
        for one in (undisturbed, opened):
            one.initialise()
            one.fmu.doStep(0.0, 1e-3)
        for variable in reals(description, "input"):
            kept, begin = opened.get(variable.name), len(opened.log)
            with pytest.raises(FMICallException) as failure:
                opened.set(variable.name, value)
            assert failure.value.status in (DISCARD, ERROR)
            assert_message(opened.log[begin].split(": ", 1)[1], variable, value)
            assert opened.get(variable.name) == kept
        outputs = [v.valueReference for v in description.modelVariables if v.causality == "output"]
        for one in (undisturbed, opened):
            one.fmu.doStep(1e-3, 1e-3)
        assert opened.fmu.getReal(outputs) == undisturbed.fmu.getReal(outputs)
        assert_usable_after_reset(opened)


@pytest.mark.parametrize("causality", ["parameter", "input"])
def test_a_value_out_of_its_range_is_refused_by_name_value_unit_and_range(open_fmu, description, causality):
    with open_fmu() as opened:
        for variable in reals(description, causality):
            low, high = float(variable.min), float(variable.max)
            for value in [low - max(abs(low), 1e-9 * high), 2.0 * high, NONE, *ENDLESS]:
                assert_message(refusal(opened, variable.name, value), variable, value)
                assert_usable_after_reset(opened)


def test_a_whole_number_out_of_its_range_is_refused_by_name_value_and_range(open_fmu, description):
    with open_fmu() as opened:
        for variable in description.modelVariables:
            if variable.type == "Integer" and variable.causality == "parameter":
                low, high = int(variable.min), int(variable.max)
                # a seed may be any number there is
                for value in [v for v in (low - 1, high + 1) if -2**31 <= v < 2**31]:
                    assert_message(refusal(opened, variable.name, value), variable, value)
                    assert_usable_after_reset(opened)


def test_a_choice_that_there_is_none_is_refused_with_all_that_there_are(open_fmu, description):
    with open_fmu() as opened:
        for variable in description.modelVariables:
            if variable.type == "Enumeration":
                literals = [f"{item.value} = {item.name}" for item in variable.declaredType.items]
                for value in (0, -3, len(literals) + 1):
                    message = refusal(opened, variable.name, value)
                    assert all(literal in message for literal in literals), message
                    assert_usable_after_reset(opened)


def test_all_that_is_wrong_is_told_at_once(open_fmu):
    wrong = {"geometry.face_width": -1.0, "inertia.carrier": 0.0, "contact.exponent": 7.0, "material.density": 1e9}
    with open_fmu() as opened:
        for name, value in wrong.items():
            opened.set(name, value)
        with pytest.raises(FMICallException) as failure:
            opened.initialise()
        assert failure.value.status == ERROR
        message = "\n".join(opened.log)
        assert all(name in message for name in wrong), message
        assert_usable_after_reset(opened)


@pytest.mark.parametrize("size", [0.0, -1e-3, NONE, *ENDLESS])
def test_a_communication_step_that_is_none_is_refused(open_fmu, size):
    with open_fmu() as opened:
        opened.initialise()
        with pytest.raises(FMICallException) as failure:
            opened.fmu.doStep(0.0, size)
        assert failure.value.status == ERROR
        assert "communication step size" in opened.log[-1] and "finite and positive" in opened.log[-1]
        assert_usable_after_reset(opened)


def test_loads_that_break_the_run_discard_the_step_and_leave_a_state_to_go_on_from(open_fmu, description):
    outputs = [v.valueReference for v in description.modelVariables if v.causality == "output"]
    for load in (5e6, 1e8, -1e8):
        with open_fmu() as opened:
            opened.initialise()
            opened.fmu.doStep(0.0, 1e-3)
            kept, before = opened.fmu.getFMUstate(), opened.fmu.getReal(outputs)
            opened.set("right.load_torque", load)
            with pytest.raises(FMICallException) as failure:
                opened.fmu.doStep(1e-3, 1e-3)
            assert failure.value.status == DISCARD
            assert "t = 0.001" in opened.log[-1] and "fmi2SetFMUstate" in opened.log[-1]
            assert all(map(math.isfinite, opened.fmu.getReal(outputs)))
            opened.fmu.setFMUstate(kept)
            assert opened.fmu.getReal(outputs) == before
            opened.fmu.doStep(1e-3, 1e-3)
            assert abs(opened.get("solver.energy_residual")) < 1e-6 * opened.get("power.in") * 2e-3
            opened.fmu.freeFMUstate(kept)
            assert_usable_after_reset(opened)
