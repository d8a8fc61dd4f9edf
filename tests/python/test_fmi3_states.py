"""States set as variables in FMI 3.0: all of them between events, and positions at events; also stop times of restored states."""

import ctypes
from pathlib import Path
from xml.etree import ElementTree

import pytest
from fmi3 import Unit3

COUNT = 34
WHEELS = {"inertia.left_end": 0.5, "inertia.right_end": 0.5}
SCENES = {"study": WHEELS, "turn": {"scene.planet_spin": 2, "spin.command": 3.0} | WHEELS,
          "torque, half-shafts, pins": {"scene.carrier_drive": 2, "effects.half_shaft": True, "effects.pin_compliance": True} | WHEELS,
          "without teeth": {"scene.gear_contact": 1} | WHEELS}


def names(unit):
    return [unknown.variable.derivative.name for unknown in unit.description.derivatives]


def got(call):
    values = (ctypes.c_double * COUNT)()
    call(values, COUNT)
    return list(values)


def states(unit):
    return got(unit.raw.getContinuousStates)


def rates(unit):
    return got(unit.raw.getContinuousStateDerivatives)


def put(unit, values):
    unit.raw.setContinuousStates((ctypes.c_double * COUNT)(*values), COUNT)


def moved(unit):
    """States near the present ones, which differ by less than a hundredth of their nominal values."""
    nominal = [float(unit.variables[name].nominal) for name in names(unit)]
    return [x + 0.01 * size * (-1) ** k / (1 + k % 5) for k, (x, size) in enumerate(zip(states(unit), nominal))]


def set_by_events(unit):
    """Names of the states with `reinit`, which fmpy does not read."""
    root = ElementTree.parse(Path(unit.folder, "modelDescription.xml"))
    return {element.get("name") for element in root.iter("Float64") if element.get("reinit") == "true"}


@pytest.mark.parametrize("scene", SCENES)
def test_between_events_all_states_may_be_set_as_variables(exchange, scene):
    one, together = exchange(SCENES[scene]), exchange(SCENES[scene])
    for unit in (one, together):
        unit.raw.enterContinuousTimeMode()
    start, wanted = states(together), moved(together)
    for k, name in enumerate(names(one)):
        values = [*start[:k], wanted[k], *start[k + 1:]]
        put(together, values)
        one.set({name: wanted[k]})
        assert rates(one) == rates(together) and states(one) == states(together), name
        one.set({name: start[k]})
    one.set({"left.load_torque": 500.0} | dict(zip(names(one), wanted)) | {"carrier.speed_command": 20.0})
    together.set({"left.load_torque": 500.0, "carrier.speed_command": 20.0})
    put(together, wanted)
    assert rates(one) == rates(together) and states(one) == states(together)
    knowns = ["left.relative_angle", "carrier.speed"]
    seeds = [1.0, 2.0]
    unknowns = [unknown.variable.name for unknown in one.description.derivatives]
    assert one.sensitivity(unknowns, knowns, seeds).tolist() == together.sensitivity(unknowns, knowns, seeds).tolist()


def test_at_events_positions_may_be_set_and_velocities_may_not(exchange):
    at_event, between = exchange(WHEELS), exchange(WHEELS)
    between.raw.enterContinuousTimeMode()
    values = moved(between)
    positions = {name: value for name, value in zip(names(at_event), values) if name not in set_by_events(at_event)}
    assert len(positions) == 17
    put(between, [positions.get(name, x) for name, x in zip(names(between), states(between))])
    for name in names(at_event):
        if name in positions:
            at_event.set({name: positions[name]})
        else:
            with pytest.raises(Exception, match="fmi3SetFloat64"):
                at_event.set({name: 1.0})
            assert name in at_event.messages[-1][1] and "continuous-time mode" in at_event.messages[-1][1]
    # the host has changed the states, but the event has not
    needs_update, _, _, changed, *_ = at_event.raw.updateDiscreteStates()
    assert not needs_update and not changed
    at_event.raw.enterContinuousTimeMode()
    assert rates(at_event) == rates(between) and states(at_event) == states(between)


def test_the_energy_of_a_position_set_at_an_event_is_work_of_the_host(exchange):
    unit = exchange(WHEELS)
    angle, energy = 2e-5, "solver.energy_residual"
    [before, torque] = unit.reals([energy, "left.shaft_torque"])
    unit.set({"left.relative_angle": unit.reals(["left.relative_angle"])[0] + angle})
    # the teeth press with the torque of the load when they are deflected further
    assert abs(unit.reals([energy])[0] - before) < 1e-9 * torque * angle
    unit.update()
    assert abs(unit.reals([energy])[0] - before) < 1e-9 * torque * angle


def test_tunable_parameters_are_set_at_events_and_refused_between_them(exchange):
    unit = exchange(WHEELS)
    unit.set({"contact.damping": 6e4})
    unit.raw.enterContinuousTimeMode()
    for name in ("contact.damping", "tooth_friction.coefficient"):
        with pytest.raises(Exception, match="fmi3SetFloat64"):
            unit.set({name: 0.1})
        assert f"{name} is a parameter: it cannot be set between events, enter event mode first" in unit.messages[-1][1]
    assert unit.read(["contact.damping"]) == [6e4]
    unit.raw.enterEventMode()
    unit.set({"contact.damping": 7e4})
    assert unit.read(["contact.damping"]) == [7e4]


@pytest.mark.parametrize("options", [{}, {"eventModeUsed": True}])
def test_in_co_simulation_no_state_is_set(fmu3, options):
    with Unit3(fmu3, **options) as unit:
        unit.initialise(WHEELS)
        for name in ("left.relative_angle", "left.speed"):
            with pytest.raises(Exception, match="fmi3SetFloat64"):
                unit.set({name: 0.1})
            assert name in unit.messages[-1][1] and "model exchange" in unit.messages[-1][1]


@pytest.mark.parametrize("options", [{}, {"eventModeUsed": True, "earlyReturnAllowed": True}])
def test_an_instance_keeps_its_stop_time_and_tolerance_when_a_state_is_restored(fmu3, plain_outputs, options):
    def begun(stop, tolerance=None):
        unit = Unit3(fmu3, **options)
        unit.begin(WHEELS, stop, tolerance=tolerance)
        return unit

    def go(unit, first, last):
        for k in range(first, last):
            unit.step(k * 1e-3, 1e-3)
        return unit.reals(plain_outputs).tolist()

    with begun(0.01) as uncut, begun(0.005) as first, begun(0.01) as second, begun(None) as endless, begun(0.01, 1e-9) as tight:
        expected = go(uncut, 0, 10)
        go(first, 0, 5)
        saved = first.save()
        for unit in (second, endless, tight):
            unit.restore(saved)
        assert go(second, 5, 10) == expected
        with pytest.raises(Exception, match="fmi3DoStep"):
            endless.step(5e-3, 1e-3)
        message = endless.messages[-1][1]
        assert "stop time 0.005 s of the restored state" in message and "fmi3EnterInitializationMode" in message
        assert tight.read(["solver.relative_tolerance"]) == [1e-9]
        go(tight, 5, 10)
