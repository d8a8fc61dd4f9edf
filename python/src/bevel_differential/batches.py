"""Reads and writes many variables in one call of the FMU."""

import ctypes
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np

from .values import Number, Variable

# function, component, references, count, address of the first row, bytes of a row
Rows: TypeAlias = tuple[Callable[..., int], ctypes.c_void_p | None, ctypes.c_void_p, int, int, int]

# name of each kind of variable in the FMI functions
CALLS = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}


class Batches:
    """Variables in groups of their kinds, so that one call sets or gets a group. Order is kept within a kind.

    Values have the types of the FMU, and only the FMU checks them. An `instance` is an `Instance`."""

    def __init__(self, variables: Sequence[Variable]):
        self.groups: list[tuple[str, list[int], np.ndarray, type[np.float64 | np.int32]]] = []
        for call in ("Real", "Integer", "Boolean"):
            indices = [index for index, variable in enumerate(variables) if CALLS[variable.kind] == call]
            if indices:
                references = np.array([variables[index].reference for index in indices], np.uint32)
                dtype = np.float64 if call == "Real" else np.int32
                self.groups.append((call, indices, references, dtype))
        # some hosts read values at every step, so addresses and buffer types are prepared here
        self._calls = [(call, indices, references.ctypes.data, (ctypes.c_double if call == "Real" else ctypes.c_int32) * len(indices))
                       for call, indices, references, _ in self.groups]
        self._count = len(variables)

    @staticmethod
    @lru_cache(256)
    def of(variables: tuple[Variable, ...]) -> "Batches":
        """Batches of these variables, cached because the designs of a sweep share them."""
        return Batches(variables)

    def set(self, instance: Any, values: Sequence[Number]) -> None:
        """Sets all variables."""
        for call, indices, references, dtype in self.groups:
            numbers: np.ndarray = np.array([values[index] for index in indices], dtype)
            status = instance._set[call](instance._component, references.ctypes.data, len(indices), numbers.ctypes.data)
            instance.check(status, f"setting {call} variables")

    def get(self, instance: Any) -> list[Number]:
        """Returns the values of all variables, in their order."""
        values: list[Number] = [0.0] * self._count
        for call, indices, references, buffer in self._calls:
            # a separate buffer for each call, as threads share the batches
            numbers = buffer()
            status = instance._get[call](instance._component, references, len(indices), numbers)
            instance.check(status, f"getting {call} variables")
            for index, number in zip(indices, numbers):
                values[index] = number != 0 if call == "Boolean" else number
        return values

    def record(self, rows: int) -> list[np.ndarray]:
        """Arrays for `rows` rows of all groups, each of shape (rows, variables of a kind)."""
        return [np.empty((rows, len(indices)), dtype) for _, indices, _, dtype in self.groups]

    def blocks(self, columns: Sequence[np.ndarray]) -> list[np.ndarray]:
        """Values over time of all groups, in the form of `record`. `columns`: one for each variable, in their order."""
        return [np.ascontiguousarray(np.column_stack([columns[index] for index in indices]), dtype)
                for _, indices, _, dtype in self.groups]

    def readers(self, instance: Any, record: Sequence[np.ndarray]) -> list[Rows]:
        """Functions that read each group, with their arguments: (function, component, references, count, address of the first row,
        bytes of a row). The last argument of a call is the address of a row. `record` must outlive them."""
        return self._rows(instance, instance._get, record)

    def writers(self, instance: Any, blocks: Sequence[np.ndarray]) -> list[Rows]:
        """Functions that set each group, in the form of `readers`."""
        return self._rows(instance, instance._set, blocks)

    def slope_writers(self, instance: Any, blocks: Sequence[np.ndarray]) -> list[Rows]:
        """Functions that set the slopes of inputs, per second, in the form of `readers`. All inputs are Real."""
        set_rates, orders = instance._set_rates, np.ones(sum(block.shape[1] for block in blocks), np.int32)

        def write(component, references, count, address):
            return set_rates(component, references, count, orders.ctypes.data, address)

        return self._rows(instance, {"Real": write}, blocks)

    def _rows(self, instance, calls, blocks):
        return [(calls[call], instance._component, ctypes.c_void_p(references.ctypes.data), len(indices),
                 block.ctypes.data, block.strides[0])
                for (call, indices, references, _), block in zip(self.groups, blocks)]
