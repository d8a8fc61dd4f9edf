"""Marked sections of documents, which commands renew, and locks of folders."""

import os
import shutil
import sys
import time
from contextlib import contextmanager

from .paths import TARGET, WORKSPACE, shown
from .terminal import Failure


@contextmanager
def locked(place, note=lambda text: print(text, file=sys.stderr, flush=True)):
    """Context in which no other process works in `place`. Programs in Rust use the same lock file. `note` receives a remark if
    another run has the lock."""
    place.parent.mkdir(parents=True, exist_ok=True)
    with place.with_suffix(".lock").open("a+") as file:
        if not _try_lock(file):
            note(f"waiting for another run that works in {shown(place)}")
            while not _try_lock(file):
                time.sleep(0.2)
        yield


def _try_lock(file):
    """Locks a file until it is closed. Returns False if another process has locked it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def write_whole(file, text):
    """Writes a file that is either complete or unchanged."""
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(file)


def renew(document, name, text):
    """Replaces the text between the lines `<!-- NAME:begin -->` and `<!-- NAME:end -->` of a document of the workspace. Without a name, the
    document becomes the text."""
    file, begin, end = WORKSPACE / document, f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
    # another run may renew another section at the same time
    with locked(TARGET / "documents"):
        if name:
            before, first, rest = file.read_text(encoding="utf-8").partition(begin)
            _, last, after = rest.partition(end)
            if not (first and last):
                raise Failure(f'{document} has no marked section; add the lines "{begin}" and "{end}"')
            text = f"{before}{begin}\n{text}{end}{after}"
        write_whole(file, text)


def copy_pictures(folder):
    """Copies the pictures of a folder to docs/figures."""
    for file in folder.glob("*.png"):
        shutil.copy(file, WORKSPACE / "docs" / "figures")
