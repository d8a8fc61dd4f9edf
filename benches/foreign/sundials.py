"""CVODE without Python in its loops: the libraries bundled with the wheel of scikit-SUNDAE, called through their C functions."""

import ctypes as c
import importlib.util
import time
from pathlib import Path

import numpy as np

from library import POINTER, address, declare

BDF, ADAMS = 2, 1
MOST_STEPS = 20_000_000


class Sundials:
    """The loaded libraries; raises OSError if there are none."""

    def __init__(self):
        spec = importlib.util.find_spec("sksundae")
        if spec is None or spec.origin is None:
            raise OSError("scikit-SUNDAE is not installed")
        folder = Path(spec.origin).parent.parent / "scikit_sundae.libs"

        def load(name):
            found = sorted(folder.glob(f"libsundials_{name}-*"))
            if not found:
                raise OSError(f"libsundials_{name} is not where scikit-SUNDAE's wheel for Linux keeps it")
            return c.CDLL(str(found[0]), mode=c.RTLD_GLOBAL)

        core, vector, matrix, solver, cvode = map(load, ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode"))
        number, long, real = c.c_int, c.c_int64, c.c_double
        self.context_new = declare(core, "SUNContext_Create", number, number, POINTER)
        self.entries = declare(core, "N_VGetArrayPointer", POINTER, POINTER)
        self.vector_new = declare(vector, "N_VNew_Serial", POINTER, long, POINTER)
        self.matrix_new = declare(matrix, "SUNDenseMatrix", POINTER, long, long, POINTER)
        self.matrix_data = declare(matrix, "SUNDenseMatrix_Data", POINTER, POINTER)
        self.solver_new = declare(solver, "SUNLinSol_Dense", POINTER, POINTER, POINTER, POINTER)
        self.new = declare(cvode, "CVodeCreate", POINTER, number, POINTER)
        self.init = declare(cvode, "CVodeInit", number, POINTER, POINTER, real, POINTER)
        self.again = declare(cvode, "CVodeReInit", number, POINTER, real, POINTER)
        self.tolerances = declare(cvode, "CVodeSStolerances", number, POINTER, real, real)
        self.set_solver = declare(cvode, "CVodeSetLinearSolver", number, POINTER, POINTER, POINTER)
        self.set_jacobian = declare(cvode, "CVodeSetJacFn", number, POINTER, POINTER)
        self.set_user = declare(cvode, "CVodeSetUserData", number, POINTER, POINTER)
        self.set_steps = declare(cvode, "CVodeSetMaxNumSteps", number, POINTER, c.c_long)
        self.steps = declare(cvode, "CVodeGetNumSteps", number, POINTER, POINTER)
        self.step = cvode.CVode
        context = POINTER()
        check(self.context_new(0, c.byref(context)))
        self.context = context
        # errors are returned as numbers, so the additional text on the terminal is switched off
        clear = declare(core, "SUNContext_ClearErrHandlers", number, POINTER)
        check(clear(context))


def check(status):
    if status:
        raise OSError(f"SUNDIALS refuses a call: {status}")


class Cvode:
    """CVODE for a run: `method` BDF or ADAMS, with the exact Jacobian or its own difference quotients."""

    def __init__(self, sundials, run, method, exact):
        self.s, self.run = s, run = sundials, run
        run.lib.foreign_sundials(run.handle, address(s.entries), address(s.matrix_data))
        self.vector = s.vector_new(run.size, s.context)
        self.memory = s.new(method, s.context)
        self.fill()
        check(s.init(self.memory, address(run.lib.foreign_cvode_rhs), run.t0, self.vector))
        check(s.tolerances(self.memory, 1e-6, 1e-6))
        matrix = s.matrix_new(run.size, run.size, s.context)
        check(s.set_solver(self.memory, s.solver_new(self.vector, matrix, s.context), matrix))
        if exact:
            check(s.set_jacobian(self.memory, address(run.lib.foreign_cvode_jacobian)))
        check(s.set_user(self.memory, run.handle))
        check(s.set_steps(self.memory, MOST_STEPS))

    def fill(self):
        c.memmove(self.s.entries(self.vector), self.run.u0.ctypes.data, 8 * self.run.size)

    def solve(self, times, rtol, atol):
        """CPU time [s], states at `times`, CVODE's return value, and the number of steps."""
        s, run = self.s, self.run
        self.fill()
        check(s.again(self.memory, run.t0, self.vector))
        check(s.tolerances(self.memory, rtol, atol))
        out = np.full((len(times), run.size), np.nan)
        begin = time.thread_time()
        status = run.lib.foreign_cvode(run.handle, address(s.step), self.memory, self.vector, times.ctypes.data, len(times),
                                       out.ctypes.data)
        cost = time.thread_time() - begin
        steps = c.c_long()
        s.steps(self.memory, c.byref(steps))
        return cost, out, status, steps.value
