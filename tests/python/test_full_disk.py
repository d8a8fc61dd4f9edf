"""Every command that writes, on a full or read-only disk: existing files stay, new files are complete, and the message names the file
and the cause."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from warned_lines import without_warnings

from bevel_differential import writing
from bevel_differential.command import COMMANDS, main

ROOT = Path(__file__).resolve().parents[2]
DISK = 200_000
OLD = "what was there before\n"
SCENE = """
description = "one spring per mesh, loaded"
stop_time = "20 ms"
step = "1 ms"
outputs = ["left.speed", "safety.root_min"]
[set]
scene.gear_contact = "lumped"
effects.strength = true
left.load_torque = "835 N.m"
right.load_torque = "835 N.m"
"""
BENCH = """
description = "gears without teeth, a clutch"
stop_time = "10 ms"
step = "1 ms"
outputs = ["left.speed"]
[set]
scene.gear_contact = "ideal"
effects.limited_slip = true
limited_slip.preload = "60 N.m"
carrier.torque_command = "800 N.m"
carrier.speed_command = "40 rad/s"
"""
OPTIMISE = """
description = "light or strong"
scene = "scene.toml"
objectives = ["minimise gears.mass", "maximise safety.root_min"]
[vary]
geometry.module = "4.4 mm..4.6 mm"
geometry.face_width = "10 mm..13 mm"
"""
TOLERANCE = """
description = "play"
scene = "scene.toml"
runs = 8
wants = ["left.speed"]
[factors]
geometry.backlash = "0.1 mm +- 0.04 mm"
"""
INPUTS = {"scene.toml": SCENE, "bench.toml": BENCH, "optimise.toml": OPTIMISE, "tolerance.toml": TOLERANCE}
CYCLE = ROOT / "examples/design/duty_cycle.csv"
# arguments, existing file, free space on the disk in bytes, files that may be new; no file in {inputs} is written
CASES = {
    "run": (["{inputs}/scene.toml", "--csv", "a.csv", "--plot", "a.png"], "a.csv", 0, ()),
    "run a Parquet file": (["{inputs}/scene.toml", "--csv", "a.parquet"], "a.parquet", 0, ()),
    "run a picture": (["{inputs}/scene.toml", "--csv", "a.csv", "--plot", "a.svg"], "a.svg", 8192, ("a.csv",)),
    "plan": (["{inputs}/scene.toml", "--ssv", "a.ssv", "--python", "a.py"], "a.ssv", 0, ()),
    "accuracy": (["{inputs}/scene.toml", "--within", "50%", "--want", "left.speed", "--csv", "a.csv", "--plot", "a.png", "--write", "a.toml",
                  "--ssv", "a.ssv", "--python", "a.py"], "a.csv", 0, ()),
    "report": (["{inputs}/scene.toml", "--quick", "--out", "a.html"], "a.html", 100_000, ()),
    "loads": (["study_straight", "--out", "a.csv"], "a.csv", 100_000, ()),
    "geometry": (["--dxf", "--out", "out"], "out/dimensions.json", 150_000, ()),
    "pattern": (["{inputs}/scene.toml", "--set", "scene.gear_contact=tooth", "--out", "out"], "out/summary.csv", 100_000, ()),
    "sweep": (["--scene", "{inputs}/scene.toml", "--vary", "geometry.backlash=0.1 mm, 0.2 mm", "--plan", "grid", "--want", "left.speed",
               "--csv", "a.csv", "--workers", "0"], "a.csv", 0, ()),
    "sweep with parts": (["--scene", "{inputs}/scene.toml", "--vary", "geometry.backlash=0.1 mm, 0.2 mm", "--plan", "grid", "--want",
                          "left.speed", "--out", "a.parquet", "--workers", "0", "--force"], "a.parquet", 0, ()),
    "optimise": (["{inputs}/optimise.toml", "--quick", "--population", "4", "--generations", "1", "--out", "out", "--workers", "0"],
                 "out/front.png", 60_000, ("out/problem.json", "out/evaluations.parquet", "out/front.csv")),
    "tolerance": (["{inputs}/tolerance.toml", "--no-indices", "--csv", "a.csv", "--plot", "a.png", "--workers", "0"], "a.csv", 0, ()),
    "spectrum": ([str(CYCLE), "--csv", "a.csv", "--plot", "a.pdf"], "a.pdf", 8192, ("a.csv",)),
    "losses": (["{inputs}/bench.toml", "--torque", "400, 800", "--speed", "20, 40", "--difference", "1, 5", "--temperature", "350", "--unseen",
                "2", "--most", "8", "--csv", "a.csv", "--simulink", "a.m", "--plot", "a.png", "--report", "a.html", "--workers", "0"],
               "a.csv", 0, ()),
    "bench": (["winter_start", "--out", "out", "--workers", "0"], "out/winter_start.toml", 150_000, ()),
    "coupling": (["one_wheel_on_ice", "--set", "scene.start=equilibrium", "--host", "left:k=9000,c=12,J=1", "--plot", "a.png"], "a.png",
                 8192, ()),
    "study": (["--out", "out"], "out/table.md", 190_000, ()),
    "verify": (["--csv", "a.csv"], "a.csv", 0, ()),
    "variables": (["--csv", "a.csv"], "a.csv", 0, ()),
    "examples": (["--out", "."], None, 12_288, ()),
}
FOLDERS = ("geometry", "pattern", "optimise", "bench", "study", "examples")
# commands that write nothing
READING = {"page"}


def test_every_command_that_writes_is_here():
    assert {case.split()[0] for case in CASES} | READING == set(COMMANDS)


@pytest.fixture
def inputs(tmp_path):
    folder = tmp_path / "inputs"
    folder.mkdir()
    for name, text in INPUTS.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def mount(*arguments):
    return subprocess.run(["mount", *arguments], capture_output=True, check=False).returncode == 0


@pytest.fixture
def disk(tmp_path):
    """Empty disk of `DISK` bytes, or None if mounting is not allowed."""
    folder = tmp_path / "disk"
    folder.mkdir()
    if not mount("-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", str(folder)):
        yield None
        return
    yield folder
    subprocess.run(["umount", "--lazy", str(folder)], check=True)


def content(folder):
    """Files of a folder, with their contents."""
    return {file.relative_to(folder).as_posix(): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def prepared(folder, case, monkeypatch):
    """Arguments of the command, after creation of the existing file and the change to the folder."""
    _, old, *_ = CASES[case]
    if old:
        (folder / old).parent.mkdir(exist_ok=True)
        (folder / old).write_text(OLD)
    monkeypatch.chdir(folder)


def refused(case, inputs, fmu_file, capsys):
    """Last line on standard error of the command, which must fail."""
    words = [word.format(inputs=inputs) for word in CASES[case][0]]
    own = [] if case.split()[0] in ("plan", "accuracy", "loads", "geometry", "pattern", "verify", "examples") else ["--fmu", fmu_file]
    assert main([case.split()[0], *words, *own]) not in (0, None)
    return capsys.readouterr().err.splitlines()[-1]


def judged(case, folder, before, line, cause):
    """Checks that old files stay, that new files are complete and allowed, and that the message names a file and the cause."""
    after = content(folder)
    new = after.keys() - before.keys()
    assert new <= set(CASES[case][3]) and {name: after[name] for name in before} == before, (new, line)
    assert all(after[name].endswith((b"\n", b"PAR1")) for name in new)
    assert re.match(r"bevel-differential: (a[.\w]+|out[/\w.]*|design/\w+\.\w+|\.)( cannot be written)?: ", line) and cause in line, line
    assert not [path for path in folder.rglob("*") if path.name.endswith((".part", ".lock"))]


@pytest.mark.parametrize("case", CASES)
def test_a_full_disk(case, disk, inputs, fmu_file, monkeypatch, capsys, tmp_path):
    folder, room = disk, CASES[case][2]
    if folder is None:
        if case == "loads":
            pytest.skip("no disk may be mounted here, and Rust's own writer cannot be changed")
        folder = tmp_path / "folder"
        folder.mkdir()
    prepared(folder, case, monkeypatch)
    if disk is None:
        def full(*_, **__):
            raise OSError(28, "No space left on device")
        monkeypatch.setattr(writing.Path, "replace", full)
    else:
        free = os.statvfs(folder)
        (folder / "ballast").write_bytes(bytes(max(free.f_bavail * free.f_frsize - room, 0)))
    before = content(folder)
    judged(case, folder, before, refused(case, inputs, fmu_file, capsys), "No space left on device")


@pytest.mark.parametrize("case", CASES)
def test_a_folder_that_may_not_be_written_to(case, disk, inputs, fmu_file, monkeypatch, capsys):
    if disk is None:
        pytest.skip("no disk may be mounted here, and root may write into all folders")
    prepared(disk, case, monkeypatch)
    assert mount("-o", "remount,ro", str(disk))
    before = content(disk)
    judged(case, disk, before, refused(case, inputs, fmu_file, capsys), "Read-only file system")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is full")
@pytest.mark.parametrize("words", [["plan", "study_straight"], ["plan"], ["geometry", "--out", "{out}"]])
def test_a_full_disk_under_standard_output(words, fmu_file, tmp_path):
    with open("/dev/full", "w", encoding="utf-8") as full:
        words = [word.format(out=tmp_path) for word in words]
        ran = subprocess.run([sys.executable, "-m", "bevel_differential", *words], stdout=full, stderr=subprocess.PIPE, text=True, check=False,
                             env={**os.environ, "BEVEL_DIFFERENTIAL_FMU": fmu_file})
    lines = without_warnings(ran.stderr).splitlines()
    assert lines == ["bevel-differential: standard output: No space left on device"] and ran.returncode == 1
