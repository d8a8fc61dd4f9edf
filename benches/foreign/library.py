"""The program's equations of motion, as the library foreign-solvers offers them."""

import ctypes as c
import time

import numpy as np

OUTPUTS = 6
POINTER = c.c_void_p


class Library:
    """The functions of the library at `path`."""

    def __init__(self, path):
        self.c = lib = c.CDLL(str(path))
        declare(lib, "foreign_new", POINTER, c.c_char_p, c.c_char_p, c.c_char_p, c.c_double, c.c_char_p, c.c_size_t)
        declare(lib, "foreign_free", None, POINTER)
        declare(lib, "foreign_size", c.c_int, POINTER)
        declare(lib, "foreign_start", c.c_double, POINTER, POINTER)
        declare(lib, "foreign_counts", None, POINTER, POINTER)
        declare(lib, "foreign_rhs", None, c.c_double, POINTER, POINTER, POINTER)
        declare(lib, "foreign_jacobian", None, c.c_double, POINTER, POINTER, POINTER)
        declare(lib, "foreign_outputs", None, POINTER, POINTER, POINTER)
        declare(lib, "foreign_sundials", None, POINTER, POINTER, POINTER)
        declare(lib, "foreign_cvode", c.c_int, POINTER, POINTER, POINTER, POINTER, POINTER, c.c_size_t, POINTER)
        declare(lib, "foreign_prepare", None, POINTER, c.c_size_t)
        declare(lib, "foreign_own", c.c_int, POINTER, POINTER, c.c_size_t)
        declare(lib, "foreign_reached", c.c_int, POINTER, POINTER)
        declare(lib, "foreign_message", None, POINTER, c.c_char_p, c.c_size_t)


def declare(library, name, result, *arguments):
    function = getattr(library, name)
    function.restype, function.argtypes = result, arguments
    return function


def address(function):
    return c.cast(function, POINTER).value


class Run:
    """A case at a level of teeth; `method` and `tolerance` are those of the program's own solver."""

    def __init__(self, library, case, level, method="adaptive", tolerance=1e-6):
        self.lib, problem = library.c, c.create_string_buffer(1000)
        self.handle = self.lib.foreign_new(case.encode(), level.encode(), method.encode(), tolerance, problem, 1000)
        if not self.handle:
            raise ValueError(problem.value.decode())
        self.size = self.lib.foreign_size(self.handle)
        self.u0 = np.zeros(self.size)
        self.t0 = self.lib.foreign_start(self.handle, self.u0.ctypes.data)

    def close(self):
        self.lib.foreign_free(self.handle)

    def python_rhs(self):
        """The right-hand side as a Python function f(t, u), with as little of Python in it as can be."""
        call, handle, rate = self.lib.foreign_rhs, self.handle, np.empty(self.size)
        at, u_in = rate.ctypes.data, np.empty(self.size)
        source = u_in.ctypes.data

        def rhs(t, u):
            u_in[:] = u
            call(t, source, at, handle)
            return rate.copy()

        return rhs

    def python_jacobian(self):
        call, handle, rows = self.lib.foreign_jacobian, self.handle, np.empty((self.size, self.size))
        at, u_in = rows.ctypes.data, np.empty(self.size)
        source = u_in.ctypes.data

        def jacobian(t, u):
            u_in[:] = u
            call(t, source, at, handle)
            return rows.copy()

        return jacobian

    def counts(self):
        counts = np.zeros(2, dtype=np.uint64)
        self.lib.foreign_counts(self.handle, counts.ctypes.data)
        return int(counts[0]), int(counts[1])

    def outputs(self, states):
        """Outputs at states, a row each."""
        out = np.empty((len(states), OUTPUTS))
        for k, u in enumerate(np.ascontiguousarray(states)):
            self.lib.foreign_outputs(self.handle, u.ctypes.data, out[k:].ctypes.data)
        return out

    def own(self, times):
        """CPU time [s] of the program's own method to `times`, outputs there, and its account."""
        self.lib.foreign_prepare(self.handle, len(times))
        begin = time.thread_time()
        status = self.lib.foreign_own(self.handle, times.ctypes.data, len(times))
        cost = time.thread_time() - begin
        out = np.full((len(times), OUTPUTS), np.nan)
        self.lib.foreign_reached(self.handle, out.ctypes.data)
        text = c.create_string_buffer(2000)
        self.lib.foreign_message(self.handle, text, 2000)
        return cost, out, status, text.value.decode()
