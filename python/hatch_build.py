"""Builds the files of the package other than Python: the FMU for this machine, the library of answers, scenes and licences.

`pip install ./python` runs this hook. If the package already contains an FMU, which the command `wheel` puts there, the hook leaves
it unchanged. The wheel's name then contains the platforms that this command names."""

import os
import shutil
import subprocess
import sysconfig
import tempfile
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NEEDED = ("bevel-differential is built from its source with Rust, and {what}. Install Rust (https://rustup.rs), or install the wheel "
          "that the project's command `wheel` makes on another machine.")


# environment variable: platforms of the FMU in the package, joined by dots, in pip's names or as "this-machine"
PLATFORMS = "BEVEL_DIFFERENTIAL_WHEEL_PLATFORMS"


class FmuHook(BuildHookInterface):
    """Build hook; hatch calls `initialize` before it packs the wheel. `parts`: a folder with the package's files other than Python."""

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
            raise SystemExit(NEEDED.format(what="the Rust sources are not next to this folder: install from a whole checkout"))
        cargo = shutil.which("cargo")
        if cargo is None:
            raise SystemExit(NEEDED.format(what="cargo is not on the search path"))
        # a separate folder for each build, as another one may run at the same time
        self.parts = tempfile.mkdtemp(prefix="bevel-differential-")
        command = [cargo, "run", "--release", "--locked", "--", "wheel", "--platforms", "this-machine", "--parts", self.parts]
        if subprocess.run(command, cwd=root.parent, check=False).returncode:
            shutil.rmtree(self.parts)
            raise SystemExit(NEEDED.format(what="the build above failed"))
        build_data["force_include"][self.parts] = "bevel_differential"
        name(build_data, "this-machine")

    def finalize(self, version, build_data, artifact_path):
        """Removes the folder of parts; hatch calls this when the wheel is packed."""
        if self.parts:
            shutil.rmtree(self.parts)


def name(build_data, platforms):
    """Writes the platforms into the wheel's name, so that pip refuses it on other platforms."""
    own = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    build_data["pure_python"] = False
    build_data["tag"] = f"py3-none-{platforms.replace('this-machine', own)}"
