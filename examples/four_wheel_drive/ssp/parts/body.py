"""Body of a car with four driven wheels."""

from vehicle import Vehicle


class Body(Vehicle):
    description = "Vehicle straight ahead with four driven wheels: mass, drag of the air, rolling resistance"
    inputs = tuple((f"{axle}_{side}_force", f"Force of the {axle} {side} wheel, N") for axle in ("front", "rear") for side in ("left", "right"))
