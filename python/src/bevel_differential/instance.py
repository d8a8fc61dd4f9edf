"""Instance of the FMU. fmpy loads and instantiates it; calls of every step bypass fmpy's wrappers."""

import contextlib
import ctypes
import re
from collections.abc import Iterable, Mapping
from typing import Any, Self

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from . import machine
from .batches import CALLS, Batches
from .points import TimeValue, duration, seconds
from .port import Port, rate
from .values import DISCARD, NOBODY_SET, UNFELT, DifferentialError, Number, Value, Variable

# categories of the log
LOGGED = ["logStatusWarning", "logStatusDiscard", "logStatusError"]
# text in a log for hosts around the words of an error: the failed call before it, and helpful calls after it
_CALLS = re.compile(r"^fmi[23]\w+: (?:initialisation failed:\s*)?|; continue with fmi[23]\w+ or fmi[23]\w+$")
# text in an error about a value that comes too late, and its text for users of Python
_TOO_LATE = re.compile(r"it can be set only before fmi[23]ExitInitializationMode")
_AT_START = "it can be set only at the start: set it in `initialise(…)`"
# prefixes of refusals that concern the call instead of a value
_ABOUT_CALL = ("not legal in", "this call")
# fmpy's class and the element of the model description for each kind of instance
KINDS = {"CoSimulation": (FMU2Slave, "coSimulation"), "ModelExchange": (FMU2Model, "modelExchange")}


class Closing:
    """Object that `close`, or the end of a `with` statement, frees."""

    def close(self) -> None:
        """Frees the object."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Instance(Closing):
    """One instance of the FMU for single calls; `Fmu.open` creates it. It must be used by one thread at a time.

    Values are written as in `Differential` and read in SI. If the FMU refuses a call, this raises `DifferentialError` with the FMU's
    message and status.

    Attributes: `fmu`, its `Fmu`; `messages`, the warnings and errors that the FMU has logged since the instance was created or reset;
    `events`, its other log entries; `time` (s), which `step` has reached; `raw`, fmpy's object, for FMI functions without a method
    here."""

    def __init__(self, fmu: Any, kind: str = "CoSimulation", name: str = "differential"):
        if kind not in KINDS:
            raise DifferentialError(f"kind = {kind!r}: it is one of {', '.join(KINDS)}")
        self.fmu, self.time = fmu, 0.0
        self.messages: list[str] = []
        self.events: list[str] = []
        self._failure: str | None = None
        description = fmu.description
        if description.fmiVersion != "2.0":
            raise DifferentialError(f"{fmu.file}: it is a unit of FMI {description.fmiVersion}, and this package runs FMI 2.0: name "
                                    "BevelDifferential.fmu")
        make, element = KINDS[kind]
        identifier = getattr(description, element).modelIdentifier
        self.raw = make(guid=description.guid, unzipDirectory=fmu.folder, instanceName=name, modelIdentifier=identifier,
                        libraryPath=machine.fmu_library(fmu.folder, identifier))
        # the instance keeps them, because the library calls them during its lifetime
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._record)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self.raw.instantiate(callbacks=self._callbacks, loggingOn=False)
        # a quiet log of problems only
        self.log(LOGGED)
        self._component: ctypes.c_void_p | None = ctypes.c_void_p(self.raw.component)
        pointers = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        self._get, self._set = ({call: self._function(f"fmi2{verb}{call}", *pointers)
                                 for call in ("Real", "Integer", "Boolean")} for verb in ("Get", "Set"))
        self._setup = self._function("fmi2SetupExperiment", ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_double,
                                     ctypes.c_int, ctypes.c_double)
        self._enter, self._exit, self._reset = (self._function(f"fmi2{name}", ctypes.c_void_p) for name in
                                                ("EnterInitializationMode", "ExitInitializationMode", "Reset"))
        self._set_rates = self._function("fmi2SetRealInputDerivatives", ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t,
                                         ctypes.c_void_p, ctypes.c_void_p)
        self._do_step = self._function("fmi2DoStep", ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int)
        self._is_fresh = True

    def log(self, categories: Iterable[str]) -> None:
        """Makes the FMU log these categories, if it has them; "logEvents" describes the simulation."""
        known = {category.name for category in self.fmu.description.logCategories}
        # fmpy's remoting cannot pass this on; libraries behind it only log errors
        with contextlib.suppress(FMICallException):
            self.raw.setDebugLogging(True, [category for category in categories if category in known])

    def _function(self, name, *types):
        # indexing returns a separate ctypes function, whose types are independent of fmpy's
        function = self.raw.dll[name]
        function.argtypes, function.restype = types, ctypes.c_int
        return function

    def _record(self, _environment, _name, status, category, message):
        (self.messages if status >= 1 else self.events).append(message.decode(errors="replace"))
        if status >= DISCARD:
            self._failure = self.messages[-1]

    @property
    def unfelt(self) -> dict[str, str]:
        """Variables whose values have had no effect in this scene so far, by name, with the FMU's reason."""
        found = (message.partition(": ") for message in self.messages if UNFELT in message)
        return {name: why for name, _, why in found}

    @property
    def nobody_set(self) -> str:
        """Values that take effect and that nobody set, by effect, as the FMU lists them at the start. Empty if there are none, or if
        "logEvents" is not logged."""
        lists = (text.removeprefix(NOBODY_SET) for text in (*self.messages, *self.events) if text.startswith(NOBODY_SET))
        return next(lists, "")

    def check(self, status: int, doing: str, kind: str = "use") -> None:
        """Raises `DifferentialError` of this kind with the FMU's message if `status` is an error."""
        if status >= DISCARD:
            if not self._component:
                raise DifferentialError("the instance is closed; open another one", status)
            # an earlier warning is not the reason
            said, self._failure = self._failure, None
            words = _TOO_LATE.sub(_AT_START, without_calls(said or f"it failed with status {status}"))
            raise DifferentialError(words if said and not words.startswith(_ABOUT_CALL) else f"{doing}: {words}", status, kind)

    def _through(self, doing, call, *arguments):
        """Calls a method of `raw`; errors are raised as by `check`."""
        try:
            return call(*arguments)
        except FMICallException as caught:
            failure = caught
        self.check(failure.status, doing)

    def set(self, values: Mapping[str, Value] | None = None, **keywords: Value) -> Self:
        """Sets parameters and inputs, given as to `Differential.set`. If the FMU refuses one of them, none is set."""
        pairs = self.fmu.numbers(values, **keywords)
        # one call for each kind
        kinds = [[pair for pair in pairs if CALLS[pair[0].kind] == call] for call in self._set]
        kinds = [kind for kind in kinds if kind]
        before: list[list[tuple[Variable, Number]]] = []
        for kind in kinds:
            variables = tuple(variable for variable, _ in kind)
            try:
                present = Batches.of(variables).get(self) if len(kinds) > 1 else []
                self._write(kind)
            except DifferentialError as refused:
                for earlier in before:
                    self._write(earlier)
                if len(kinds) == 1:
                    raise
                why = str(refused).partition("; none of the ")[0]
                raise DifferentialError(f"{why}; none of the {len(pairs)} values was set", refused.status) from refused
            before.append(list(zip(variables, present)))
        return self

    def _write(self, pairs):
        Batches.of(tuple(variable for variable, _ in pairs)).set(self, [number for _, number in pairs])

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Makes inputs change linearly in the following steps, until they are set again.

        `slopes`: change of Real inputs per second by name, SI units."""
        variables = [self.fmu.variable(name) for name in slopes]
        self._through("setting slopes of inputs", self.raw.setRealInputDerivatives, [variable.reference for variable in variables],
                      [1] * len(slopes), [rate(variable, slopes[name]) for variable, name in zip(variables, slopes)])

    def get(self, name: str) -> Number:
        """Value of one variable, in SI; for an enumeration, its number."""
        return self.read((name,))[0]

    def read(self, names: Iterable[str]) -> list[Number]:
        """Values of several variables, as a list in their order."""
        return Batches.of(self.fmu.named(names)).get(self)

    def initialise(self, values: Mapping[str, Value] | None = None, stop: TimeValue | None = None) -> Self:
        """Initialises at time 0, with `values` in addition to those that were set; `stop` (s, or text such as "5 ms"): no step
        will go beyond it.

        After a run, the instance is reset first."""
        self.start(self.fmu.numbers(values), None if stop is None else duration("stop", stop))
        return self

    def start(self, values: list[tuple[Variable, Number]], stop: float | None) -> None:
        """Initialises with `values` in the form of the FMU: [(variable, number)]. See `initialise`."""
        if not self._is_fresh:
            self.reset()
        self._is_fresh = False
        self.check(self._setup(self._component, 0, 0.0, 0.0, stop is not None, stop or 0.0), "setting the stop time")
        self._write(values)
        self.check(self._enter(self._component), "beginning the initialisation")
        self.check(self._exit(self._component), "the initialisation")

    def reset(self) -> None:
        """Resets the instance: all variables have their start values, the log is empty."""
        self.check(self._reset(self._component), "the reset")
        self.messages.clear()
        self.events.clear()
        self._is_fresh, self.time = True, 0.0

    def step(self, size: TimeValue) -> None:
        """Advances by a communication step of `size`, s or text such as "1 ms", from `time`."""
        if not isinstance(size, float):
            size = seconds("step", size)
        self.do_step(self.time, size)
        self.time += size

    def do_step(self, time: TimeValue, size: TimeValue) -> None:
        """Advances by a communication step of `size` from a `time` that the caller tracks; both s, or text such as "1 ms"."""
        # floats skip the conversion, because this call is the fastest way to step
        if not (isinstance(time, float) and isinstance(size, float)):
            time, size = seconds("time", time), seconds("step", size)
        status = self._do_step(self._component, time, size, 1)
        if status >= DISCARD:
            self.check(status, f"the step from {time:g} s", "failed")

    def port(self, inputs: Iterable[str], outputs: Iterable[str]) -> Port:
        """Port: the fastest way to exchange values at every step. `port.step(values, size)` sets the inputs, steps and returns the outputs.

        `inputs`: names of Real inputs and tunable parameters; `outputs`: names of Real variables."""
        return Port(self, inputs, outputs)

    def save(self) -> tuple[float, bytes]:
        """State as (time, bytes), for this or another instance of the same FMU, in any process."""
        state = self._through("saving the state", self.raw.getFMUstate)
        try:
            return self.time, self._through("saving the state", self.raw.serializeFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)

    def restore(self, saved: tuple[float, bytes]) -> Self:
        """Restores a state that `save` returned."""
        match saved:
            case (int() | float() as time, bytes() as kept):
                pass
            case _:
                raise DifferentialError("restore: it takes the pair of time and bytes that `save` returned", kind="use")
        state = self._through("restoring a state", self.raw.deSerializeFMUstate, kept)
        try:
            self._through("restoring a state", self.raw.setFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)
        self.time, self._is_fresh = time, False
        return self

    def close(self) -> None:
        """Frees the instance. The library stays loaded, because loading costs more than everything else."""
        if self._component:
            self.raw.fmi2FreeInstance(self.raw.component)
            # later calls have no instance, so the FMU refuses them
            self._component = self.raw.component = None

    def forget(self) -> None:
        """Drops the instance without a call, if its host is gone, such as the server of another system's library."""
        self._component = self.raw.component = None

    def __del__(self) -> None:
        # for instances of a thread that has ended, or that nobody has closed
        if getattr(self, "_component", None):
            self.close()


def without_calls(message: str) -> str:
    """Message of the FMU's log without FMI functions around it, which only hosts use."""
    return _CALLS.sub("", message)
