"""Exchange of values between a coupled script and an instance: inputs, one step, outputs."""

import ctypes
from array import array
from collections.abc import Callable, Iterable, Sequence
from math import isfinite
from typing import Any, TypeAlias

import numpy as np

from .batches import Batches
from .inputs import changing_variable
from .points import TimeValue
from .values import DISCARD, DifferentialError, Number, Value, Variable

# one value for each input; a single input also accepts its value without a list
Given: TypeAlias = Value | Sequence[Value] | np.ndarray


class Port:
    """Inputs and outputs that a coupled script exchanges at every communication point; `Instance.port` creates it.

    Names are resolved once and buffers are reused. Results and errors are the same as with `set`, `set_slopes`, `step` and `read`. A
    port stays valid after `initialise`, `reset` and `restore`."""

    def __init__(self, instance: Any, inputs: Iterable[str], outputs: Iterable[str]):
        driven, shown = instance.fmu.named(inputs), instance.fmu.named(outputs)
        for variable in driven:
            instance.fmu.settable(variable.name)
            changing_variable(instance.fmu, variable.name)
            if driven.count(variable) > 1:
                raise DifferentialError(f"{variable.name}: it is given twice; name each input once")
            if variable.kind != "Real":
                raise DifferentialError(f"{variable.name}: it is of the kind {variable.kind}, and a port sets Real variables; use `set`")
        self._instance, self._inputs = instance, driven
        # outputs of other kinds have other functions: their indices, and how they are read
        self._indices = [index for index, variable in enumerate(shown) if variable.kind != "Real"]
        self._others = Batches.of(tuple(shown[index] for index in self._indices))
        shown = [variable for variable in shown if variable.kind == "Real"]
        self._get, self._set, self._set_rates = instance._get["Real"], instance._set["Real"], instance._set_rates
        self._values, self._rates, self._outputs = (array("d", [0.0] * len(each)) for each in (driven, driven, shown))
        # arguments of the three functions after the component; the arrays behind the addresses live as long as the port
        self._buffers = [array("I", [variable.reference for variable in each]) for each in (driven, shown)]
        self._buffers.append(array("i", [1] * len(driven)))
        inputs_at, outputs_at, orders_at = map(_address, self._buffers)
        self._setting = inputs_at, len(driven), _address(self._values)
        self._sloping = inputs_at, len(driven), orders_at, _address(self._rates)
        self._getting = outputs_at, len(shown), _address(self._outputs)

    def step(self, values: Given, size: TimeValue, rates: Given | None = None) -> list[Number]:
        """Sets the inputs, takes a step of `size` (s, or text such as "1 ms") from the time of the instance, and returns the outputs in SI, as a new list.

        `values`: one for each input, in their order, written as in `set`; a single input also accepts its value without a list. `rates`:
        change of each input per second during this step, SI units; without rates, inputs are held."""
        self._write(values, rates)
        self._instance.step(size)
        return self.read()

    def do_step(self, values: Given, time: TimeValue, size: TimeValue, rates: Given | None = None) -> list[Number]:
        """Exchanges values as `step` does, but from a time, s, that the caller tracks."""
        self._write(values, rates)
        self._instance.do_step(time, size)
        return self.read()

    def read(self) -> list[Number]:
        """Present values of the outputs, as a new list."""
        instance = self._instance
        status = self._get(instance._component, *self._getting)
        if status >= DISCARD:
            instance.check(status, "getting Real variables")
        values: list[Number] = self._outputs.tolist()
        if self._indices:
            for index, value in zip(self._indices, self._others.get(instance)):
                values.insert(index, value)
        return values

    def _write(self, values, rates):
        self._fill(self._values, values, "values", Variable.checked)
        if rates is not None:
            self._fill(self._rates, rates, "rates", rate)
        instance = self._instance
        status = self._set(instance._component, *self._setting)
        if status >= DISCARD:
            instance.check(status, "setting Real variables")
        if rates is not None:
            status = self._set_rates(instance._component, *self._sloping)
            if status >= DISCARD:
                instance.check(status, "setting slopes of inputs")

    def _fill(self, buffer: array, given: Any, what: str, number: Callable[[Variable, Any], Any]) -> None:
        """Writes numbers into a buffer. `number` converts or refuses each item that is not a finite float."""
        if not isinstance(given, (list, tuple)):
            # arrays become lists, and single values remain
            given = given if isinstance(given, float) else np.asarray(given).tolist()
            given = given if isinstance(given, list) else (given,)
        if len(given) != len(buffer):
            names = ", ".join(variable.name for variable in self._inputs) or "a port without inputs"
            raise DifferentialError(f"{names}: there are {len(given)} {what} for {len(buffer)} inputs; give one for "
                                    "each input, in this order")
        for index, item in enumerate(given):
            buffer[index] = item if isinstance(item, float) and isfinite(item) else number(self._inputs[index], item)


def _address(buffer):
    return ctypes.c_void_p(buffer.buffer_info()[0])


def rate(variable: Variable, given: Any) -> float:
    """Change of an input per second, SI. Refuses everything but a finite number."""
    try:
        number = float(given)
    except (TypeError, ValueError):
        number = float("nan")
    if isinstance(given, (bool, np.bool_)) or not isfinite(number):
        raise DifferentialError(f"{variable.name}: its rate is {given!r}, which is not a finite number")
    return number
