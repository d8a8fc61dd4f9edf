"""Ctrl-C in tests, and commands that save their results more often than usual."""

import shlex
import signal
import sys

# saves a part at this interval, s, and limits files to this number of bytes
CHANGED = """
import resource, sys
from bevel_differential import Fmu
from bevel_differential.command import main
from bevel_differential.designs import store
# before files are short
Fmu.of()
store.INTERVAL, most = float(sys.argv[1]), int(sys.argv[2])
if most:
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
sys.exit(main(sys.argv[3:]))
"""


def with_interrupts():
    """Makes Ctrl-C act in a process that starts with this call; shells let background processes ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def changed_command(interval, line, most=0):
    """Command that saves a part of its results every `interval` seconds, so that one exists long before the end; `most`: maximum size of
    a file, bytes."""
    return [sys.executable, "-c", CHANGED, str(interval), str(most), *shlex.split(line)]
