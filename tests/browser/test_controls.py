"""Every parameter and input can be set from its control. The page accepts and refuses values exactly like the native FMU."""

from math import degrees

import pytest
from bevel_differential import DifferentialError, Scene

# short, because these tests check values and not results
SCENE, STOP = "study_straight", 0.02
# largest Integer of FMI
LARGEST = 2**31 - 1
FRAGMENT = f"scene={SCENE}&stop_time={STOP}"
# unit in which the page shows all speeds at first
SPEEDS = "deg/s"


@pytest.fixture
def short(live):
    """The page with a run of a few points."""
    live.go(FRAGMENT)
    return live


def settable(fmu):
    """Parameters and inputs with more than one value."""
    return [variable for variable in fmu.variables.values() if variable.causality in ("parameter", "input")
            and not (variable.kind == "Real" and variable.minimum is not None and variable.maximum - variable.minimum < 1e-5)]


def text_of(number):
    """A number as a user types it."""
    return f"{number:.5g}"


def shown(variable, value):
    """Unit of the page, and the value in it."""
    return (SPEEDS, degrees(value)) if variable.unit == "rad/s" else variable.shown(value)


def in_si(variable, text):
    """Value in SI of a text that is typed in the unit of the page."""
    return variable.number((text, shown(variable, 0.0)[0] or None))


def another(variable, value):
    """A valid value that differs from `value`, as (value given to the control, value in SI)."""
    if variable.kind == "Boolean":
        return not value, not value
    if variable.kind == "Enumeration":
        name, number = next(item for item in variable.literals.items() if item[1] != value)
        return name, number
    low, high = variable.minimum, variable.maximum
    if variable.kind == "Integer":
        number = value + 1 if high is None or value < high else value - 1
        return str(number), number
    candidates = [1.1 * value, 0.9 * value, *([low + 0.3 * (high - low), low + 0.6 * (high - low)] if low is not None else [1.0])]
    for candidate in candidates:
        text = text_of(shown(variable, candidate)[1])
        number = in_si(variable, text)
        if number != value and (low is None or low <= number <= high):
            return text, number
    raise AssertionError(f"{variable.name}: no other value")


def from_link(variable, word):
    """Value in SI of a text in a link."""
    if variable.kind == "Boolean":
        return {"true": True, "false": False}[word]
    return variable.literals[word] if variable.literals else float(word)


def beyond(variable):
    """A value above the range, as (text that a user types, value in SI)."""
    if variable.kind == "Integer":
        return str(variable.maximum + 1), variable.maximum + 1
    text = text_of(shown(variable, 2.0 * variable.maximum if variable.maximum > 0.0 else 1.0)[1])
    return text, in_si(variable, text)


class Native:
    """The native FMU with the values of the scene, for comparison with the page."""

    def __init__(self, fmu):
        self.fmu, self.values = fmu, Scene.load(SCENE).values

    def says(self, name, value):
        """Message in one line if the FMU refuses to start with this value, otherwise None."""
        pairs = [(self.fmu.variable(each), number) for each, number in {**self.values, name: value}.items()]
        with self.fmu.open() as instance:
            try:
                # without the checks of the Python package
                instance.start(pairs, STOP)
            except DifferentialError as refusal:
                return str(refusal).replace("\n", " ")
        return None


def subject(fmu, message):
    """(variable that a message names, message from that name on)."""
    words = message.split()
    name = next(word[:-1] for word in words if word.endswith(":") and word[:-1] in fmu.variables)
    return name, message[message.index(f"{name}:"):]


def check(fmu, native, name, value, answer, seen):
    """Checks that the page and the native FMU both accept a value, or both refuse it with the same message.
    Returns true if the value was refused."""
    refusal = native.says(name, value)
    if refusal is None:
        assert "started" in answer, f"{name} = {value}: {answer}"
        return False
    assert answer.get("refused") == refusal, f"{name} = {value}: {answer}"
    place, text = subject(fmu, refusal)
    assert seen["complaints"].get(place) == text, f"{name} = {value}"
    assert place in seen["message"]
    return True


def by_hand(live, name, given):
    """Sets a value and restores it, with keys and mouse. Returns for each the worker's answer and what the page then shows."""
    kinds = ("started", "refused")
    assert live.control(name).evaluate("control => coverOf(control)") is None, name
    put = {"answer": live.put(name, given, *kinds), **live.seen(name)}
    return [put, {"answer": live.back(name, *kinds), **live.seen(name)}]


def given_and_back(live, cases):
    """Sets and restores the values of `cases`, {variable: value as a user gives it}. Returns {name: result as of `by_hand`}.
    The first variable of each kind is set by hand, all others within the page."""
    hand = {variable.kind: variable.name for variable in reversed(cases)}.values()
    swept = [{"name": each.name, "given": given} for each, given in cases.items() if each.name not in hand]
    outcomes = live.ask("cases => sweep(cases)", swept)
    return {case["name"]: outcome for case, outcome in zip(swept, outcomes)} | {
        each.name: by_hand(live, each.name, given) for each, given in cases.items() if each.name in hand}


def test_every_parameter_and_input_can_be_set_from_its_control(short, fmu, found):
    native, refused = Native(fmu), []
    variables = settable(fmu)
    before = short.ask("names => names.map((name) => page.setup.value(name))", [each.name for each in variables])
    others = [another(variable, value) for variable, value in zip(variables, before)]
    outcomes = given_and_back(short, {variable: given for variable, (given, _) in zip(variables, others)})
    for variable, value, (_, wanted) in zip(variables, before, others):
        name = variable.name
        put, back = outcomes[name]
        assert put["value"] == wanted, name
        assert put["word"] is not None and from_link(variable, put["word"]) == wanted, name
        if check(fmu, native, name, wanted, put["answer"], put):
            refused.append(name)
        assert "started" in back["answer"], name
        assert back["value"] == value and back["word"] is None and back["complaints"] == {}, name
    # the check proves little unless most values are accepted
    assert len(refused) < len(variables) / 4
    found(f"{len(variables)} variables; of {len(refused)} the FMU refuses the other value")


def test_a_value_beyond_the_range_shows_the_message_of_the_fmu_at_its_control(short, fmu, found):
    native = Native(fmu)
    ranged = [each for each in settable(fmu) if each.maximum is not None and (each.kind == "Real" or each.maximum < LARGEST)]
    # the first variable of each kind and unit, and every third variable
    first = {(each.kind, each.unit): each for each in reversed(ranged)}.values()
    ranged = [each for k, each in enumerate(ranged) if k % 3 == 0 or each in first]
    outcomes = given_and_back(short, {each: beyond(each)[0] for each in ranged})
    for variable in ranged:
        name, (text, value) = variable.name, beyond(variable)
        put, back = outcomes[name]
        assert check(fmu, native, name, value, put["answer"], put), f"{name} = {text} is not refused"
        assert name in put["complaints"]
        assert "started" in back["answer"], name
        assert back["complaints"] == {} and back["message"] == "", name
    assert "over" in short.answer()
    whole = sum(each.kind == "Integer" for each in ranged)
    found(f"{len(ranged)} variables, {whole} of them whole numbers")


@pytest.mark.parametrize("name, text, message", [
    ("geometry.module", "", "“” is not a number"),
    ("geometry.module", "abc", "“abc” is not a number"),
    ("left.brake_torque", "3 N", "“3 N” is not a number"),
    ("geometry.planet_teeth", "10.5", "10.5 is not a whole number"),
    ("tooth_errors.seed", str(LARGEST + 1), f"{LARGEST + 1} is not a whole number"),
])
def test_what_the_fmu_cannot_be_given_is_refused_at_its_control_and_not_simulated(short, name, text, message):
    number, control = short.number, short.control(name)
    control.fill(text)
    control.press("Enter")
    short.wait("() => [...document.querySelectorAll('.fault')].some((each) => !each.hidden)")
    complaints = short.complaints()
    assert [*complaints] == [name] and complaints[name].startswith(f"{name}: {message}")
    assert short.number == number and name not in short.link()
    assert "over" in short.put(name, "12") and short.complaints() == {}


@pytest.mark.parametrize("text", ["nan", "inf", "-inf"])
@pytest.mark.parametrize("name", ["geometry.module", "left.load_torque"])
def test_numbers_that_are_not_finite_are_refused_in_the_words_of_the_fmu(short, fmu, name, text):
    assert check(fmu, Native(fmu), name, float(text), short.put(name, text), short.seen(name))
    assert "started" in short.back(name, "started", "refused") and short.complaints() == {}


def test_values_that_do_not_fit_together_stand_at_the_control_that_can_mend_them(live, fmu):
    native = Native(fmu)
    native.values["scene.gear_contact"] = fmu.variable("scene.gear_contact").number("ideal")
    live.put("scene.gear_contact", "ideal")
    answer = live.put("effects.tooth_friction", True)
    assert check(fmu, native, "effects.tooth_friction", True, answer, live.seen("effects.tooth_friction"))
    before = live.ask("page.record.count")
    answer = live.put("scene.gear_contact", "tooth")
    assert "over" in answer and live.complaints() == {} and live.message() == ""
    assert live.ask("page.record.count") == before == answer["points"]
    assert live.link()["effects.tooth_friction"] == "true"
