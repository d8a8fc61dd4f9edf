"""Library of answers, loaded once: replies to questions, and the schedules of runs."""

import ctypes
import json
import os
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from . import machine

_PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double, ctypes.c_char_p)


def reply(question: Mapping[str, Any], numbers: np.ndarray | None = None,
          on_progress: Callable[[Any, float, bytes], int] = lambda *_: 0) -> dict[str, Any]:
    """Reply to a question: a dict with "answer" or "problems". `on_progress(_, done, what)` stops the work if it does not return 0.
    Raises `OSError` if the library is missing."""
    library = _library()
    values = np.ascontiguousarray([] if numbers is None else numbers, np.float64).ravel()
    text = json.dumps(question, default=_plain).encode()
    found = library.bd_ask(text, values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), len(values), _PROGRESS(on_progress), None)
    try:
        return json.loads(ctypes.string_at(found))
    finally:
        library.bd_free(found)


def schedule(question: np.ndarray, tables: int) -> tuple[int, np.ndarray]:
    """Number of rows, and the rows of a run's schedule: its start, then each step. bd_answers.h describes question, rows and a number
    below 1. Raises `OSError` if the library is missing."""
    library = _library()
    kinds = [*((name, float) for name in ("begin", "size", "end", "due", "jumps", "recorded")), *((name, float, tables) for name in ("values", "slopes"))]
    count = library.bd_schedule(question.ctypes.data, len(question), question.ctypes.data, 0)
    rows = np.empty(max(count, 0), kinds)
    library.bd_schedule(question.ctypes.data, len(question), rows.ctypes.data, rows.nbytes // 8)
    return count, rows


@cache
def _library() -> ctypes.CDLL:
    platform, shipped = machine.answers(Path(__file__).with_name("answers"))
    file = Path(os.environ.get("BEVEL_DIFFERENTIAL_ANSWERS") or shipped)
    if not file.is_file():
        raise FileNotFoundError(f"{file} is missing: this package was built without its library of answers for {platform}; install "
                                "a wheel that has it, or name the library by the environment variable BEVEL_DIFFERENTIAL_ANSWERS")
    library = ctypes.CDLL(str(file))
    library.bd_ask.argtypes = [ctypes.c_char_p, ctypes.POINTER(ctypes.c_double), ctypes.c_size_t, _PROGRESS, ctypes.c_void_p]
    # an address instead of c_char_p, so that it can be freed
    library.bd_ask.restype = ctypes.c_void_p
    library.bd_free.argtypes, library.bd_free.restype = [ctypes.c_void_p], None
    library.bd_schedule.argtypes = [ctypes.c_void_p, ctypes.c_size_t] * 2
    library.bd_schedule.restype = ctypes.c_ssize_t
    return library


def _plain(value):
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    return os.fspath(value)
