"""Instance in a library for another processor: far.c runs in an emulator and receives each call."""

import contextlib
import ctypes
import subprocess
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from bevel_differential.instance import Instance
from tools import completed

# letters of the calls that set or get values of a kind
LETTERS = {"Real": "r", "Integer": "n", "Boolean": "b"}
ITEM = {"Real": 8, "Integer": 4, "Boolean": 4}


def compiled(compiler, folder):
    """Builds far.c with a compiler and its options, and returns the program."""
    program = Path(folder) / "far"
    completed([*compiler, "-O2", "-o", program, Path(__file__).with_name("far.c"), "-ldl"])
    return program


class Emulated(Instance):
    """An `Instance` without the functions that far.c lacks: logs, saved states, derivatives.

    `command` runs far.c for the processor and gets the library as an argument."""

    def __init__(self, fmu, command, library):
        self.fmu, self.time, self._is_fresh, self._failure = fmu, 0.0, True, None
        self.messages, self.events = [], []
        self._far = subprocess.Popen([*map(str, command), str(library), fmu.description.guid], stdin=subprocess.PIPE,
                                     stdout=subprocess.PIPE)
        # any pointer except NULL
        self._component = ctypes.c_void_p(1)
        self._get = {kind: partial(self._values, kind, gets=True) for kind in LETTERS}
        self._set = {kind: partial(self._values, kind, gets=False) for kind in LETTERS}
        self._setup = lambda *_: 0  # the call that enters initialisation mode also sets up the experiment
        self._enter, self._exit, self._reset = (lambda _, letter=letter: self._ask(letter) for letter in "ELX")
        self._do_step = lambda _, time, size, __: self._ask("S", 2, np.array([time, size]).tobytes())
        self.raw = SimpleNamespace(setReal=self._set_real)

    def _ask(self, letter, count=0, sent=b"", answer=0, to=None):
        """Sends a call with its bytes and returns its status. Bytes of the answer are copied to the address `to`."""
        # a host that has ended accepts and answers nothing
        with contextlib.suppress(BrokenPipeError):
            self._far.stdin.write(letter.encode() + count.to_bytes(4, "little") + sent)
            self._far.stdin.flush()
        got = self._far.stdout.read(4 + answer)
        if len(got) != 4 + answer:
            raise SystemExit(f"the emulated host has ended with status {self._far.wait()}")
        if answer:
            ctypes.memmove(to, got[4:], answer)
        return int.from_bytes(got[:4], "little")

    def _values(self, kind, _component, references, count, values, *, gets):
        sent, size = ctypes.string_at(references, 4 * count), ITEM[kind] * count
        if gets:
            return self._ask(LETTERS[kind], count, sent, size, values)
        return self._ask(LETTERS[kind].upper(), count, sent + ctypes.string_at(values, size))

    def _set_real(self, references, values):
        status = self._ask("R", len(references), np.array(references, np.uint32).tobytes() + np.array(values, float).tobytes())
        self.check(status, "setting Real variables")

    def close(self):
        """Ends the emulator and its instance."""
        if self._component:
            self._component = None
            with contextlib.suppress(BrokenPipeError):
                self._far.stdin.close()
            self._far.wait()
            self._far.stdout.close()
