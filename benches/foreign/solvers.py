"""Compared solvers, each with a name, variants, and a function that runs it."""

import time
import warnings
from dataclasses import dataclass

import numpy as np
from scipy.integrate import odeint, solve_ivp

import lsoda
import sundials
from library import OUTPUTS

# relative and absolute tolerance as multiples of a solver's tolerance. For every solver, the allowed error is rtol·|u| + atol, with u in
# units of its natural magnitude. "absolute" corresponds to this program's own error control.
SHARES = {"absolute": (0.0, 1.0), "relative": (1.0, 1.0)}
# smallest relative tolerance that every solver accepts without a warning
LEAST_RTOL = 1e-13
OURS = "this program"
MOST_STEPS = 10_000_000


@dataclass
class Outcome:
    """Result of a run."""

    cost: float
    outputs: np.ndarray
    calls: int
    jacobians: int
    status: int
    message: str = ""


@dataclass
class Solver:
    """A solver in one variant; `integrate(run, times, tolerance)` runs it."""

    name: str
    variant: str
    integrate: object
    own_method: str = ""
    slow: bool = False

    @property
    def label(self):
        return f"{self.name}, {self.variant}" if self.variant else self.name


def all_solvers(folder):
    """Available solvers, and remarks about missing ones."""
    found = [Solver(OURS, "", own, own_method="adaptive"), Solver(f"{OURS}, method radau", "", own, own_method="radau")]
    missing = []
    try:
        library = sundials.Sundials()
        for name, method in (("CVODE BDF", sundials.BDF), ("CVODE Adams", sundials.ADAMS)):
            for jacobian in ("exact Jacobian", "differences"):
                for share in SHARES:
                    found.append(Solver(f"{name}, compiled", f"{jacobian}, {share}",
                                        cvode(library, method, jacobian.startswith("exact"), share)))
    except OSError as problem:
        missing.append(f"CVODE: {problem}")
    try:
        library = lsoda.Lsoda(folder)
        for share in SHARES:
            found.append(Solver("LSODA, compiled", share, compiled_lsoda(library, share)))
    except OSError as problem:
        missing.append(f"compiled LSODA: {problem}")
    solvers = {"scipy odeint (LSODA)": scipy_odeint, "scipy solve_ivp LSODA": scipy_ivp("LSODA"),
               "scipy solve_ivp Radau": scipy_ivp("Radau")}
    for share in SHARES:
        for exact in (True, False):
            variant = f"{'exact Jacobian' if exact else 'differences'}, {share}"
            found += [Solver(name, variant, in_python(solve, exact, share), slow=True) for name, solve in solvers.items()]
    try:
        from sksundae.cvode import CVODE

        for share in SHARES:
            integrate = in_python(sundae(CVODE), True, share)
            found.append(Solver("scikit-SUNDAE CVODE BDF", f"exact Jacobian, {share}", integrate, slow=True))
    except ImportError as problem:
        missing.append(f"scikit-SUNDAE: {problem}")
    return found, missing


def tolerances(share, tolerance):
    relative, absolute = SHARES[share]
    return max(LEAST_RTOL, relative * tolerance), absolute * tolerance


def own(run, times, tolerance):
    cost, outputs, status, account = run.own(times)
    return Outcome(cost, outputs, *run.counts(), status, account)


def cvode(library, method, exact, share):
    prepared = {}

    def integrate(run, times, tolerance):
        if run not in prepared:
            prepared[run] = sundials.Cvode(library, run, method, exact)
        run.counts()
        cost, states, status, steps = prepared[run].solve(times, *tolerances(share, tolerance))
        return Outcome(cost, run.outputs(states), *run.counts(), status, f"{steps} steps")

    return integrate


def compiled_lsoda(library, share):
    def integrate(run, times, tolerance):
        run.counts()
        cost, states, status = library.solve(run, times, *tolerances(share, tolerance))
        return Outcome(cost, run.outputs(states), *run.counts(), status)

    return integrate


def in_python(solve, exact, share):
    """A solver that calls Python.

    `solve(rhs, jacobian, u0, at, rtol, atol)` returns the states at all of `at`, starting with the initial one, and an error message or
    an empty text."""
    def integrate(run, times, tolerance):
        rhs, jacobian = run.python_rhs(), run.python_jacobian() if exact else None
        at = np.concatenate(([run.t0], times))
        run.counts()
        begin = time.thread_time()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            states, problem = solve(rhs, jacobian, run.u0, at, *tolerances(share, tolerance))
        cost, counts = time.thread_time() - begin, run.counts()
        complete = not problem and len(states) == len(at)
        outputs = run.outputs(states[1:]) if complete else np.full((len(times), OUTPUTS), np.nan)
        return Outcome(cost, outputs, *counts, 0 if complete else 1, problem)

    return integrate


def scipy_ivp(method):
    def solve(rhs, jacobian, u0, at, rtol, atol):
        result = solve_ivp(rhs, (at[0], at[-1]), u0, method=method, t_eval=at, rtol=rtol, atol=atol, jac=jacobian)
        return result.y.T, "" if result.success else result.message

    return solve


def scipy_odeint(rhs, jacobian, u0, at, rtol, atol):
    states, info = odeint(rhs, u0, at, Dfun=jacobian, rtol=rtol, atol=atol, tfirst=True, mxstep=MOST_STEPS, full_output=True)
    return states, "" if "successful" in info["message"] else info["message"]


def sundae(solver):
    def solve(rhs, jacobian, u0, at, rtol, atol):
        def rates(t, u, rate):
            rate[:] = rhs(t, u)

        def slopes(t, u, rate, matrix):
            matrix[:, :] = jacobian(t, u)

        result = solver(rates, rtol=rtol, atol=atol, method="BDF", jacfn=slopes, max_num_steps=MOST_STEPS).solve(at, u0)
        return result.y, "" if result.success else str(result.message)

    return solve
