"""Scenes from TOML files, read by the library of answers, and TOML files of commands."""

import tomllib
from collections.abc import Mapping, Set
from pathlib import Path
from typing import Any

from .answers import about, ask, scenes
from .values import DifferentialError, FileName, suggestion


def shipped_scenes() -> list[str]:
    """Names of the shipped scenes."""
    return sorted(file.stem for file in scenes().glob("*.toml"))


def find(what: FileName) -> Path:
    """Path of the file `what`, or of the shipped scene of this name."""
    for file in (Path(what), scenes() / f"{what}.toml"):
        if file.is_file():
            return file
    names = shipped_scenes()
    raise DifferentialError(f"there is no scene file {str(what)!r}, and no shipped scene of that name"
                            f"{suggestion(str(what), names)}; shipped: {', '.join(names)}")


def find_beside(file: Path, what: str) -> Path:
    """Path of the scene file `what` that `file` names: next to `file`, or from `find`."""
    near = file.parent / what
    return near if near.is_file() else find(what)


def read_scene(file: Path, stop: str | None = None, step: str | None = None) -> dict[str, Any]:
    """Arguments of `Scene` in a file; `stop` and `step` replace its end and its communication step. All errors are reported together."""
    times = {name: value for name, value in (("stop_time", stop), ("step", step)) if value is not None}
    found = ask({"ask": "scene", "of": about(file, times)})
    return {"name": found["name"], "description": found["description"], "stop": found["stop_time"], "step": found["step"],
            "outputs": found["outputs"], "set": found["set"], "changes": [(each["time"], each["set"]) for each in found["at"]],
            "tables": [(each["input"], each["times"], each["values"], each["period"]) for each in found["tables"]],
            "input_slopes": found["input_slopes"], "display_units": found["display_units"],
            "accept_start_values": found["accept_start_values"]}


def read_toml(file: Path) -> dict[str, Any]:
    """Contents of a TOML file."""
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except UnicodeDecodeError:
        raise DifferentialError(f"{file}: it is not a text in UTF-8; name a TOML file") from None
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise DifferentialError(f"{file}: {error}") from None


def flat(table: Mapping[str, Any], prefix: str = "", ends: Set[str] = frozenset()) -> dict[str, Any]:
    """Values by dotted names. A table with one of the keys `ends` is a value."""
    values: dict[str, Any] = {}
    for key, value in table.items():
        name = f"{prefix}{key}"
        values.update(flat(value, f"{name}.", ends) if isinstance(value, dict) and not value.keys() & ends else {name: value})
    return values
