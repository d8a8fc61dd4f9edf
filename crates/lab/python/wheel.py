"""Tests the wheel without Rust: a fresh environment, no variables of the project, the examples of the documents.

usage: wheel.py WHEEL FOLDER"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tools import WORKSPACE, say

# all extras of the package, and the pages whose examples must run
EXTRAS, PAGES = "[sweep,design,plot,report,cad]", ["README.md", "docs/python.md"]
# programs of Rust, which the environment must not find
RUST = ["cargo", "rustc", "rustup"]
# prefixes of variables that are kept, in capitals: those for downloads, and those for every program on Windows
KEPT = ("PIP_", "HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY", "SSL_CERT_", "REQUESTS_CA_BUNDLE", "SYSTEMROOT", "TEMP", "TMP")


class User:
    """A user who has only Python and the wheel."""

    def __init__(self, folder):
        self.environment, self.home = folder / "venv", folder / "home"
        shutil.rmtree(self.home, ignore_errors=True)
        self.home.mkdir(parents=True)
        finished([sys.executable, "-m", "venv", "--clear", self.environment], "the Python environment cannot be created")

    def run(self, *words, problem, **more):
        """Runs the environment's Python, isolated from settings and files of other users."""
        windows = sys.platform == "win32"
        program = self.environment / ("Scripts/python.exe" if windows else "bin/python")
        variables = {name: value for name, value in os.environ.items() if name.upper().startswith(KEPT)}
        variables |= {"PATH": path_without_rust(), "HOME": str(self.home), "USERPROFILE": str(self.home), "MPLBACKEND": "Agg", **more}
        return finished([program, "-I", "-X", "utf8", *words], problem, env=variables, cwd=self.home, stdin=subprocess.DEVNULL)


def path_without_rust():
    """The search path without the folders that contain Rust's programs."""
    folders = os.environ.get("PATH", "").split(os.pathsep)
    return os.pathsep.join(folder for folder in folders if not any(shutil.which(name, path=folder) for name in RUST))


def finished(command, problem, **options):
    """Output of a program. If it fails, the error consists of `problem` and its messages."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, encoding="utf-8", **options)
    if done.returncode:
        raise SystemExit(f"{problem}:\n{done.stdout}{done.stderr.rstrip()}")
    return done.stdout


def main():
    wheel, folder = map(Path, sys.argv[1:])
    user = User(folder)
    say(0.1, "installing the wheel")
    # most modules of the packages are never imported
    user.run("-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check", "--no-compile", "--constraint",
             WORKSPACE / "fmu-build" / "python" / "requirements.txt", f"{wheel}{EXTRAS}", PIP_CACHE_DIR=str(folder / "cache"),
             problem="the wheel cannot be installed (check the network)")
    say(0.4, "checking it")
    checks = Path(__file__).with_name("wheel_check.py")
    print(wheel)
    print(user.run(checks, *(WORKSPACE / page for page in PAGES), problem="the wheel fails a check"), end="")


if __name__ == "__main__":
    main()
