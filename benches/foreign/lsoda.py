"""LSODA without Python in its loops: the C++ translation in numbalsoda's sources, compiled with the local compiler.

The whole of numbalsoda also needs a Fortran compiler, for a method that is not compared here.
"""

import ctypes as c
import shutil
import subprocess
import sys
import tarfile
import time

import numpy as np

from library import POINTER, address, declare

VERSION = "0.3.4"
MOST_STEPS = 20_000_000


class Lsoda:
    """The compiled LSODA; raises OSError if it cannot be built."""

    def __init__(self, folder):
        library = folder / f"liblsoda-{VERSION}.so"
        if not library.exists():
            build(folder, library)
        self.call = declare(c.CDLL(str(library)), "lsoda_wrapper", None, POINTER, c.c_int, POINTER, POINTER, c.c_int, POINTER,
                            POINTER, c.c_double, c.c_double, c.c_int, POINTER)

    def solve(self, run, times, rtol, atol):
        """CPU time [s], states at `times`, and 0 if the last time was reached."""
        at = np.concatenate(([run.t0], times))
        out, success = np.full((len(at), run.size), np.nan), c.c_int()
        begin = time.thread_time()
        self.call(address(run.lib.foreign_rhs), run.size, run.u0.ctypes.data, run.handle, len(at), at.ctypes.data,
                  out.ctypes.data, rtol, atol, MOST_STEPS, c.byref(success))
        cost = time.thread_time() - begin
        return cost, out[1:], 0 if success.value else 1


def build(folder, library):
    compiler = next(filter(None, map(shutil.which, ("c++", "g++", "clang++"))), None)
    if compiler is None:
        raise OSError("no C++ compiler")
    folder.mkdir(parents=True, exist_ok=True)
    fetched = subprocess.run(
        [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps", "--no-binary",
         "numbalsoda", "--dest", str(folder), f"numbalsoda=={VERSION}"], capture_output=True, text=True)
    if fetched.returncode:
        raise OSError("numbalsoda's sources cannot be fetched")
    with tarfile.open(folder / f"numbalsoda-{VERSION}.tar.gz") as archive:
        archive.extractall(folder, filter="data")
    sources = folder / f"numbalsoda-{VERSION}" / "src"
    built = subprocess.run([compiler, "-O3", "-std=c++11", "-shared", "-fPIC", "-w", "-o", str(library),
                            *map(str, (sources / "LSODA.cpp", sources / "wrapper.cpp"))], capture_output=True, text=True)
    if built.returncode:
        raise OSError("LSODA does not compile")
