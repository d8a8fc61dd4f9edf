"""Random scenes: Latin hypercubes over all parameters and inputs of the FMU.

`wild` takes every value from its whole range, so that few values agree. `plausible` stays near scenes that
can be built and obeys the documented rules of combination, so that most of them run. `bold` is plausible but for a few
values from their whole ranges: it passes the first checks and reaches the others."""

import numpy as np

import plausible_scenes
from sampling import latin, spread

KINDS = ("wild", "bold", "plausible")
# of a run [s]: some blows, some teeth passing; less where values from the ends of their ranges make steps expensive
DURATION = {"wild": (0.001, 0.003), "bold": (0.001, 0.003), "plausible": (0.01, 0.03)}
# variables that came after the seeds were chosen, in that order: each is drawn by a generator of its own, so that the other draws
# stay as they were
LATER = ["effects.body_compliance", "effects.mesh_history", "strength.rate_from",
         "oil.temperature", "oil.viscosity_40", "oil.viscosity_100", "oil.density", "oil.density_fall",
         "tooth_friction.viscosity_from_oil", "bearing_drag.viscosity_from_oil", "bearing_drag.reference_temperature",
         "limited_slip.mean_radius", "limited_slip.stribeck_speed", "limited_slip.slip_slope", "limited_slip.cold_temperature",
         "limited_slip.cold_factor", "limited_slip.reference_temperature", "limited_slip.hot_temperature",
         "limited_slip.hot_factor", "thrust_friction.static_ratio", "thrust_friction.stribeck_speed",
         "thrust_friction.slip_slope", "thrust_friction.cold_temperature", "thrust_friction.cold_factor",
         "thrust_friction.reference_temperature", "thrust_friction.hot_temperature", "thrust_friction.hot_factor",
         "wheel_brake.static_ratio", "wheel_brake.mean_radius", "wheel_brake.temperature", "wheel_brake.stribeck_speed",
         "wheel_brake.slip_slope", "wheel_brake.cold_temperature", "wheel_brake.cold_factor",
         "wheel_brake.reference_temperature", "wheel_brake.hot_temperature", "wheel_brake.hot_factor", "effects.warm_up",
         "warm_up.ambient_temperature", "warm_up.sump_given", "warm_up.oil_capacity", "warm_up.gear_specific_heat",
         "warm_up.clutch_capacity", "warm_up.washer_capacity", "warm_up.case_capacity", "warm_up.gears_to_oil",
         "warm_up.gears_to_oil_per_speed", "warm_up.clutch_to_oil", "warm_up.washers_to_oil", "warm_up.oil_to_case",
         "warm_up.case_to_ambient", "warm_up.case_to_ambient_per_speed", "warm_up.oil_share",
         "strength.thermal_contact_coefficient", "strength.scuffing_temperature", "warm_up.gears_above_oil", "warm_up.clutch_above_oil",
         "warm_up.washers_above_oil", "warm_up.case_above_oil", "warm_up.cycle",
         *(f"bearing_drag.{name}" for name in ("churning_from_geometry", "carrier_diameter", "carrier_width", "oil_level", "seal_diameter",
                                               "seal_torque_per_diameter", "bearing_load", "bearing_diameter", "bearing_coefficient")),
         "thrust_friction.planet_washer_area", "thrust_friction.side_washer_area", "thrust_friction.pin_area",
         "thrust_friction.pv_limit", "thrust_friction.beyond_limit", "limited_slip.friction_area",
         "limited_slip.plate_coefficient", "limited_slip.pv_limit", "limited_slip.beyond_limit", "wheel_brake.friction_area",
         "wheel_brake.lining_coefficient", "wheel_brake.pv_limit", "wheel_brake.beyond_limit", "warm_up.ambient_change",
         "warm_up.sump_change", "inertia.side_gear_mass", "tooth_fault.at_onset"]
STEADY_HEAT = 4
# share of values that a bold scene takes from their whole ranges
BOLD = 0.03


def free_variables(fmu):
    """All parameters and inputs."""
    return [v for v in fmu.variables.values() if v.causality in ("parameter", "input")]


def wild_value(variable, u):
    if variable.kind == "Boolean":
        return u < 0.5
    if variable.kind == "Enumeration":
        return 1 + int(u * plausible_scenes.FIRST_CHOICES.get(variable.name, len(variable.literals)))
    low, high = plausible_scenes.limits(variable)
    if variable.kind == "Integer":
        return int(low + u * (high - low + 1.0))
    return spread(u, low, high, plausible_scenes.TYPICAL.get(variable.name, variable.start))


def schedule(random, duration, inputs, draw):
    """Irregular communication steps of a short run, some of them with new inputs: (size, inputs) each."""
    sizes = 10.0 ** random.uniform(-5.0, -2.0, 12)
    sizes *= random.uniform(*duration) / sizes.sum()
    return [(float(size), {v.name: draw(v) for v in inputs if random.random() < 0.15}) for size in sizes]


def scenes(fmu, kind, count, seed, first=0, last=None):
    """Scenes `first` to `last` of the `count` of a kind: {"start": values by name, "steps": [(size, inputs)]}."""
    everything = free_variables(fmu)
    variables = [v for v in everything if v.name not in LATER]
    inputs = [v for v in variables if v.causality == "input"]
    cube = latin(count, len(variables), np.random.default_rng([seed, KINDS.index(kind)]))
    for index in range(first, count if last is None else last):
        random = np.random.default_rng([seed, KINDS.index(kind), index])
        later = {name: np.random.default_rng([seed, KINDS.index(kind), index, k]).random() for k, name in enumerate(LATER, 1)}
        shares = dict(zip((v.name for v in variables), cube[index].tolist())) | later
        if kind == "wild":
            start = {v.name: wild_value(v, shares[v.name]) for v in everything}
            draw = wild_value
        else:
            start = plausible_scenes.values(everything, shares)
            draw = lambda v, u: plausible_scenes.value(v, u, start)  # noqa: E731
            if kind == "bold":
                start |= {v.name: wild_value(v, random.random()) for v in variables if random.random() < BOLD}
        if later["warm_up.cycle"] > 0.8 and (kind == "wild" or start["effects.warm_up"]):
            start["scene.start"] = STEADY_HEAT
        steps = schedule(random, DURATION[kind], inputs, lambda v: draw(v, random.random()))
        yield index, {"start": start, "steps": steps}
