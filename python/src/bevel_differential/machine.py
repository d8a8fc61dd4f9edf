"""Paths of libraries for this machine."""

import platform
import sys
from pathlib import Path

# folder of libraries and form of their names, as FMI 2.0 names systems of 64 bits
_SYSTEMS = {"linux": ("linux64", "lib{}.so"), "win32": ("win64", "{}.dll"), "darwin": ("darwin64", "lib{}.dylib")}
# FMI 2.0.4 leaves Linux on ARM to the names of FMI 3.0
ARM = "aarch64-linux"


def is_arm_linux() -> bool:
    """True on Linux on 64-bit ARM."""
    return sys.platform == "linux" and platform.machine() == "aarch64"


def answers(folder: Path) -> tuple[str, Path]:
    """Name of the platform, and path of the library of answers in `folder`; the file may be missing."""
    system, name = _SYSTEMS.get(sys.platform, _SYSTEMS["linux"])
    # a build on such a machine for itself uses the folder where fmpy looks for an FMU's library
    if is_arm_linux() and (folder / ARM).is_dir():
        system = ARM
    return system, folder / system / name.format("answers")


def fmu_library(folder: str, name: str) -> str | None:
    """Library `name` of an extracted FMU if fmpy does not look in its folder; None if fmpy finds it."""
    file = Path(folder, "binaries", ARM, f"{name}.so").resolve()
    return str(file) if is_arm_linux() and file.is_file() else None
