"""Holds Ctrl-C back where an exception would be lost: inside a library call, in a callback, or while an object is freed."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def held_back() -> Iterator[list[BaseException]]:
    """Turns Ctrl-C into an entry of the list, which is raised at the end. Code that waits in the context must check the list."""
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
