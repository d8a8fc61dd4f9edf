"""An instance of the FMU. fmpy loads and instantiates; what is called in every step is called without its wrappers."""

import ctypes

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from .values import DifferentialError

# what the functions for each kind of variable are called, and what they take
CALLS = {"Real": ("Real", np.float64), "Integer": ("Integer", np.int32), "Enumeration": ("Integer", np.int32),
         "Boolean": ("Boolean", np.int32)}
# what the log is to have
LOGGED = ["logStatusWarning", "logStatusDiscard", "logStatusError"]
# statuses from here on are errors: fmi2Discard, fmi2Error, fmi2Fatal
DISCARD = 2
# fmpy's class and the element of the model description for each kind of instance
KINDS = {"CoSimulation": (FMU2Slave, "coSimulation"), "ModelExchange": (FMU2Model, "modelExchange")}


class Instance:
    """One instance of the FMU, driven call by call; `Fmu.open` makes it. It must be used by one thread at a time.

    Values are written as in `Differential` and read in SI. What the FMU refuses is a `DifferentialError` with the FMU's message
    and status.

    Attributes: `fmu`; `messages`, the warnings and errors that the FMU has logged since it was made or reset; `time` (s), to which
    `step` has come; `raw`, fmpy's object, for FMI functions that have no method here."""

    def __init__(self, fmu, kind="CoSimulation", name="differential"):
        if kind not in KINDS:
            raise DifferentialError(f"kind = {kind!r}: it is one of {', '.join(KINDS)}")
        self.fmu, self.messages, self.time = fmu, [], 0.0
        description = fmu.description
        make, element = KINDS[kind]
        self.raw = make(guid=description.guid, unzipDirectory=fmu.folder, instanceName=name,
                        modelIdentifier=getattr(description, element).modelIdentifier)
        # kept: the library calls them as long as the instance lives
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._record)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self.raw.instantiate(callbacks=self._callbacks, loggingOn=False)
        known = {category.name for category in description.logCategories}
        self.raw.setDebugLogging(True, [category for category in LOGGED if category in known])
        self._component = ctypes.c_void_p(self.raw.component)
        pointers = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        self._get, self._set = ({call: self._function(f"fmi2{verb}{call}", *pointers)
                                 for call in ("Real", "Integer", "Boolean")} for verb in ("Get", "Set"))
        self._setup = self._function("fmi2SetupExperiment", ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_double,
                                     ctypes.c_int, ctypes.c_double)
        self._enter, self._exit, self._reset = (self._function(f"fmi2{name}", ctypes.c_void_p) for name in
                                                ("EnterInitializationMode", "ExitInitializationMode", "Reset"))
        self._do_step = self._function("fmi2DoStep", ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int)
        self._is_fresh = True
        self._batches = {}

    def _function(self, name, *types):
        # by index ctypes gives a function of its own, whose types are not those of fmpy
        function = self.raw.dll[name]
        function.argtypes, function.restype = types, ctypes.c_int
        return function

    def _record(self, _environment, _name, status, category, message):
        # only what goes wrong: a quiet log
        if status >= 1:
            self.messages.append(message.decode(errors="replace"))

    def check(self, status, doing):
        """Raises the FMU's message if `status` is an error."""
        if status >= DISCARD:
            raise DifferentialError(self.messages[-1] if self.messages else f"{doing} failed with status {status}", status)

    def _through(self, call, *arguments):
        """Calls a method of `raw`; its error becomes that of `check`."""
        try:
            return call(*arguments)
        except FMICallException as caught:
            failure = caught
        self.check(failure.status, failure.function)

    def set(self, values=None, **keywords):
        """Sets parameters and inputs, given as to `Differential.set`."""
        self._write(self.fmu.numbers(values, **keywords))
        return self

    def _write(self, pairs):
        Batches([variable for variable, _ in pairs]).set(self, [number for _, number in pairs])

    def set_slopes(self, slopes):
        """Lets inputs change linearly in the steps to come, until they are set again.

        `slopes`: by name the change of a Real input in a second, SI units."""
        references = [self.fmu.variable(name).reference for name in slopes]
        self._through(self.raw.setRealInputDerivatives, references, [1] * len(slopes), list(slopes.values()))

    def get(self, name):
        """The value of one variable, in SI; of an enumeration its number."""
        return self.read((name,))[0]

    def read(self, names):
        """The values of several variables, as a list in their order."""
        names = tuple(names)
        if names not in self._batches:
            self._batches[names] = Batches([self.fmu.variable(name) for name in names])
        return self._batches[names].get(self)

    def initialise(self, values=None, stop=None):
        """Initialises at time 0, with `values` beside those that were set; `stop` (s): no step will go beyond it.

        After a run the instance is reset first."""
        self.start(self.fmu.numbers(values), stop)
        return self

    def start(self, values, stop):
        """The same with `values` as the FMU takes them: [(variable, number)]."""
        if not self._is_fresh:
            self.reset()
        self._is_fresh = False
        self.check(self._setup(self._component, 0, 0.0, 0.0, stop is not None, stop or 0.0), "fmi2SetupExperiment")
        self._write(values)
        self.check(self._enter(self._component), "fmi2EnterInitializationMode")
        self.check(self._exit(self._component), "fmi2ExitInitializationMode")

    def reset(self):
        """As new: all variables have their start values, nothing is logged."""
        self.check(self._reset(self._component), "fmi2Reset")
        self.messages.clear()
        self._is_fresh, self.time = True, 0.0

    def step(self, size):
        """A communication step from `time` on, s."""
        self.do_step(self.time, size)
        self.time += size

    def do_step(self, time, size):
        """A communication step from a time that the caller keeps, s."""
        status = self._do_step(self._component, time, size, 1)
        if status >= DISCARD:
            self.check(status, f"the step from {time:g} s")

    def save(self):
        """The state as (time, bytes), for this or another instance of the same FMU, in any process."""
        state = self._through(self.raw.getFMUstate)
        try:
            return self.time, self._through(self.raw.serializeFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)

    def restore(self, saved):
        """Goes back to what `save` gave."""
        time, kept = saved
        state = self._through(self.raw.deSerializeFMUstate, kept)
        try:
            self._through(self.raw.setFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)
        self.time, self._is_fresh = time, False
        return self

    def close(self):
        """Frees the instance. The library stays loaded: loading costs more than all else."""
        if self._component:
            self.raw.fmi2FreeInstance(self.raw.component)
            self._component = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Batches:
    """Variables in groups of their kinds, so that one call sets or gets a group. Order is kept within a kind.

    Values are as the FMU takes them, and nothing but the FMU checks them."""

    def __init__(self, variables):
        self.groups = []
        for call in ("Real", "Integer", "Boolean"):
            places = [place for place, variable in enumerate(variables) if CALLS[variable.kind][0] == call]
            if places:
                references = np.array([variables[place].reference for place in places], np.uint32)
                dtype = np.float64 if call == "Real" else np.int32
                self.groups.append((call, places, references, dtype))

    def set(self, instance, values):
        """Sets all."""
        for call, places, references, dtype in self.groups:
            numbers = np.array([values[place] for place in places], dtype)
            status = instance._set[call](instance._component, references.ctypes.data, len(places), numbers.ctypes.data)
            instance.check(status, f"setting {call} variables")

    def get(self, instance):
        """Gets all, as a list in the order of the variables."""
        values = {}
        for call, places, references, dtype in self.groups:
            numbers = np.empty(len(places), dtype)
            status = instance._get[call](instance._component, references.ctypes.data, len(places), numbers.ctypes.data)
            instance.check(status, f"getting {call} variables")
            values.update(zip(places, (numbers != 0 if call == "Boolean" else numbers).tolist()))
        return [values[place] for place in range(len(values))]

    def record(self, rows):
        """Room for `rows` rows of all groups, as a list of arrays (rows, variables of a kind)."""
        return [np.empty((rows, len(places)), dtype) for _, places, _, dtype in self.groups]

    def readers(self, instance, record):
        """For each group a function and its arguments, to which the address of a row is added: (function, component, references,
        count, address of the first row, bytes of a row)."""
        return [(instance._get[call], instance._component, ctypes.c_void_p(references.ctypes.data), len(places),
                 block.ctypes.data, block.strides[0])
                for (call, places, references, _), block in zip(self.groups, record)]
