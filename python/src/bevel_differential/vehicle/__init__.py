"""Car around the differential: motor, tyres and body, for launches, turns and controllers.

`Car(differential, motor=Motor(…), left=Tyre(…), right=Tyre(…), body=Body(…)).run(…)`.
"""

from .car import UNITS, Car
from .parts import Body, Motor, Tyre

__all__ = ["UNITS", "Body", "Car", "Motor", "Tyre"]
