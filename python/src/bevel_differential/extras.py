"""Optional packages, and the version of this package."""

import importlib
import importlib.metadata
import importlib.util
import json
import os
import shlex
import shutil
import sys
from pathlib import Path
from types import ModuleType
from urllib.parse import urlparse
from urllib.request import url2pathname

from .values import DifferentialError

PACKAGE = "bevel-differential"
# variable of the environment that names the backend of matplotlib
BACKEND = "MPLBACKEND"


def install(module: str, extra: str) -> str:
    """Message about a missing package."""
    return (f"{module.partition('.')[0]} is missing; install the package with its extra {extra}: {_pip()} install "
            f"\"{_package()}[{extra}]\"")


def require(module: str, extra: str) -> ModuleType:
    """Imports the module. If it is missing, fails with the extra of this package that contains it."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as missing:
        raise DifferentialError(install(missing.name or module, extra), kind="failed") from None


def matplotlib(extra: str) -> ModuleType:
    """Imports matplotlib with the user's backend. If this backend cannot be imported, as one of a notebook in another environment, the
    backend is Agg."""
    try:
        return require("matplotlib", extra)
    except DifferentialError:
        raise
    except (ValueError, ImportError):
        chosen = os.environ.pop(BACKEND, None)
        if chosen is None:
            raise
        # its modules would lack the attributes that only a complete import sets
        for name in [name for name in sys.modules if name.partition(".")[0] == "matplotlib"]:
            del sys.modules[name]
        os.environ[BACKEND] = "Agg"
        try:
            return require("matplotlib", extra)
        finally:
            os.environ[BACKEND] = chosen


def needed(module: str, extra: str) -> None:
    """Fails like `require` if the module is missing, without importing it: a check before long work."""
    try:
        found = importlib.util.find_spec(module) is not None
    except (ModuleNotFoundError, ValueError):
        found = False
    if not found:
        raise DifferentialError(install(module, extra), kind="failed")


def version() -> str | None:
    """Version of the package, or None for sources that are not installed."""
    try:
        return importlib.metadata.version(PACKAGE)
    except importlib.metadata.PackageNotFoundError:
        return None


def _pip():
    """Command of this interpreter's pip."""
    program, found = Path(sys.executable), shutil.which("pip")
    if found and Path(found).parent == program.parent:
        return "pip"
    near = program.relative_to(Path.cwd()) if program.is_relative_to(Path.cwd()) else program
    return f"{shlex.quote(near.as_posix())} -m pip"


def _package():
    """Source from which pip can install this package: its folder in a clone, otherwise its name."""
    folder = Path(__file__).absolute().parents[2]
    if not (folder / "pyproject.toml").is_file():
        folder = _installed_from()
    if folder is None:
        return PACKAGE
    try:
        # relative path, as a user within the clone would write it
        return f"{'/'.join(['..'] * len(Path.cwd().relative_to(folder.parent).parts)) or '.'}/{folder.name}"
    except (ValueError, OSError):
        return str(folder)


def _installed_from():
    """Folder from which the installed package was built (PEP 610), if it still exists."""
    try:
        found = json.loads(importlib.metadata.distribution(PACKAGE).read_text("direct_url.json") or "{}")
    except (importlib.metadata.PackageNotFoundError, ValueError):
        return None
    folder = Path(url2pathname(urlparse(found["url"]).path)) if "dir_info" in found else None
    return folder if folder is not None and (folder / "pyproject.toml").is_file() else None
