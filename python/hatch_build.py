"""Builds what the package holds beside Python: the FMU for this machine, the library of answers, scenes and licences.

`pip install ./python` comes by here. A package that has its FMU already, as the command `wheel` stages it, is left as it is; the
wheel's name tells the platforms that the command names."""

import os
import shutil
import subprocess
import sysconfig
import tempfile
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NEEDED = ("bevel-differential is built from its source with Rust, and {what}. Install Rust (https://rustup.rs), or install the wheel "
          "that the project's command `wheel` makes on another machine.")


# the platforms of the FMU in a package that has one, joined by dots: as pip calls them, or "this-machine"
PLATFORMS = "BEVEL_DIFFERENTIAL_WHEEL_PLATFORMS"


class FmuHook(BuildHookInterface):
    """Hatch calls `initialize` before it packs the wheel. `parts`: a folder with the files of the package that are not Python's."""

    parts = None

    def initialize(self, version, build_data):
        root = Path(self.root)
        if version == "editable":
            return
        if (root / "src" / "bevel_differential" / "BevelDifferential.fmu").is_file():
            if platforms := os.environ.get(PLATFORMS):
                name(build_data, platforms)
            return
        if not (root.parent / "Cargo.toml").is_file():
            raise SystemExit(NEEDED.format(what="the Rust sources are not beside this folder: install from a whole checkout"))
        cargo = shutil.which("cargo")
        if cargo is None:
            raise SystemExit(NEEDED.format(what="cargo is not on the search path"))
        # of this build: another one may run at the same time
        self.parts = tempfile.mkdtemp(prefix="bevel-differential-")
        command = [cargo, "run", "--release", "--locked", "--", "wheel", "--platforms", "this-machine", "--parts", self.parts]
        if subprocess.run(command, cwd=root.parent, check=False).returncode:
            shutil.rmtree(self.parts)
            raise SystemExit(NEEDED.format(what="the build above failed"))
        build_data["force_include"][self.parts] = "bevel_differential"
        name(build_data, "this-machine")

    def finalize(self, version, build_data, artifact_path):
        """Hatch calls it when the wheel is packed."""
        if self.parts:
            shutil.rmtree(self.parts)


def name(build_data, platforms):
    """Lets the wheel's name tell its platforms, so that pip refuses it elsewhere."""
    own = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    build_data["pure_python"] = False
    build_data["tag"] = f"py3-none-{platforms.replace('this-machine', own)}"
