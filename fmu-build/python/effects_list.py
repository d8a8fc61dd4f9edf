"""The effects as the program declares them: `effects.json`, which packaging writes next to the FMU."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Effect:
    """One effect of the list.

    `name`: as its parameters begin, such as half_shaft. `switch`: such as effects.half_shaft; None: an input commands it. `inputs`
    that it adds, with values that make it act; `example`: parameters that make it visible. `heat`: output with the heat that it
    makes. `contact`: levels of gear contact that it works with."""

    name: str
    switch: str | None
    inputs: dict
    example: dict
    heat: str | None
    contact: tuple

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
