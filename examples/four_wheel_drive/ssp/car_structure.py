"""The car as a system of FMUs for an SSP archive: three units, a motor, four tyres and the body. The values are those of `car.py`."""

from dataclasses import asdict

from car import AXLES, BODY, MOTOR, PEDAL, SHAFT, SIDES, STOP, WHEELS
from structure import Structure

# parts and the class of each, in the order of the power flow
PARTS = {"motor": "Motor", "centre": "BevelDifferential", **{f"{axle}_axle": "BevelDifferential" for axle in AXLES},
         **{f"{wheel}_tyre": "Tyre" for wheel in WHEELS}, "body": "Body"}


def connections():
    """Source of each input, both as (part, variable)."""
    found = {("motor", "carrier_speed"): ("centre", "carrier.speed"), ("centre", "carrier.torque_command"): ("motor", "carrier_torque")}
    for axle in AXLES:
        part, shaft = f"{axle}_axle", SHAFT[axle]
        found["centre", f"{shaft}.speed_command"] = part, "propeller.speed"
        found[part, "pinion.torque_command"] = "centre", f"{shaft}.shaft_torque"
        for side in SIDES:
            tyre = f"{axle}_{side}_tyre"
            found[part, f"{side}.load_torque"] = tyre, "load"
            found[tyre, "wheel_speed"] = part, f"{side}.wheel_speed"
            found[tyre, "vehicle_speed"] = "body", "speed"
            found["body", f"{axle}_{side}_force"] = tyre, "force"
    return found


def values(car):
    """Values of all parts of a `FourWheelDrive`, by (part, variable)."""
    (_, rise, release, end), (_, high, *_) = PEDAL
    of = {"motor": {"high": high, "rise": rise, "release": release, "fall": end - release,
                    **{name: getattr(MOTOR, name) for name in ("ratio", "peak", "knee", "lag")}},
          "body": {name: getattr(BODY, name) for name in ("mass", "drag", "rolling", "breakaway")}}
    for wheel, tyre in zip(WHEELS, car.tyres):
        of[f"{wheel}_tyre"] = {name: value for name, value in asdict(tyre).items() if name != "inertia"}
    for unit, scene in car.scenes.items():
        of["centre" if unit == "centre" else f"{unit}_axle"] = scene.values
    return {(part, name): value for part, own in of.items() for name, value in own.items()}


def structure(car):
    """System of a `FourWheelDrive`."""
    return Structure("four_wheel_drive", "Launch of a car with four-wheel drive on split friction", PARTS, connections(), values(car), STOP)
