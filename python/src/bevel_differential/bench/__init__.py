"""A virtual bench: tests of a differential in the terms of SAE J2817. The torque bias ratio of a differential that differentiates
under load is TBR = T_high/T_low. Its locking value is LE = 100 (TBR − 1)/(TBR + 1) %."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..drive_port import at_port
from ..fmu import Fmu
from ..scene import Scene
from ..values import FileName, Value
from .clutch import clutch_curve, ramps
from .commanded import clutch_command
from .lash import lash
from .over_time import hot_lap, judder, winter_start
from .steady import breakaway, bias

# tests by name, each with the scene that it runs
TESTS = {"bias": (bias, "bias"), "breakaway": (breakaway, "bias"), "ramps": (ramps, "ramps"),
         "clutch_curve": (clutch_curve, "clutch_curve"), "clutch_command": (clutch_command, "clutch_command"),
         "judder": (judder, "judder"), "hot_lap": (hot_lap, "hot_lap"), "winter_start": (winter_start, "winter_start"), "lash": (lash, "lash")}


def scene_file(name: str) -> Path:
    """Scene file of a test."""
    return Path(__file__).with_name(f"{TESTS[name][1]}.toml")


def bench(name: str, folder: FileName, scene: FileName | None = None, values: Mapping[str, Value] | None = None,
          fmu: FileName | Fmu | None = None, display_units: Sequence[str] = (), **farm: Any) -> str:
    """Runs a test; writes its figure NAME.png and its numbers NAME.csv into a folder. Returns the conclusions as text.

    `scene`: replaces the test's scene; `values`: changes of the scene; `display_units`: units of the figure and the text; `farm`:
    arguments of `designs.Farm`."""
    test, _ = TESTS[name]
    with Scene.load(scene or scene_file(name), fmu=fmu, display_units=display_units) as loaded, at_port(loaded.set(values)) as driven:
        return test(driven, Path(folder) / name, farm)
