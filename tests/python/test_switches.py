"""Switches of the effects: off changes no bit, on balances its energy, wrong combinations are refused, states are restored."""

import os
from math import radians

import numpy as np
import pytest
import theory
from driving import STEADY_TURN
from effects_list import effects
from refusals import refused_start

EFFECTS = {effect.name: effect for effect in effects(os.environ["FMU"])}
OUTPUTS = ["temperature.gears", "left.angle", "left.speed", "left.acceleration", "left.shaft_torque", "left.thrust_force", "right.speed",
           "carrier.torque", "carrier.acceleration", "planet[1].spin_angle", "planet[1].left_normal_force",
           "planet[2].right_normal_force", "planet[1].left_transmission_error", "heat.contact", "solver.steps",
           "solver.energy_residual", "locking_value", "stress.contact_max", "damage.planet",
           "safety.root_min", "left.speed_peak_to_peak"]


def other_value(variable):
    """A value of a parameter within its range that is not its start value."""
    if variable.kind == "Boolean":
        return not variable.start
    if variable.kind == "Enumeration":
        return len(variable.literals)
    start, low, high = variable.start, variable.minimum, variable.maximum
    if low is None:
        return start + 0.37
    value = start * 1.37 + 1e-3 * (high - low) if start * 1.37 + 1e-3 * (high - low) <= high else 0.5 * (low + start)
    return int(min(start + 1, high) if start < high else start - 1) if variable.kind == "Integer" else value


@pytest.fixture(scope="module")
def plain(run):
    return {"turn": run(STEADY_TURN, stop=0.2, output=OUTPUTS), "straight": run({}, stop=0.05, output=OUTPUTS)}


@pytest.mark.parametrize("effect", EFFECTS.values(), ids=EFFECTS)
def test_an_effect_that_is_off_changes_no_bit(run, plain, fmu, effect):
    own = [v for v in fmu.variables.values() if v.name.startswith(effect.name + ".") and v.causality == "parameter"]
    values = {v.name: other_value(v) for v in own if v.kind != "Enumeration"}
    if effect.switch:
        values |= effect.inputs
    assert values or not own
    for name, base, stop in (("turn", STEADY_TURN, 0.2), ("straight", {}, 0.05)):
        record = run({**base, **values}, stop=stop, output=OUTPUTS)
        for output in OUTPUTS:
            assert np.array_equal(record[output], plain[name][output]), (output, name)


@pytest.mark.parametrize("effect", EFFECTS.values(), ids=EFFECTS)
def test_an_effect_that_is_on_balances_its_energy(run, plain, effect):
    level = {} if "tooth" in effect.contact else {"scene.gear_contact": effect.contact[-1]}
    names = OUTPUTS + ["carrier.speed", "power.in"] + ([effect.heat] if effect.heat else [])
    record = run({**STEADY_TURN, **level, **effect.on}, stop=0.2, output=names)
    exchanged = 2.0 * theory.LOAD * radians(954.0) * 0.2
    assert abs(record["solver.energy_residual"][-1]) < 1e-5 * exchanged
    changed = [o for o in OUTPUTS if not np.array_equal(record[o], plain["turn"][o])]
    # the advice needs a host that reacts
    assert changed or effect.name == "coupling_advice"
    for output in names:
        assert np.isfinite(record[output]).all()
    # a dog clutch makes heat when it ratchets or opens, after a command
    if effect.heat and effect.name != "disconnect":
        assert record[effect.heat][-1] > 0.0


@pytest.mark.parametrize("planets", [2, 4])
@pytest.mark.parametrize("law", [{}, {"contact.law": "line"}, {"contact.law": "line_weber", "effects.body_compliance": True}],
                         ids=["impact", "line", "on elastic bodies"])
def test_planets_simulated_once_give_the_same_bits_as_each_simulated(run, planets, law):
    base = {**STEADY_TURN, "geometry.planet_count": planets, **law}
    once = run(base, stop=0.2, output=OUTPUTS)
    each = run({**base, "solver.merge_planets": False}, stop=0.2, output=OUTPUTS)
    for output in OUTPUTS:
        assert np.array_equal(once[output], each[output]), output


WRONG = [
    ({"scene.planet_spin": "imposed", "scene.left_drive": "speed", "scene.right_drive": "speed",
      "scene.carrier_drive": "torque"}, "scene.planet_spin"),
    ({"scene.left_drive": "speed", "scene.right_drive": "speed"}, "scene.carrier_drive"),
    ({"scene.left_drive": "speed", "half_shaft.left_stiffness": 0.0}, "half_shaft.left_stiffness"),
    ({"scene.gear_contact": "ideal", "effects.thrust_friction": True}, "effects.thrust_friction"),
    ({"scene.gear_contact": "ideal", **theory.CLUTCHES}, "limited_slip.torque_coefficient"),
    ({"scene.gear_contact": "lumped", "effects.tooth_friction": True}, "effects.tooth_friction"),
    ({"scene.gear_contact": "lumped", "effects.tooth_errors": True}, "effects.tooth_errors"),
    ({"contact.stiffness_from_hertz": True, "contact.exponent": 2.0}, "contact.exponent"),
    ({"effects.tooth_fault": True, "tooth_fault.tooth": 10}, "tooth_fault.tooth"),
]


@pytest.mark.parametrize("values, name", WRONG)
def test_wrong_combinations_are_refused_by_name(fmu, values, name):
    refused_start(fmu, values, name)


def test_a_state_with_stuck_clutches_and_a_broken_tooth_is_restored_to_the_bit(drive):
    values = {**theory.CLUTCHES, "effects.tooth_fault": True, "effects.half_shaft": True,
              "inertia.left_end": 0.1, "inertia.right_end": 0.1, "contact.law": "line", "effects.strength": True,
              "left.load_torque": 900.0}
    driven = drive(values).to(0.05, 1e-3)
    driven.set({"fault.trigger": 1.0})
    kept = driven.to(0.1, 1e-3).save()
    first = driven.to(0.2, 1e-3).read(OUTPUTS)
    assert driven.restore(kept).to(0.2, 1e-3).read(OUTPUTS) == first
    assert drive(values).restore(kept).to(0.2, 1e-3).read(OUTPUTS) == first
