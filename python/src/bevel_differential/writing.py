"""Writing of all files. A file gets its name when it is complete. A full disk, Ctrl-C, a crash or another command at the same time
therefore leaves the old file, the new one or none.

Until then, the file is `.NAME.xxxxxxxx.part` in the same folder. Such a file remains only if the process is killed. It is not removed
automatically, because another process may still write it; users can delete it."""

import errno
import multiprocessing
import os
import secrets
import shutil
import stat
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from .values import DifferentialError, FileName
from .warned import warn

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

# number of characters of a name in its temporary name: names have at most 255 bytes
KEPT = 50
# time between two checks of a lock of another process, s
PAUSE = 0.1


class OutputError(DifferentialError):
    """Error of a file that cannot be written. `filename` and `strerror` are those of the operating system's error."""

    def __init__(self, filename: FileName, strerror: str):
        super().__init__(f"{filename}: {strerror}; nothing is written to it; make room, or name another place", kind="failed")
        self.filename, self.strerror = filename, strerror


@contextmanager
def whole(file: FileName, synced: bool = False) -> Iterator[Path]:
    """Path of a temporary file that becomes `file` if the block ends without an exception.

    `file` keeps its permissions and may be a symbolic link. A device or a pipe is written directly. `synced`: the contents reach the
    disk before the name changes, so that a power failure loses nothing either. Raises `OutputError`."""
    with _named(file):
        final = Path(file).resolve()
        there = final.stat() if final.exists() else None
        if there and not stat.S_ISREG(there.st_mode):
            if stat.S_ISDIR(there.st_mode):
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            yield final
            return
        part = final.with_name(f".{final.name[:KEPT]}.{secrets.token_hex(4)}.part")
        try:
            # with the permissions of a new file
            part.touch(exist_ok=False)
            if there and not os.access(final, os.W_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
            yield part
            if there:
                part.chmod(stat.S_IMODE(there.st_mode))
            if synced:
                _sync(part, os.O_RDWR)
            part.replace(final)
            # Windows cannot open a folder to sync it
            if synced and os.name == "posix":
                _sync(final.parent, os.O_RDONLY)
        finally:
            with suppress(OSError):
                part.unlink(missing_ok=True)


class _Tried(Exception):
    """End of a trial."""


def try_whole(file: FileName) -> None:
    """Raises `OutputError` if `file` cannot be written, as a trial file in its folder shows. The trial file is removed."""
    with suppress(_Tried), whole(file):
        raise _Tried


@contextmanager
def in_folder(folder: FileName) -> Iterator[Path]:
    """Temporary folder whose files become files of `folder` if the block ends without an exception: all of them or none.

    `folder` is created if necessary. Raises `OutputError`. If some files cannot be renamed, the error names those that were renamed."""
    folder = Path(folder)
    stage = folder / f".{secrets.token_hex(4)}.part"
    renamed: list[Path] = []
    with _made(folder):
        try:
            with _named(folder):
                stage.mkdir()
            yield stage
            _rename_all(stage, folder, renamed)
        except (OSError, OutputError) as error:
            file = Path(error.filename or folder)
            if renamed:
                raise OutputError(file, f"{error.strerror} (complete are {', '.join(map(str, renamed))})") from None
            if file.is_relative_to(stage):
                raise OutputError(folder / file.relative_to(stage), error.strerror or str(error)) from None
            raise
        finally:
            shutil.rmtree(stage, ignore_errors=True)


def write_whole(file: FileName, content: str | bytes) -> None:
    """Writes a file completely or not at all. Raises `OutputError`."""
    with whole(file) as part:
        if isinstance(content, bytes):
            part.write_bytes(content)
        else:
            part.write_text(content, encoding="utf-8")


def refuse_in_worker() -> None:
    """Raises `DifferentialError` in a worker process that has just begun and runs the script of the process that started it."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise DifferentialError("a worker process has run the script that started it; put what the script does below "
                                "if __name__ == \"__main__\":", kind="failed")


@contextmanager
def locked(file: FileName) -> Iterator[None]:
    """Lets one process at a time work on results in `file` or in this folder. Others wait before the block, with a warning.

    The lock is on the file `.NAME.lock` next to it, and ends with its process."""
    refuse_in_worker()
    final = Path(file).resolve()
    lock = final.with_name(f".{final.name[:KEPT]}.lock")
    with _made(lock.parent):
        with _named(file):
            opened = _opened(lock)
            if opened is None:
                warn([f"{file}: another command writes there; waiting until it ends"])
            while opened is None:
                time.sleep(PAUSE)
                opened = _opened(lock)
        try:
            yield
        finally:
            with suppress(OSError):
                lock.unlink()
            os.close(opened)


def _opened(lock):
    """Descriptor of the locked file; None while another process has the lock."""
    opened = os.open(lock, os.O_RDWR | os.O_CREAT, 0o666)
    try:
        if sys.platform == "win32":
            msvcrt.locking(opened, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        # on a file system without locks, continue without one
        if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
            os.close(opened)
            return None
    # the last owner of the lock may have removed its file
    with suppress(FileNotFoundError):
        if os.path.samestat(os.fstat(opened), lock.stat()):
            return opened
    os.close(opened)
    return None


def _rename_all(stage, folder, renamed):
    """Gives the files of `stage` their names in `folder`; renamed files are added to `renamed`."""
    def note(file):
        return lambda kind, *_: None if kind else renamed.append(file)

    with ExitStack() as opened:
        # the contexts end in reverse order, so the last file is renamed first
        for file in sorted((file for file in stage.rglob("*") if file.is_file()), reverse=True):
            final = folder / file.relative_to(stage)
            opened.enter_context(_made(final.parent))
            opened.push(note(final))
            shutil.move(file, opened.enter_context(whole(final)))


@contextmanager
def _made(folder):
    """Creates `folder` with its parents. Those that are empty at the end of the block are removed."""
    new = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        with _named(folder):
            folder.mkdir(parents=True, exist_ok=True)
        yield
    finally:
        for each in new:
            with suppress(OSError):
                each.rmdir()


@contextmanager
def _named(file):
    """Context whose operating system errors name `file` and the cause."""
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        # the text of the system, because libraries add their own words
        raise OutputError(file, os.strerror(error.errno) if error.errno else str(error)) from None


def _sync(path, mode):
    opened = os.open(path, mode)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)
