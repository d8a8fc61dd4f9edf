"""The effects as the program declares them: `effects.json`, which packaging writes next to the FMU."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Effect:
    """One effect of the list."""

    name: str
    """As its parameters begin: half_shaft."""
    switch: str | None
    """effects.half_shaft; None: an input commands it."""
    inputs: dict
    """Inputs that it adds, with values that make it act."""
    example: dict
    """Parameters that make it visible."""
    heat: str | None
    """Output with the heat that it makes."""
    contact: tuple
    """Levels of gear contact that it works with."""

    @property
    def on(self):
        """Values that make it act."""
        return self.example | self.inputs | ({self.switch: True} if self.switch else {})


@cache
def effects(fmu):
    """All effects of the packaged FMU."""
    path = Path(fmu).resolve().parent / "effects.json"
    if not path.is_file():
        raise FileNotFoundError(f"{path} is missing; write it: cargo run --release -- package")
    return [effect(row) for row in json.loads(path.read_text(encoding="utf-8"))]


def effect(row):
    # numbers are written as floats, also those of Integers
    values = {name: int(value) if value == int(value) else value for name, value in row["example"].items()}
    inputs = {name: value for name, value in values.items() if name in row["inputs"]}
    example = {name: value for name, value in values.items() if name not in inputs}
    return Effect(row["name"].removeprefix("effects."), row["switch"], inputs, example, row["heat"], tuple(row["contact"]))
