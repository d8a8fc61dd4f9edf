"""An instance of the FMU. fmpy loads and instantiates; what is called in every step is called without its wrappers."""

import ctypes
from functools import lru_cache

import numpy as np
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from .values import DifferentialError

# what the functions for each kind of variable are called, and what they take
CALLS = {"Real": ("Real", np.float64), "Integer": ("Integer", np.int32), "Enumeration": ("Integer", np.int32),
         "Boolean": ("Boolean", np.int32)}
# what the log is to have
LOGGED = ["logStatusWarning", "logStatusDiscard", "logStatusError"]
# statuses from here on are errors: fmi2Discard, fmi2Error, fmi2Fatal
DISCARD = 2


class Instance:
    """One instance, kept and reset. It must be used by one thread at a time."""

    def __init__(self, fmu):
        self.messages = []
        description = fmu.description
        self._slave = FMU2Slave(guid=description.guid, unzipDirectory=fmu.folder, instanceName="differential",
                                modelIdentifier=description.coSimulation.modelIdentifier)
        # kept: the library calls them as long as the instance lives
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._record)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self._slave.instantiate(callbacks=self._callbacks, loggingOn=False)
        self._slave.setDebugLogging(True, LOGGED)
        self._component = ctypes.c_void_p(self._slave.component)
        pointers = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        self._get, self._set = ({call: self._function(f"fmi2{verb}{call}", *pointers)
                                 for call in ("Real", "Integer", "Boolean")} for verb in ("Get", "Set"))
        self._do_step = self._function("fmi2DoStep", ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int)
        self._setup = self._function("fmi2SetupExperiment", ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_double,
                                     ctypes.c_int, ctypes.c_double)
        self._reset, self._enter, self._exit = (
            self._function(name, ctypes.c_void_p)
            for name in ("fmi2Reset", "fmi2EnterInitializationMode", "fmi2ExitInitializationMode"))
        self._is_fresh = True

    def _function(self, name, *types):
        # by index ctypes gives a function of its own, whose types are not those of fmpy
        function = self._slave.dll[name]
        function.argtypes, function.restype = types, ctypes.c_int
        return function

    def _record(self, _environment, _name, status, category, message):
        # only what goes wrong: a quiet log
        if status >= 1:
            self.messages.append(message.decode(errors="replace"))

    def check(self, status, doing):
        """Raises the FMU's message if `status` is an error."""
        if status >= DISCARD:
            raise DifferentialError(self.messages[-1] if self.messages else f"{doing} failed with status {status}")

    def start(self, values, stop):
        """Initialises with `values` ([(variable, value)], as the FMU takes them)."""
        if not self._is_fresh:
            self.check(self._reset(self._component), "fmi2Reset")
        self._is_fresh = False
        self.messages.clear()
        self.check(self._setup(self._component, 0, 0.0, 0.0, 1, stop), "fmi2SetupExperiment")
        Batches.of(tuple(variable for variable, _ in values)).set(self, [value for _, value in values])
        self.check(self._enter(self._component), "fmi2EnterInitializationMode")
        self.check(self._exit(self._component), "fmi2ExitInitializationMode")

    def do_step(self, time, size):
        """A communication step, s."""
        status = self._do_step(self._component, time, size, 1)
        if status >= DISCARD:
            self.check(status, f"the step from {time:g} s")

    def close(self):
        """Frees the instance. The library stays loaded: loading costs more than all else."""
        if self._component:
            self._slave.fmi2FreeInstance(self._slave.component)
            self._component = None

    def __del__(self):
        # of a thread that has ended, or where nobody has closed it
        if getattr(self, "_component", None):
            self.close()


class Batches:
    """Variables in groups of their kinds, so that one call sets or gets a group. Order is kept within a kind."""

    def __init__(self, variables):
        self.groups = []
        for call in ("Real", "Integer", "Boolean"):
            places = [place for place, variable in enumerate(variables) if CALLS[variable.kind][0] == call]
            if places:
                references = np.array([variables[place].reference for place in places], np.uint32)
                dtype = np.float64 if call == "Real" else np.int32
                self.groups.append((call, places, references, dtype))

    @staticmethod
    @lru_cache(256)
    def of(variables: tuple) -> "Batches":
        """Those of these variables, kept: designs of a sweep share them."""
        return Batches(variables)

    def set(self, instance, values):
        """Sets all."""
        for call, places, references, dtype in self.groups:
            numbers = np.array([values[place] for place in places], dtype)
            status = instance._set[call](instance._component, references.ctypes.data, len(places), numbers.ctypes.data)
            instance.check(status, f"setting {call} variables")

    def record(self, rows):
        """Room for `rows` rows of all groups, as a list of arrays (rows, variables of a kind)."""
        return [np.empty((rows, len(places)), dtype) for _, places, _, dtype in self.groups]

    def readers(self, instance, record):
        """For each group a function and its arguments, to which the address of a row is added: (function, component, references,
        count, address of the first row, bytes of a row)."""
        return [(instance._get[call], instance._component, ctypes.c_void_p(references.ctypes.data), len(places),
                 block.ctypes.data, block.strides[0])
                for (call, places, references, _), block in zip(self.groups, record)]
