"""Ctrl-C in tests."""

import signal


def with_interrupts():
    """Ctrl-C acts in a process that begins with this: what a shell runs in the background inherits that it is ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
