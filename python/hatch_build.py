"""Builds what the package holds beside Python: the FMU for this machine, the library of answers, scenes and licences.

`pip install ./python` comes by here. A package that has its FMU already, as the command `wheel` stages it, is left as it is."""

import shutil
import subprocess
import sysconfig
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NEEDED = ("bevel-differential is built from its source with Rust, and {what}. Install Rust (https://rustup.rs), or install the wheel "
          "that the project's command `wheel` makes on another machine.")


class FmuHook(BuildHookInterface):
    """Hatch calls `initialize` before it packs the wheel."""

    def initialize(self, version, build_data):
        root = Path(self.root)
        if version == "editable" or (root / "src" / "bevel_differential" / "BevelDifferential.fmu").is_file():
            return
        if not (root.parent / "Cargo.toml").is_file():
            raise SystemExit(NEEDED.format(what="the Rust sources are not beside this folder: install from a whole checkout"))
        cargo = shutil.which("cargo")
        if cargo is None:
            raise SystemExit(NEEDED.format(what="cargo is not on the search path"))
        parts = root.parent / "target" / "wheel" / "parts"
        command = [cargo, "run", "--release", "--locked", "--", "wheel", "--platforms", "this-machine", "--parts", str(parts)]
        if subprocess.run(command, cwd=root.parent, check=False).returncode:
            raise SystemExit(NEEDED.format(what="the build above failed"))
        build_data["force_include"][str(parts)] = "bevel_differential"
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
