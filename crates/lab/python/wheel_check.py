"""Checks the installed wheel from the view of a user without Rust.

usage: wheel_check.py PAGE...

Run it with the Python of the environment in which the wheel is installed, from an empty folder that it may write to. PAGE is a Markdown
file: its Python examples that import the package are run unchanged. Prints a line for each check and stops at the first failure.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import bevel_differential
import numpy as np
import pandas as pd
from bevel_differential import Differential, Scene, shipped_scenes
from bevel_differential.fmu import shipped
from bevel_differential.answers import scenes as folder
from fmpy import simulate_fmu

# a turn and its closed form: the side gears turn at the carrier's speed plus and minus 10/16 of the planets' spin, deg/s
CARRIER, SPIN, TEETH_RATIO = 954.0, 200.0, 10.0 / 16.0
# designs of the sweep
RUNS = 8
OUTPUTS = ["left.speed", "right.speed", "left.normal_force", "planet[1].left_pairs", "efficiency", "solver.steps"]
EXAMPLE = re.compile(r"^```python\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
SWEEP = ["sweep", "--scene", "study_turning", "--vary", "left.load_torque=700 N.m..900 N.m", "--plan", "lhs", "--runs", str(RUNS),
         "--want", "left.speed:mean", "--want", "efficiency:final", "--workers", "2", "--out", "sweep.parquet"]


def no_rust_and_no_checkout():
    found = [program for program in ("cargo", "rustc", "rustup") if shutil.which(program)]
    assert not found, f"{found} can be called"
    for file in (Path(bevel_differential.__file__), shipped()):
        assert file.is_file() and file.is_relative_to(sys.prefix), f"{file} does not come from the wheel"
    assert Differential().fmu.file.samefile(shipped())
    return f"package and FMU of the wheel, {shipped().stat().st_size / 1e6:.1f} MB; no cargo, rustc or rustup"


def scenes():
    names = shipped_scenes()
    assert len(names) >= 10 and folder().is_relative_to(sys.prefix), f"{names} in {folder()}"
    for name in names:
        Scene.load(name).close()
    return f"{len(names)} scenes in the wheel"


def examples(page):
    number = 0
    for code in EXAMPLE.findall(page.read_text(encoding="utf-8")):
        if not re.search(r"^\s*(from|import) bevel_differential", code, re.MULTILINE):
            continue
        number += 1
        script = Path(f"{page.stem}_{number}.py")
        script.write_text(code, encoding="utf-8")
        called(sys.executable, "-I", "-X", "utf8", script)
    assert number, f"{page.name} has no example of the package"
    return f"{page.name}: examples run: {number}"


def same_bits():
    package = Differential({"scene.planet_spin": "imposed", "spin.command": (SPIN, "deg/s"),
                            "carrier.speed_command": (CARRIER, "deg/s")}).run(outputs=OUTPUTS)
    fmpy = simulate_fmu(str(shipped()), output=OUTPUTS, stop_time=0.5, output_interval=0.001, logger=lambda *_: None,
                        start_values={"scene.planet_spin": 2, "spin.command": (SPIN, "deg/s"),
                                      "carrier.speed_command": (CARRIER, "deg/s")})
    assert len(package) == len(fmpy) == 501
    for name in ["time", *OUTPUTS]:
        assert package[name].tobytes() == fmpy[name].astype(package[name].dtype).tobytes(), f"{name}: other bits than fmpy's"
    return f"a turn: {len(package)} points of {len(OUTPUTS)} outputs have fmpy's bits"


def sweep():
    called(Path(sys.executable).with_name("bevel-differential"), *SWEEP)
    table = pd.read_parquet("sweep.parquet")
    assert len(table) == RUNS, f"{len(table)} rows"
    # a Latin hypercube has one point in each of as many equal parts of the range
    places = np.sort(np.floor((table["left.load_torque"] - 700.0) / (200.0 / RUNS)))
    assert (places == np.arange(RUNS)).all(), table["left.load_torque"]
    # the drives impose the speeds for any load
    speed = np.degrees(table["left.speed:mean"])
    assert np.abs(speed / (CARRIER + TEETH_RATIO * SPIN) - 1.0).max() < 2e-3, speed
    assert table["efficiency:final"].between(0.0, 1.0 + 1e-9).all(), table["efficiency:final"]
    return f"bevel-differential sweep: {len(table)} runs"


# each command with a part of its output and the files that it writes
COMMANDS = [
    (["plan", "torque_bias", "--ssv", "bias.ssv", "--python", "bias.py"], "cost class", ["bias.ssv", "bias.py"]),
    (["accuracy", "torque_bias", "--within", "1%", "--csv", "runs.csv", "--plot", "front.png", "--write", "reduced.toml"],
     "Needed", ["runs.csv", "front.png", "reduced.toml"]),
    (["run", "reduced.toml", "--csv", "reduced.csv"], "torque_bias_ratio", ["reduced.csv"]),
    (["loads", "study_turning", "--every", "10 ms", "--out", "loads.csv"], "loads of tooth pairs", ["loads.csv"]),
    (["geometry", "--set", "geometry.module=4mm", "--out", "gears"], "no interference", ["gears/dimensions.json"]),
    (["pattern", "study_turning", "--set", "scene.gear_contact=solid", "--out", "marks"], "line load toe/heel",
     ["marks/contact_pattern.png"]),
    (["report", "clunk", "--quick", "--out", "clunk.html"], "written", ["clunk.html"]),
    (["examples"], "tolerances.toml", ["examples/design/duty_cycle.csv"]),
    (["spectrum", "examples/design/duty_cycle.csv", "--csv", "damage.csv", "--plot", "damage.png"], "life by the",
     ["damage.csv", "damage.png"]),
    (["tolerance", "examples/design/tolerances.toml", "--runs", "8", "--no-indices", "--plot", "spread.png"], "yield", ["spread.png"]),
    (["study", "--out", "study"], "turn: left, deg/s", ["study/speeds.png", "study/study_turning.html"]),
]


def commands():
    for arguments, printed, files in COMMANDS:
        found = called(Path(sys.executable).with_name("bevel-differential"), *arguments)
        assert printed in found, f"{arguments}: prints\n{found}"
        for file in files:
            assert Path(file).stat().st_size > 100, f"{arguments}: {file}"
    return f"bevel-differential {', '.join(arguments[0] for arguments, *_ in COMMANDS)}"


def called(*command):
    """Output of a program. Its messages are the error if it fails."""
    done = subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True, encoding="utf-8",
                          stdin=subprocess.DEVNULL)
    assert done.returncode == 0, f"{command}:\n{done.stdout}{done.stderr}"
    return done.stdout


def main():
    pages = [Path(page) for page in sys.argv[1:]]
    for check in [no_rust_and_no_checkout, scenes, *(lambda page=page: examples(page) for page in pages), same_bits, sweep, commands]:
        print(check())


if __name__ == "__main__":
    main()
