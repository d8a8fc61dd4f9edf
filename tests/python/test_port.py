"""Ports for coupled scripts: the bits and the errors of `set`, `step` and `read`, with three calls of the FMU."""

import math

import numpy as np
import pytest
from bevel_differential import DifferentialError, Fmu
from bevel_differential.instance import Instance
from bevel_differential.values import DISCARD
from bevel_differential.vehicle import Car, Tyre
from refusals import refused

SIZE = 1e-3
DRIVEN = ["right.load_torque", "carrier.torque_command"]
# with an enumeration between numbers
SHOWN = ["carrier.speed", "left.wheel_speed", "right.wheel_speed", "coupling.advice_state", "right.shaft_torque", "solver.steps"]
# a torque-driven carrier between wheels with inertia
AXLE = {"scene.carrier_drive": "torque", "inertia.left_end": 0.5, "inertia.right_end": 0.5, "left.load_torque": 300.0,
        "effects.coupling_advice": True}


@pytest.fixture
def opened(fmu):
    with fmu.open() as instance:
        yield instance.initialise(AXLE)


class Calls:
    """Stand-in for a port that uses `set`, `set_slopes`, `do_step` and `read`."""

    def __init__(self, instance, inputs, outputs):
        self.instance, self.inputs, self.outputs = instance, inputs, outputs

    def step(self, values, size, rates=None):
        found = self.do_step(values, self.instance.time, size, rates)
        self.instance.time += size
        return found

    def do_step(self, values, time, size, rates=None):
        self.instance.set(dict(zip(self.inputs, values)))
        if rates is not None:
            self.instance.set_slopes(dict(zip(self.inputs, rates)))
        self.instance.do_step(time, size)
        return self.read()

    def read(self):
        return self.instance.read(self.outputs)


def go_on(port, steps, has_rates):
    """Outputs of steps in which the torques follow the speeds and, with rates, change towards those of the next point."""
    rows, before = [port.read()], None
    for _ in range(steps):
        carrier, left, right, *_ = rows[-1]
        values = [300.0 + 20.0 * (right - left), 900.0 - 2.0 * carrier]
        rates = [(now - then) / SIZE for now, then in zip(values, before or values)] if has_rates else None
        rows.append(port.step(values, SIZE, rates))
        before = values
    return rows


@pytest.mark.parametrize("has_rates", [False, True])
def test_a_coupled_loop_has_the_bits_of_single_calls_also_from_a_restored_state_on(fmu, has_rates):
    found = []
    for make in (Calls, Instance.port):
        with fmu.open() as one, fmu.open() as other:
            first, second = make(one.initialise(AXLE), DRIVEN, SHOWN), make(other.initialise(), DRIVEN, SHOWN)
            begin = go_on(first, 30, has_rates)
            saved = one.save()
            rest = go_on(first, 20, has_rates)
            # the step after the saved state is repeated, here and in another instance
            one.restore(saved)
            other.restore(saved)
            assert go_on(first, 20, has_rates) == rest == go_on(second, 20, has_rates)
            assert one.time == other.time == pytest.approx(50 * SIZE, rel=1e-12)
            found.append([*begin, *rest])
    assert found[0] == found[1]
    # the loop moves, and more than one value is compared
    assert all(len({row[place] for row in found[1]}) > 40 for place, name in enumerate(SHOWN) if name != "coupling.advice_state")


def test_an_input_grows_by_its_rate_within_its_step_and_is_held_in_the_next(opened):
    port = opened.port(DRIVEN, DRIVEN)
    assert port.step([100.0, 600.0], SIZE, [5e3, -2e4]) == pytest.approx([105.0, 580.0], rel=1e-12)
    assert port.step([100.0, 600.0], SIZE) == [100.0, 600.0]


def test_the_caller_may_keep_the_time(opened):
    port = opened.port(DRIVEN, SHOWN)
    port.do_step([300.0, 900.0], 0.0, SIZE)
    assert opened.time == 0.0
    # the FMU is no longer at the time of `step`
    with refused("communication point"):
        port.step([300.0, 900.0], SIZE)
    port.do_step([300.0, 900.0], SIZE, SIZE)


@pytest.mark.parametrize("given", [120.0, 120, np.float64(120.0), np.float32(120.0), np.array(120.0), [120.0], (120,), np.array([120.0]),
                                   np.array([120]), "120 N.m", ["0.12 kN.m"], [(0.12, "kN.m")]], ids=repr)
def test_one_input_takes_a_number_a_list_a_tuple_or_an_array(opened, given):
    assert opened.port(DRIVEN[:1], DRIVEN[:1]).step(given, SIZE, np.array([0.0])) == [120.0]


@pytest.mark.parametrize("pack", [list, tuple, np.array])
def test_several_inputs_take_their_values_in_order(opened, pack):
    assert opened.port(DRIVEN, DRIVEN).step(pack([120.0, 700.0]), SIZE, pack([1e3, 2e3])) == pytest.approx([121.0, 702.0], rel=1e-12)


def test_outputs_are_numbers_in_a_separate_list(opened):
    port = opened.port(DRIVEN, SHOWN)
    first = port.step([300.0, 900.0], SIZE)
    kept = [*first]
    second = port.step([300.0, 100.0], SIZE)
    assert first == kept != second and all(type(value) is (int if name == "coupling.advice_state" else float) for value, name in zip(first, SHOWN))
    second[0] = math.nan
    assert port.read()[0] == opened.get(SHOWN[0])


def test_a_port_without_inputs_steps_and_reads(started, opened):
    port = opened.port([], SHOWN)
    other = started(AXLE)
    for _ in range(5):
        other.step(SIZE)
        assert port.step([], SIZE) == other.read(SHOWN)


@pytest.mark.parametrize("has_rates, expected", [(False, ["set", "step", "get"]), (True, ["set", "slopes", "step", "get"])])
def test_an_exchange_is_three_calls_and_looks_up_no_name(opened, monkeypatch, has_rates, expected):
    made = []

    def noted(name, function):
        return lambda *arguments: made.append(name) or function(*arguments)

    def looked_up(*_):
        raise AssertionError("a name was looked up")

    opened._set, opened._get = {"Real": noted("set", opened._set["Real"])}, {"Real": noted("get", opened._get["Real"])}
    opened._do_step = noted("step", opened._do_step)
    slopes = noted("slopes", opened._set_rates)
    opened._set_rates = slopes
    port = opened.port(DRIVEN, [name for name in SHOWN if name != "coupling.advice_state"])
    monkeypatch.setattr(Fmu, "variable", looked_up)
    port.step([300.0, 900.0], SIZE, [0.0, 1.0] if has_rates else None)
    assert made == expected


def refusal(use):
    with pytest.raises(DifferentialError) as error:
        use()
    return str(error.value), error.value.status, error.value.kind


@pytest.mark.parametrize("given", [math.nan, -math.inf, True, np.True_, None, "much", "5 kg", "1e12 N.m", 1e30, -1e9, [1.0], {}], ids=repr)
def test_a_wrong_value_is_refused_as_by_set_and_nothing_happens(opened, given):
    port = opened.port(DRIVEN, [*DRIVEN, "solver.steps"])
    before = port.step([300.0, 900.0], SIZE)
    said = refusal(lambda: port.step([100.0, given], SIZE))
    assert said[0].startswith("carrier.torque_command")
    assert said == refusal(lambda: opened.set({DRIVEN[0]: 100.0, DRIVEN[1]: given}))
    assert port.read() == before and opened.time == SIZE
    # the wrong value is forgotten
    port.step([100.0, 900.0], SIZE)


def test_a_number_that_is_not_finite_is_refused_in_an_array_too(opened):
    with pytest.raises(DifferentialError, match=r"^carrier\.torque_command = nan: it is a finite number in N\.m$"):
        opened.port(DRIVEN, SHOWN).step(np.array([1.0, np.nan]), SIZE)


@pytest.mark.parametrize("given, count", [(1.0, 1), ([1.0], 1), ([1.0, 2.0, 3.0], 3), ([], 0), (np.zeros((1, 2)), 1), ("1 N.m", 1)],
                         ids=repr)
@pytest.mark.parametrize("what", ["values", "rates"])
def test_a_wrong_number_of_values_is_refused_by_the_names_of_the_inputs(opened, given, count, what):
    port = opened.port(DRIVEN, [*DRIVEN, "solver.steps"])
    before = port.read()
    values, rates = (given, None) if what == "values" else ([1.0, 1.0], given)
    with pytest.raises(DifferentialError) as error:
        port.step(values, SIZE, rates)
    said = str(error.value)
    assert said.startswith("right.load_torque, carrier.torque_command: ") and f"there are {count} {what} for 2 inputs" in said
    assert port.read() == before and opened.time == 0.0


def test_an_array_with_a_column_too_many_is_refused_by_name(opened):
    with pytest.raises(DifferentialError, match=r"^right\.load_torque = \[0\.0\]: it is a number"):
        opened.port(DRIVEN, SHOWN).step(np.zeros((2, 1)), SIZE)


@pytest.mark.parametrize("rate", [math.nan, math.inf, "fast", None, True, np.True_, [1.0, 2.0]], ids=repr)
def test_a_wrong_rate_is_refused_by_name_before_anything_is_set(opened, rate):
    port = opened.port(DRIVEN, DRIVEN)
    before = port.read()
    with pytest.raises(DifferentialError, match=r"^carrier\.torque_command: its rate is .* not a finite number$"):
        port.step([1.0, 2.0], SIZE, [0.0, rate])
    assert port.read() == before


@pytest.mark.parametrize("inputs, outputs, parts", [
    (["left.sped"], [], "left.sped: there is no such variable … did you mean left.speed"),
    (["left.speed"], [], "left.speed: it is calculated and cannot be set"),
    (["geometry.module"], [], "geometry.module: it is a fixed parameter"),
    (["left.load_torque"] * 2, [], "left.load_torque: it is given twice"),
    (["left.load_torque"], ["right.sped"], "right.sped: there is no such variable"),
    ("left.load_torque", [], "names are a list")])
def test_names_are_checked_when_the_port_is_made(opened, inputs, outputs, parts):
    with refused(parts):
        opened.port(inputs, outputs)


def test_a_tunable_parameter_is_set_and_has_no_rate(started):
    opened = started({"effects.limited_slip": True})
    port = opened.port(["limited_slip.preload"], ["limited_slip.preload"])
    assert port.step(70.0, SIZE) == [70.0]
    said = refusal(lambda: port.step(70.0, SIZE, 1.0))
    assert said[0].startswith("limited_slip.preload is not an input")
    assert said == refusal(lambda: opened.set_slopes({"limited_slip.preload": 1.0}))


@pytest.mark.parametrize("size", [0.0, -1e-3, math.nan, 1.0], ids=repr)
def test_a_step_that_is_refused_has_the_error_of_step(fmu, size):
    with fmu.open() as one, fmu.open() as other:
        for instance in (one, other):
            instance.initialise(AXLE, stop=0.5)
        said = refusal(lambda: one.port(DRIVEN, SHOWN).step([300.0, 900.0], size))
        assert said == refusal(lambda: other.step(size)) and one.time == 0.0


@pytest.mark.parametrize("again", [lambda opened, saved: opened.initialise(AXLE), lambda opened, saved: opened.reset() or opened.initialise(AXLE),
                                   lambda opened, saved: opened.restore(saved)], ids=["initialise", "reset", "restore"])
def test_a_failed_step_gives_the_message_of_the_fmu_and_the_port_goes_on_with_the_same_bits(opened, again):
    port, saved = opened.port(["left.load_torque"], SHOWN), opened.save()
    first = [port.step(300.0, SIZE) for _ in range(5)]
    said, status, kind = refusal(lambda: port.step(1e8, SIZE))
    assert said.startswith("at t = ") and status == DISCARD and kind == "failed" and said in opened.messages[-1]
    again(opened, saved)
    assert [port.step(300.0, SIZE) for _ in range(5)] == first and opened.time == pytest.approx(5 * SIZE, rel=1e-12)


def test_a_port_is_refused_where_single_calls_are(fmu, opened):
    port = opened.port(DRIVEN, SHOWN)
    opened.raw.terminate()
    said = refusal(lambda: port.step([1.0, 2.0], SIZE))
    assert said == refusal(lambda: opened.set({DRIVEN[0]: 1.0})) and "terminated" in said[0]
    opened.close()
    for use in (lambda: port.step([1.0, 2.0], SIZE), port.read):
        assert refusal(use)[0] == "the instance is closed; open another one"
    with fmu.open() as early, fmu.open("ModelExchange") as foreign:
        foreign.initialise(AXLE)
        for instance in (early, foreign):
            said = refusal(lambda: instance.port(DRIVEN, SHOWN).step([1.0, 2.0], SIZE))
            assert said == refusal(lambda: instance.step(SIZE)) and said[0].startswith("the step from 0 s: not legal")


@pytest.mark.parametrize("values, speed", [({}, 0.0), ({"effects.half_shaft": True, "effects.wheel_brake": True}, 12.0)])
def test_a_car_has_the_bits_of_single_calls(fmu, monkeypatch, values, speed):
    outputs = ["left.wheel_speed", "motor.torque", "effects.half_shaft", "contact.law", "right.shaft_torque", "geometry.module",
               "body.speed"]

    def controller(time, found):
        brake = 200.0 if found["right.shaft_torque"] > 20.0 else 0.0
        return {"motor.request": 400.0 * time, "left.brake_torque": brake} if values else {"motor.request": 150.0}

    def record():
        car = Car({"contact.law": "line", **values}, left=Tyre(friction=0.2), fmu=fmu)
        return car.run(outputs, 0.1, 1e-3, steer=0.02, speed=speed, controller=controller)

    by_port = record()
    monkeypatch.setattr(Instance, "port", lambda *given: Calls(*given))
    by_calls = record()
    assert by_port.dtype == by_calls.dtype and by_port.tobytes() == by_calls.tobytes()
    assert by_port["effects.half_shaft"][-1] == bool(values) and by_port["contact.law"][-1] == 2.0
    assert len(set(by_port["left.wheel_speed"])) > 90
