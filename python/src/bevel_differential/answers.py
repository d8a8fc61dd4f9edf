"""Questions to the library of answers: it reads scenes and gears, and calculates what needs no FMU.

Each question is a dict with the key "ask"; the repository has all questions in crates/answers/src/ask/mod.rs."""

import json
import os
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from .interrupts import held_back
from .library import reply
from .quantities import QUANTITIES
from .spreadsheet import csv_text, is_spreadsheet
from .values import DifferentialError
from .warned import warn

# receives the fraction of the work that is done, from 0 to 1, and a description of the current work
Progress: TypeAlias = Callable[[float, str], None]


def ask(question: Mapping[str, Any], numbers: np.ndarray | None = None, progress: Progress | None = None) -> dict[str, Any]:
    """Asks a question, with the `numbers` that belong to it, and returns the answer. Ctrl-C, or any error in `progress`, stops the
    work. Warnings about a scene or its gears become Python warnings, `DifferentialWarning`.

    Raises `DifferentialError`; its `problems` are dicts with `message` and, where they are known, `variable`, `value`, `unit`,
    `range` and `hint`; its `kind` is "use" if the question makes no sense, otherwise "failed"."""
    with held_back() as raised:

        def on_progress(_context, done, what):
            try:
                if progress is not None and not raised:
                    progress(done, what.decode())
            except BaseException as stopped:
                raised.append(stopped)
            return len(raised)

        try:
            found = reply(question, numbers, on_progress)
        except OSError as missing:
            raise DifferentialError(str(missing), kind="failed") from None
    warn(found.get("warnings", ()))
    if "answer" not in found:
        message = "\n".join(problem["message"] for problem in found["problems"])
        raise DifferentialError(message, kind=found["kind"], problems=found["problems"])
    return found["answer"]


def effect_classes() -> dict[str, list[str]]:
    """Switches of effects by class: "machine", which say what is built in, broken or driven, so that they are part of a question;
    "outputs", which change no motion and only add outputs."""
    return ask({"ask": "effect_classes"})


def about(scene: Any, changes: Mapping[str, Any] | None = None, display_units: Sequence[str] = ()) -> dict[str, Any]:
    """Scene of a question: a file, the name of a shipped scene, or a `Scene`, with `changes` (values by name) and
    `display_units`."""
    given = {"given": scene.contents()} if hasattr(scene, "contents") else {"contents": _spreadsheets(Path(scene))}
    name = scene.name if "given" in given else os.fspath(scene)
    return {"name": name, **given, "scenes": os.fspath(scenes()), "set": assignments(changes),
            "display_units": list(display_units), "quantities": list(QUANTITIES)}


def _spreadsheets(scene):
    """Input files of a scene that the library cannot read, as CSV, by their paths in the scene."""
    try:
        inputs = tomllib.loads(scene.read_text(encoding="utf-8")).get("inputs", []) if scene.is_file() else []
        files = [entry["file"] for entry in inputs]
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        # the library describes the problem of the file
        return {}
    return {file: csv_text(scene.parent / file) for file in files if isinstance(file, str) and is_spreadsheet(file)}


def assignments(values: Mapping[str, Any] | None) -> list[str]:
    """Values by name as texts "name=value"."""
    return [f"{name}={written(value)}" for name, value in (values or {}).items()]


def scenes() -> Path:
    """Folder of the shipped scenes: in this package, or in the repository that contains it."""
    if folder := os.environ.get("BEVEL_DIFFERENTIAL_SCENES"):
        return Path(folder)
    shipped = Path(__file__).with_name("scenes")
    return shipped if shipped.is_dir() else shipped.parents[3] / "scenes"


def written(value: Any) -> str:
    """Text of a value for the reader of scenes; numbers are read back to the same bits."""
    if isinstance(value, (bool, np.bool_)):
        return str(bool(value)).lower()
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list) or isinstance(value, tuple) and value and isinstance(value[0], (list, tuple)):
        return f"[{', '.join(map(_point, value))}]"
    if isinstance(value, tuple) and len(value) == 2:
        number, unit = value
        return f"{number} {unit or ''}".strip()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value if isinstance(value, str) else repr(value.item() if isinstance(value, np.generic) else value)


def _point(point):
    """Text of an entry of a list, which is itself a list of quantities."""
    return f"[{', '.join(map(_quantity, point))}]" if isinstance(point, (list, tuple, np.ndarray)) else _quantity(point)


def _quantity(value):
    """Text of a number, or of a text or a pair (number, unit), in quotes."""
    has_unit = isinstance(value, str) or isinstance(value, tuple) and value[-1] is not None
    return json.dumps(written(value)) if has_unit else written(value)
