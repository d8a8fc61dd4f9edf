"""The program's equations of motion in the library foreign-solvers."""

import ctypes as c

import numpy as np

OUTPUTS = 6
POINTER, NUMBER, TEXT = c.c_void_p, c.c_double, c.c_char_p


class Library:
    """Functions of the library at `path`."""

    def __init__(self, path):
        self.c = lib = c.CDLL(str(path))
        declare(lib, "foreign_new", POINTER, TEXT, TEXT, NUMBER, POINTER)
        declare(lib, "foreign_free", None, POINTER)
        declare(lib, "foreign_size", c.c_int, POINTER)
        declare(lib, "foreign_scale", None, POINTER, POINTER)
        declare(lib, "foreign_start", NUMBER, POINTER, POINTER)
        declare(lib, "foreign_counts", None, POINTER, POINTER)
        declare(lib, "foreign_message", TEXT, POINTER)
        declare(lib, "foreign_drive", None, POINTER, NUMBER, NUMBER, NUMBER)
        declare(lib, "foreign_inertias", None, POINTER, POINTER)
        declare(lib, "foreign_rhs", None, NUMBER, POINTER, POINTER, POINTER)
        declare(lib, "foreign_jacobian", None, NUMBER, POINTER, POINTER, POINTER)
        declare(lib, "foreign_outputs", None, POINTER, POINTER, POINTER)
        declare(lib, "foreign_own", c.c_int, POINTER, POINTER, c.c_size_t, POINTER, POINTER)
        declare(lib, "foreign_sundials", None, POINTER, POINTER, POINTER)
        declare(lib, "foreign_cvode", c.c_int, POINTER, POINTER, POINTER, POINTER, POINTER, c.c_size_t, POINTER)


def declare(library, name, result, *arguments):
    function = getattr(library, name)
    function.restype, function.argtypes = result, arguments
    return function


def address(function):
    return c.cast(function, POINTER).value


def lines(values):
    return "".join(f"{name} {value if isinstance(value, str) else repr(float(value))}\n" for name, value in values.items()).encode()


class Run:
    """A run from the start with `values` by name, or from the time `start` [s] of the change to the `later` values."""

    def __init__(self, library, values, later=None, start=0.0):
        self.lib, problem = library.c, TEXT()
        self.handle = self.lib.foreign_new(lines(values), lines(later or {}), start, c.byref(problem))
        if not self.handle:
            raise ValueError(problem.value.decode())
        self.size = self.lib.foreign_size(self.handle)
        self.scale(np.ones(self.size))

    def scale(self, magnitudes):
        """Sets the natural magnitudes by which positions and velocities are divided for solvers."""
        self.lib.foreign_scale(self.handle, magnitudes.ctypes.data)
        self.u0 = np.zeros(self.size)
        self.t0 = self.lib.foreign_start(self.handle, self.u0.ctypes.data)

    def close(self):
        self.lib.foreign_free(self.handle)

    def python_rhs(self):
        """Right-hand side as a Python function f(t, u) with minimal Python code."""
        return self._python(self.lib.foreign_rhs, self.size)

    def python_jacobian(self):
        return self._python(self.lib.foreign_jacobian, (self.size, self.size))

    def _python(self, call, shape):
        handle, result, u_in = self.handle, np.empty(shape), np.empty(self.size)
        at, source = result.ctypes.data, u_in.ctypes.data

        def function(t, u):
            u_in[:] = u
            call(t, source, at, handle)
            return result.copy()

        return function

    def counts(self):
        counts = np.zeros(2, dtype=np.uint64)
        self.lib.foreign_counts(self.handle, counts.ctypes.data)
        return int(counts[0]), int(counts[1])

    def inertias(self):
        """Inertias of carrier, a side gear and all planets about their own axes."""
        values = np.empty(3)
        self.lib.foreign_inertias(self.handle, values.ctypes.data)
        return values

    def outputs(self, states):
        """Outputs at states, one row each."""
        out = np.empty((len(states), OUTPUTS))
        for k, u in enumerate(np.ascontiguousarray(states)):
            self.lib.foreign_outputs(self.handle, u.ctypes.data, out[k:].ctypes.data)
        return out

    def own(self, times):
        """CPU time [s] of the program's own method to `times`, outputs at these times, status, and its statistics."""
        out, cost = np.full((len(times), OUTPUTS), np.nan), NUMBER()
        status = self.lib.foreign_own(self.handle, times.ctypes.data, len(times), out.ctypes.data, c.byref(cost))
        return cost.value, out, status, self.lib.foreign_message(self.handle).decode()
