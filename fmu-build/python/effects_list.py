"""Effects from `effects.json`, which packaging writes next to the FMU."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Effect:
    """An effect of the list.

    `name`: prefix of its parameters, such as half_shaft. `switch`: such as effects.half_shaft; None if an input commands the effect.
    `inputs` that it adds, with values that make it act; `example`: parameters that make it visible. `heat`: output with the heat that
    it generates. `contact`: levels of gear contact that it supports."""

    name: str
    switch: str | None
    inputs: dict
    example: dict
    heat: str | None
    contact: tuple

    @property
    def on(self):
        """Values that make the effect act."""
        return self.example | self.inputs | ({self.switch: True} if self.switch else {})


@cache
def effects(fmu):
    """All effects of the packaged FMU."""
    path = Path(fmu).resolve().parent / "effects.json"
    if not path.is_file():
        raise FileNotFoundError(f"{path} is missing; write it: cargo run --release -- package")
    return [effect(row) for row in json.loads(path.read_text(encoding="utf-8"))]


def effect(row):
    # all numbers in the file are floats, including those of Integers
    values = {name: int(value) if value == int(value) else value for name, value in row["example"].items()}
    inputs = {name: value for name, value in values.items() if name in row["inputs"]}
    example = {name: value for name, value in values.items() if name not in inputs}
    return Effect(row["name"].removeprefix("effects."), row["switch"], inputs, example, row["heat"], tuple(row["contact"]))
