"""An instance of the FMU. fmpy loads and instantiates; what is called in every step is called without its wrappers."""

import contextlib
import ctypes
import re
from collections.abc import Iterable, Mapping
from typing import Any, Self

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from . import machine
from .batches import CALLS, Batches
from .port import Port
from .values import DISCARD, DifferentialError, Number, Value, Variable

# what the log is to have
LOGGED = ["logStatusWarning", "logStatusDiscard", "logStatusError"]
# what warnings about values say that the scene cannot feel
UNFELT = " changes nothing in this scene: "
# beginning of the line that lists values which act and which nobody set
NOBODY_SET = "values of the study that nobody set act in this scene: "
# what a log for hosts has around the words of an error: the call that failed before it, and calls that help after it
_CALLS = re.compile(r"^fmi[23]\w+: (?:initialisation failed:\s*)?|; continue with fmi[23]\w+ or fmi[23]\w+$")
# beginnings of refusals that are about the call, not about a value
_ABOUT_CALL = ("not legal in", "this call")
# fmpy's class and the element of the model description for each kind of instance
KINDS = {"CoSimulation": (FMU2Slave, "coSimulation"), "ModelExchange": (FMU2Model, "modelExchange")}


class Closing:
    """What is freed by `close`, or at the end of a `with` statement."""

    def close(self) -> None:
        """Frees it."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Instance(Closing):
    """One instance of the FMU, driven call by call; `Fmu.open` makes it. It must be used by one thread at a time.

    Values are written as in `Differential` and read in SI. What the FMU refuses is a `DifferentialError` with the FMU's message
    and status.

    Attributes: `fmu`, its `Fmu`; `messages`, the warnings and errors that the FMU has logged since it was made or reset; `events`, what else
    it has logged; `time` (s), to which `step` has come; `raw`, fmpy's object, for FMI functions that have no method here."""

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
        # kept: the library calls them as long as the instance lives
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = fmi2CallbackLoggerTYPE(self._record)
        self._callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self._callbacks.freeMemory = defaultCallbacks.freeMemory
        self.raw.instantiate(callbacks=self._callbacks, loggingOn=False)
        # only what goes wrong: a quiet log
        self.log(LOGGED)
        self._component: ctypes.c_void_p | None = ctypes.c_void_p(self.raw.component)
        pointers = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
        self._get, self._set = ({call: self._function(f"fmi2{verb}{call}", *pointers)
                                 for call in ("Real", "Integer", "Boolean")} for verb in ("Get", "Set"))
        self._setup = self._function("fmi2SetupExperiment", ctypes.c_void_p, ctypes.c_int, ctypes.c_double, ctypes.c_double,
                                     ctypes.c_int, ctypes.c_double)
        self._enter, self._exit, self._reset = (self._function(f"fmi2{name}", ctypes.c_void_p) for name in
                                                ("EnterInitializationMode", "ExitInitializationMode", "Reset"))
        self._do_step = self._function("fmi2DoStep", ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int)
        self._is_fresh = True

    def log(self, categories: Iterable[str]) -> None:
        """Lets the FMU log these categories, as far as it has them; "logEvents" is what it simulates."""
        known = {category.name for category in self.fmu.description.logCategories}
        # a library behind fmpy's remoting cannot be told, and logs errors alone
        with contextlib.suppress(FMICallException):
            self.raw.setDebugLogging(True, [category for category in categories if category in known])

    def _function(self, name, *types):
        # by index ctypes gives a function of its own, whose types are not those of fmpy
        function = self.raw.dll[name]
        function.argtypes, function.restype = types, ctypes.c_int
        return function

    def _record(self, _environment, _name, status, category, message):
        (self.messages if status >= 1 else self.events).append(message.decode(errors="replace"))
        if status >= DISCARD:
            self._failure = self.messages[-1]

    @property
    def unfelt(self) -> dict[str, str]:
        """Variables whose values change nothing in this scene, as the FMU has found so far; by name, with the FMU's words."""
        found = (message.partition(": ") for message in self.messages if UNFELT in message)
        return {name: why for name, _, why in found}

    @property
    def nobody_set(self) -> str:
        """The values that act and that nobody set, by effect, as the FMU lists them at the start; empty if there are none, or if what is
        simulated ("logEvents") is not logged."""
        lists = (text.removeprefix(NOBODY_SET) for text in (*self.messages, *self.events) if text.startswith(NOBODY_SET))
        return next(lists, "")

    def check(self, status: int, doing: str, kind: str = "use") -> None:
        """Raises the FMU's message if `status` is an error, of this kind of `DifferentialError`."""
        if status >= DISCARD:
            if not self._component:
                raise DifferentialError("the instance is closed; open another one", status)
            # a warning from before is no reason
            said, self._failure = self._failure, None
            words = without_calls(said or f"it failed with status {status}")
            raise DifferentialError(words if said and not words.startswith(_ABOUT_CALL) else f"{doing}: {words}", status, kind)

    def _through(self, doing, call, *arguments):
        """Calls a method of `raw`; its error becomes that of `check`."""
        try:
            return call(*arguments)
        except FMICallException as caught:
            failure = caught
        self.check(failure.status, doing)

    def set(self, values: Mapping[str, Value] | None = None, **keywords: Value) -> Self:
        """Sets parameters and inputs, given as to `Differential.set`: all of them, or none if the FMU refuses one."""
        pairs = self.fmu.numbers(values, **keywords)
        # each kind has a call of its own
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
        """Lets inputs change linearly in the steps to come, until they are set again.

        `slopes`: by name the change of a Real input in a second, SI units."""
        references = [self.fmu.variable(name).reference for name in slopes]
        self._through("setting slopes of inputs", self.raw.setRealInputDerivatives, references, [1] * len(slopes), list(slopes.values()))

    def derivatives_setter(self) -> Any:
        """The function of the FMU that sets derivatives of inputs, without wrappers."""
        return self._function("fmi2SetRealInputDerivatives", ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p,
                              ctypes.c_void_p)

    def get(self, name: str) -> Number:
        """The value of one variable, in SI; of an enumeration its number."""
        return self.read((name,))[0]

    def read(self, names: Iterable[str]) -> list[Number]:
        """The values of several variables, as a list in their order."""
        return Batches.of(self.fmu.named(names)).get(self)

    def initialise(self, values: Mapping[str, Value] | None = None, stop: float | None = None) -> Self:
        """Initialises at time 0, with `values` beside those that were set; `stop` (s): no step will go beyond it.

        After a run the instance is reset first."""
        self.start(self.fmu.numbers(values), stop)
        return self

    def start(self, values: list[tuple[Variable, Number]], stop: float | None) -> None:
        """The same with `values` as the FMU takes them: [(variable, number)]."""
        if not self._is_fresh:
            self.reset()
        self._is_fresh = False
        self.check(self._setup(self._component, 0, 0.0, 0.0, stop is not None, stop or 0.0), "setting the stop time")
        self._write(values)
        self.check(self._enter(self._component), "beginning the initialisation")
        self.check(self._exit(self._component), "the initialisation")

    def reset(self) -> None:
        """As new: all variables have their start values, nothing is logged."""
        self.check(self._reset(self._component), "the reset")
        self.messages.clear()
        self.events.clear()
        self._is_fresh, self.time = True, 0.0

    def step(self, size: float) -> None:
        """A communication step from `time` on, s."""
        self.do_step(self.time, size)
        self.time += size

    def do_step(self, time: float, size: float) -> None:
        """A communication step from a time that the caller keeps, s."""
        status = self._do_step(self._component, time, size, 1)
        if status >= DISCARD:
            self.check(status, f"the step from {time:g} s", "failed")

    def port(self, inputs: Iterable[str], outputs: Iterable[str]) -> Port:
        """The fastest way to exchange values at every step: `port.step(values, size)` sets the inputs, steps and returns the outputs.

        `inputs`: names of Real inputs and tunable parameters; `outputs`: names of Real variables."""
        return Port(self, inputs, outputs)

    def save(self) -> tuple[float, bytes]:
        """The state as (time, bytes), for this or another instance of the same FMU, in any process."""
        state = self._through("saving the state", self.raw.getFMUstate)
        try:
            return self.time, self._through("saving the state", self.raw.serializeFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)

    def restore(self, saved: tuple[float, bytes]) -> Self:
        """Goes back to what `save` gave."""
        time, kept = saved
        state = self._through("restoring a state", self.raw.deSerializeFMUstate, kept)
        try:
            self._through("restoring a state", self.raw.setFMUstate, state)
        finally:
            self.raw.freeFMUstate(state)
        self.time, self._is_fresh = time, False
        return self

    def close(self) -> None:
        """Frees the instance. The library stays loaded: loading costs more than all else."""
        if self._component:
            self.raw.fmi2FreeInstance(self.raw.component)
            # what is called after this gets no instance, and is refused
            self._component = self.raw.component = None

    def forget(self) -> None:
        """Lets go of the instance without a call, where what held it is gone, such as the server of another system's library."""
        self._component = self.raw.component = None

    def __del__(self) -> None:
        # of a thread that has ended, or where nobody has closed it
        if getattr(self, "_component", None):
            self.close()


def without_calls(message: str) -> str:
    """An error of the FMU's log without the names of FMI functions around it, which only hosts use."""
    return _CALLS.sub("", message)
