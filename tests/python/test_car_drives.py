"""Ordinary drives of `Car`: launch, cruise, coast, stop and wait, then all of it in reverse, from a pedal car to a truck.

The vehicles are the passenger car of `Car` with other masses and radii. Gears, brakes and effects are drawn as for the ordinary
drives of the FMU, and the requirements are the same."""

import os

import numpy as np
import pytest
from bevel_differential.vehicle import Body, Car, Motor, Tyre
from drive_player import BODIES, SIDES, Played
from drive_requirements import PER_POINT, PER_SECOND_AT_REST, Verdict, energy, standing
from effects_list import effects
from ordinary_vehicles import Vehicle, bearing_drag, differential

LEVELS = {effect.name: effect.contact for effect in effects(os.environ["FMU"])}
# mass [kg], radius of the tyres [m], and communication step [s], about half of the longest stable one
VEHICLES = {"light": (40.0, 0.15, 2.5e-3), "heavy": (12000.0, 0.5, 4e-3)}
CONTACTS = ["ideal impact", "lumped impact", "tooth impact", "tooth line"]
# Ends of the phases [s]: launch, cruise, coast, stop, and a wait of 30 s, in whose second half the motor pulls against the brakes. The
# car has no slope, so this pull is the load in the hold.
LAUNCHED, CRUISED, COASTED, STOPPED, PULLED, WAITED = 1.5, 2.5, 3.0, 7.0, 22.0, 37.0
# Time in which a stopped car stops rocking on its tyres, after the last change of torque [s].
ROCKS = 12.0
# fractions of the grip with which brakes stop and hold; fraction of a motor's peak torque as resistance in cruising and for creep
STOPPING, HOLDING, SMALL = 0.5, 1.2, 0.05
BRAKES = [f"{side}.brake_torque" for side in SIDES]
READ = [*BODIES, *(f"{side}.{what}" for side in SIDES for what in ("wheel_angle", "twist", "shaft_torque", "brake_torque")),
        *(f"{side}_tyre.force" for side in SIDES), "held.wheels", "power.in", "power.out", "body.speed", "carrier.torque_command",
        "solver.steps", "solver.rejected", "solver.energy_residual"]


def scaled(mass, radius):
    """Motor, tyre and body of a vehicle that is similar to the passenger car."""
    weight, size = mass / Body().mass, radius / Tyre().radius
    usual = Tyre()
    tyre = Tyre(radius=radius, inertia=usual.inertia * weight * size**2, load=usual.load * weight,
                slip_stiffness=usual.slip_stiffness * weight, relaxation=usual.relaxation * size, damping=usual.damping * weight)
    body = Body(mass=mass, drag=Body().drag * size**2, track=Body().track * size, front=Body().front * size, rear=Body().rear * size,
                yaw_inertia=Body().yaw_inertia * weight * size**2, front_stiffness=Body().front_stiffness * weight,
                rear_stiffness=Body().rear_stiffness * weight)
    return Motor(inertia=Motor().inertia * weight * size**2, peak=Motor().peak * weight * size), tyre, body


def vehicle(motor, tyre, body):
    """Vehicle for which gears and effects are drawn."""
    wheel, drive = tyre.inertia + 0.5 * body.mass * tyre.radius**2, motor.ratio * motor.peak
    size = max((drive / (Motor().ratio * Motor().peak)) ** (1.0 / 3.0), 0.33)
    return Vehicle(wheel=wheel, carrier=motor.inertia * motor.ratio**2, pull=0.5 * drive / wheel,
                   grip=tyre.friction * tyre.load * tyre.radius / wheel, slope=0.0, peak=0.5 * drive, size=size, by_speed=False)


def driver(motor, tyre, sign, weaker):
    """Controller of the drive: first ahead with equal brakes, then in reverse with unequal ones; `sign` mirrors both. It sets brakes only
    when they change, as an input of the differential keeps its value."""
    grip, given = tyre.friction * tyre.load * tyre.radius, {}

    def control(time, _values):
        reverse, time = divmod(time, WAITED)
        ahead, pull, brakes = -sign if reverse else sign, 0.0, [0.0, 0.0]
        if time < CRUISED:
            pull = 0.5 * motor.peak if time < LAUNCHED else SMALL * motor.peak
        elif COASTED <= time < STOPPED:
            brakes = [STOPPING * grip * (0.7 if reverse and side == weaker else 1.0) for side in SIDES]
        elif time >= STOPPED:
            pull, brakes = SMALL * motor.peak * (time >= PULLED), [HOLDING * grip] * 2
        changed = {name: brake for name, brake in zip(BRAKES, brakes) if given.get(name) != brake}
        given.update(changed)
        return {"motor.request": ahead * pull, **changed}

    return control


def judged(car, record, step, start, heats):
    """Verdict of the ordinary drives on a record, and attempts at steps per second at rest beyond those of `PER_POINT`."""
    values, tyre, verdict = {name: record[name] for name in record.dtype.names}, car.tyres[0], Verdict()
    loads = {side: tyre.radius * values[f"{side}_tyre.force"] for side in SIDES}
    # torque on the spring of a brake: in a hold, the loads of generated drives are constant, but those of tyres are not
    acting = {f"{side}.shaft_torque": values[f"{side}.shaft_torque"] - loads[side] for side in SIDES}
    played = Played(record["time"], values | acting, None, [], float(sum(record[name][-1] for name in heats)))
    carrier = car.motor.inertia * car.motor.ratio**2
    drive = {"step": step, "inputs": {f"{side}.load_torque": np.column_stack([record["time"], loads[side]]) for side in SIDES},
             "start": start | {"inertia.carrier": carrier} | {f"inertia.{side}_end": tyre.inertia for side in SIDES}}
    energy(drive, played, verdict)
    # Only attempts at rest are limited: in the stop with unequal brakes, unloaded planets rattle, and each impact needs steps.
    attempts, at_rest = values["solver.steps"] + values["solver.rejected"], []
    for begin in (0.0, WAITED):
        # the stop takes less than half of its phase, so both wheels are at rest at its end
        standing(drive, played, {"from": begin + STOPPED, "to": begin + WAITED, "wheels": SIDES}, verdict)
        for end in (begin + PULLED, begin + WAITED):
            calm = end - 0.5 * (WAITED - STOPPED) + ROCKS
            standing(drive, played, {"from": calm, "to": end - step, "wheels": SIDES}, verdict)
            first, last = np.searchsorted(record["time"], [calm, end - step])
            more = attempts[last] - attempts[first] - PER_POINT * (last - first)
            at_rest.append(more / (record["time"][last] - record["time"][first]))
    verdict.demand(max(at_rest) <= PER_SECOND_AT_REST, f"{max(at_rest):.0f} steps a second at rest")
    verdict.steps = int(attempts[-1])
    return verdict, max(at_rest)


# tooth pairs rattle while the car coasts, those of the smallest gears most: these drives are slow, and run only once
CASES = [(kind, contact, sign) for kind in VEHICLES for contact in CONTACTS for sign in (1, -1)
         if (sign == 1 or "tooth" not in contact) and (kind, contact) != ("light", "tooth line")]


@pytest.mark.parametrize("kind, contact, sign", CASES)
def test_a_car_drives_stops_and_waits(fmu, record_property, kind, contact, sign):
    *size, step = VEHICLES[kind]
    motor, tyre, body = scaled(*size)
    # other effects for each case, but the same ones for its mirror image
    random = np.random.default_rng([1, list(VEHICLES).index(kind), CONTACTS.index(contact)])
    whole = vehicle(motor, tyre, body)
    # drag in each case, because without drag a carrier oscillates in the backlash for a minute after the stop
    drawn = bearing_drag(random, whole, None, None) | differential(random, whole, *contact.split(), LEVELS)
    # the motor is in front of a final drive, so that its pinion and driven end have only small inertias
    own = {name: 0.1 * drawn[name] for name in ("inertia.pinion", "inertia.propeller_end") if name in drawn}
    start = {name: value for name, value in drawn.items() if not name.startswith("inertia.")} | own
    heats = [v.name for v in fmu.variables.values() if v.causality == "output" and v.name.startswith("heat.")]
    car = Car(start, motor=motor, left=tyre, right=tyre, body=body, fmu=fmu)
    # the mirror image swaps left and right
    record = car.run([*READ, *heats], 2.0 * WAITED, step, controller=driver(motor, tyre, sign, SIDES[sign < 0]))
    assert all(np.all(np.isfinite(record[name])) for name in record.dtype.names)
    speed = sign * record["body.speed"]
    assert speed.max() > 3.0 and speed.min() < -3.0
    verdict, at_rest = judged(car, record, step, start, heats)
    record_property("measured", f"residual {verdict.residual:.1e}, {at_rest:.0f} steps a second at rest, {verdict.steps} steps")
    assert not verdict.problems, verdict
