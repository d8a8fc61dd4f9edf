"""Ctrl-C in tests, and commands whose results are kept more often than usual."""

import signal
import sys

# a part every so many seconds, and files of so many bytes at most
CHANGED = """
import resource, sys
from bevel_differential import Fmu
from bevel_differential.command import main
from bevel_differential.designs import store
# before files are short
Fmu.of(sys.argv[sys.argv.index("--fmu") + 1])
store.INTERVAL, most = float(sys.argv[1]), int(sys.argv[2])
if most:
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
sys.exit(main(sys.argv[3:]))
"""


def with_interrupts():
    """Ctrl-C acts in a process that begins with this: what a shell runs in the background inherits that it is ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def changed_command(interval, arguments, most=0):
    """The command with a part of its results every `interval` seconds, so that there is one to find long before the end; `most`: bytes
    of a file."""
    return [sys.executable, "-c", CHANGED, str(interval), str(most), *arguments]
