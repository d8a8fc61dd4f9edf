"""The library in the host's process: floating-point traps, memory after unloading."""

import platform
import subprocess
import sys
from pathlib import Path

import pytest

LINUX = sys.platform == "linux" and platform.machine() == "x86_64"
# growth that a process may have [KiB per simulation]
FLAT = 5.0


def host(name, *arguments):
    """Result of a host in a separate process."""
    script = Path(__file__).with_name(name)
    return subprocess.run([sys.executable, script, *map(str, arguments)], capture_output=True, text=True, timeout=300)


@pytest.mark.skipif(not LINUX, reason="the host sets traps of x86-64 by glibc")
def test_no_scene_stops_a_host_that_traps_floating_point_exceptions(fmu_file, fmu3):
    done = host("trapping_host.py", fmu_file, fmu3)
    assert (done.returncode, done.stdout.splitlines()[-1:]) == (0, ["complete"]), done.stdout[-200:] + done.stderr[-2000:]


@pytest.mark.skipif(not LINUX, reason="memory is read from /proc")
def test_a_host_that_loads_and_unloads_the_library_for_each_simulation_does_not_grow(fmu_file, fmu3):
    done = host("loading_host.py", fmu_file, fmu3)
    assert done.returncode == 0, done.stderr
    found = [float(line) for line in done.stdout.split()]
    assert len(found) == 4 and max(found) < FLAT, found
