"""Ctrl-C where an exception would be lost: inside a call of a library, in a callback, or while an object is freed."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def held_back() -> Iterator[list[BaseException]]:
    """Ctrl-C becomes an entry of the list, and is raised at the end. What waits meanwhile looks at the list."""
    noted: list[BaseException] = []
    own = threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if own:
        signal.signal(signal.SIGINT, lambda *_: noted.append(KeyboardInterrupt()))
    try:
        yield noted
    finally:
        if own:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    if noted:
        raise noted[0]
