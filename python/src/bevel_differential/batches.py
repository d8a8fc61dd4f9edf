"""Many variables in one call of the FMU."""

import ctypes
from functools import lru_cache

import numpy as np

# what the functions for each kind of variable are called
CALLS = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}


class Batches:
    """Variables in groups of their kinds, so that one call sets or gets a group. Order is kept within a kind.

    Values are as the FMU takes them, and nothing but the FMU checks them."""

    def __init__(self, variables):
        self.groups = []
        for call in ("Real", "Integer", "Boolean"):
            places = [place for place, variable in enumerate(variables) if CALLS[variable.kind] == call]
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
