"""Where libraries for this machine are."""

import platform
import sys
from pathlib import Path

# the folder of libraries and the form of their names; FMI 2.0 names systems of 64 bits so
_SYSTEMS = {"linux": ("linux64", "lib{}.so"), "win32": ("win64", "{}.dll"), "darwin": ("darwin64", "lib{}.dylib")}
# FMI 2.0.4 leaves Linux on ARM to the names of FMI 3.0
ARM = "aarch64-linux"


def is_arm_linux() -> bool:
    """Whether this is Linux on 64-bit ARM."""
    return sys.platform == "linux" and platform.machine() == "aarch64"


def answers(folder: Path) -> tuple[str, Path]:
    """The platform's name and the library of answers in `folder`, which may not be there."""
    system, name = _SYSTEMS.get(sys.platform, _SYSTEMS["linux"])
    # what was built on such a machine for itself lies where fmpy looks for an FMU's library
    if is_arm_linux() and (folder / ARM).is_dir():
        system = ARM
    return system, folder / system / name.format("answers")


def fmu_library(folder: str, name: str) -> str | None:
    """The library `name` of an extracted FMU where fmpy does not look for it; None where fmpy finds it."""
    file = Path(folder, "binaries", ARM, f"{name}.so").resolve()
    return str(file) if is_arm_linux() and file.is_file() else None
