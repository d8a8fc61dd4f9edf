"""Every command that writes, on a full or read-only disk: existing files stay, new files are complete, and the message names the file
and the cause."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import command, without_warnings
from command_list import EXAMPLES, line, prepare

from bevel_differential import writing
from bevel_differential.command import FAILED

DISK = 200_000
CASES = [(name, files) for name, example in EXAMPLES.items() for files in example.files]


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


@pytest.fixture
def refused(units, monkeypatch):
    """refused(name, files, folder, cause, change): runs a command in a folder with an old file, after a change due to which it must fail.
    Old files stay, new files are complete and allowed, and the message names a file and the cause."""
    def run(name, files, folder, cause, change):
        monkeypatch.chdir(folder)
        prepare(folder)
        Path("good.fmu").symlink_to(units / "good.fmu")
        if files.old:
            Path(files.old).parent.mkdir(exist_ok=True)
            Path(files.old).write_text("what was there before\n", encoding="utf-8")
        change()
        before = content(folder)
        said = command(f"{line(name)} {files.options}", FAILED).err.splitlines()[-1]
        after = content(folder)
        new = after.keys() - before.keys()
        assert new <= set(files.new) and {name: after[name] for name in before} == before, (new, said)
        assert all(after[name].endswith((b"\n", b"PAR1")) for name in new)
        assert re.match(r"bevel-differential: (a[.\w]+|out[/\w.]*|design/\w+\.\w+|\.)( cannot be written)?: ", said) and cause in said, said
        assert not [path for path in folder.rglob("*") if path.name.endswith((".part", ".lock"))]

    return run


@pytest.mark.parametrize("name, files", CASES)
def test_a_full_disk(name, files, disk, refused, monkeypatch, tmp_path):
    def fill():
        free = os.statvfs(disk)
        (disk / "ballast").write_bytes(bytes(max(free.f_bavail * free.f_frsize - files.room, 0)))

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    if disk is None and name == "loads":
        pytest.skip("no disk may be mounted here, and Rust's own writer cannot be changed")
    refused(name, files, disk or tmp_path, "No space left on device", fill if disk else lambda: monkeypatch.setattr(writing.Path, "replace", full))


@pytest.mark.parametrize("name, files", CASES)
def test_a_folder_that_may_not_be_written_to(name, files, disk, refused):
    if disk is None:
        pytest.skip("no disk may be mounted here, and root may write into all folders")
    refused(name, files, disk, "Read-only file system", lambda: mount("-o", "remount,ro", str(disk)) or pytest.fail("the disk is not read-only"))


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is full")
@pytest.mark.parametrize("words", ["plan study_straight", "plan", "geometry --out {}"])
def test_a_full_disk_under_standard_output(words, tmp_path):
    with open("/dev/full", "w", encoding="utf-8") as full:
        ran = subprocess.run([sys.executable, "-m", "bevel_differential", *words.format(tmp_path).split()], stdout=full, stderr=subprocess.PIPE,
                             text=True, check=False)
    lines = without_warnings(ran.stderr).splitlines()
    assert lines == ["bevel-differential: standard output: No space left on device"] and ran.returncode == 1
