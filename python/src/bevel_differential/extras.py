"""Packages that only some uses need, and the version of this one."""

import importlib
import importlib.metadata
from types import ModuleType

from .values import DifferentialError


def install(module: str, extra: str) -> str:
    """What to say where a package is missing."""
    return f"{module.partition('.')[0]} is missing; install the package with its extra {extra}: pip install \"WHEEL[{extra}]\""


def require(module: str, extra: str) -> ModuleType:
    """Imports the module, or fails and names the extra of this package that brings it."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as missing:
        raise DifferentialError(install(missing.name or module, extra)) from None


def version() -> str | None:
    """Version of the package; sources that are not installed have none."""
    try:
        return importlib.metadata.version("bevel-differential")
    except importlib.metadata.PackageNotFoundError:
        return None
