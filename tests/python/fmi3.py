"""Unit of FMI 3.0, driven by single calls of fmpy, with names instead of value references."""

import atexit
import shutil
from ctypes import POINTER, c_bool, c_double, c_int32, c_int64, c_uint, c_uint64
from functools import cache

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Model, FMU3Slave

KINDS = {"Float64": c_double, "Int32": c_int32, "Enumeration": c_int64, "UInt64": c_uint64, "Boolean": c_bool}
CALLS = {"Float64": "Float64", "Int32": "Int32", "Enumeration": "Int64", "UInt64": "UInt64", "Boolean": "Boolean"}


@cache
def extracted(file):
    """Folder and model description of an archive. An archive is extracted once per process; its folder is removed at exit."""
    folder = extract(file)
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder, read_model_description(folder)


class Unit3:
    """One instance. `variables`: by name. Values are SI, numbers of literals, or bool."""

    def __init__(self, file, kind="CoSimulation", **options):
        self.folder, self.description = extracted(str(file))
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.messages = []
        make = {"CoSimulation": FMU3Slave, "ModelExchange": FMU3Model}[kind]
        element = self.description.coSimulation if kind == "CoSimulation" else self.description.modelExchange
        self.raw = make(guid=self.description.guid, unzipDirectory=self.folder, instanceName="three",
                        modelIdentifier=element.modelIdentifier)
        self.raw.instantiate(logMessage=self._log, **options)
        self.has_events = options.get("eventModeUsed", False)

    def _log(self, _environment, status, _category, message):
        self.messages.append((status, message.decode()))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.raw.freeInstance()

    def set(self, values):
        for name, value in values.items():
            variable = self.variables[name]
            kind = KINDS[variable.type]
            references, numbers = (c_uint * 1)(variable.valueReference), (kind * 1)(value)
            getattr(self.raw, f"fmi3Set{CALLS[variable.type]}")(self.raw.component, references, 1, numbers, 1)

    def read(self, names):
        """Values of variables in their order; values of arrays are lists."""
        return [self._get(self.variables[name]) for name in names]

    def _get(self, variable):
        size = int(np.prod([self._extent(dimension) for dimension in variable.dimensions or []]))
        numbers = (KINDS[variable.type] * size)()
        getattr(self.raw, f"fmi3Get{CALLS[variable.type]}")(self.raw.component, (c_uint * 1)(variable.valueReference), 1,
                                                             numbers, size)
        return list(numbers) if variable.dimensions else numbers[0]

    def _extent(self, dimension):
        return dimension.start if dimension.start is not None else self._get(dimension.variable)

    def reals(self, names):
        """Values of scalar Float64 variables, read in one call, as an array."""
        references = (c_uint * len(names))(*(self.variables[name].valueReference for name in names))
        values = np.empty(len(names))
        self.raw.fmi3GetFloat64(self.raw.component, references, len(names),
                                values.ctypes.data_as(POINTER(c_double)), len(names))
        return values

    def initialise(self, values, stop=None, start=0.0, tolerance=None):
        count = values.get("geometry.planet_count")
        if count is not None:
            self.raw.fmi3EnterConfigurationMode(self.raw.component)
            self.set({"geometry.planet_count": int(count)})
            self.raw.fmi3ExitConfigurationMode(self.raw.component)
        self.set({name: value for name, value in values.items() if name != "geometry.planet_count"})
        self.raw.enterInitializationMode(startTime=start, stopTime=stop, tolerance=tolerance)
        self.raw.exitInitializationMode()

    def begin(self, *scene, **options):
        """Initialises, and leaves event mode if the unit is in it."""
        self.initialise(*scene, **options)
        if self.has_events:
            self.update()
            self.raw.enterStepMode()

    def save(self):
        """State as bytes, for this or another instance."""
        return self.raw.serializeFMUState(self.raw.getFMUState())

    def restore(self, saved):
        self.raw.setFMUState(self.raw.deserializeFMUState(saved))

    def step(self, time, size):
        """Advances by `size`; returns (event handling needed, terminate, early return, last successful time)."""
        return self.raw.doStep(time, size)

    def event(self):
        """Last published event: kind, place, time and number."""
        return tuple(self.read(["event.kind", "event.place", "event.time", "event.count"]))

    def update(self):
        """Iterates in event mode. Returns the reported events, none if nothing has happened."""
        reported, more = [], True
        while more:
            more = self.raw.updateDiscreteStates()[0]
            reported.append(self.event())
        return [event for event in reported if event[-1] > 0]

    def handle_event(self, values=None):
        """Sets `values` in event mode, iterates and returns to step mode. Returns the reported events."""
        self.raw.enterEventMode()
        self.set(values or {})
        reported = self.update()
        self.raw.enterStepMode()
        return reported

    def sensitivity(self, unknowns, knowns, seed, adjoint=False):
        """Directional derivative, or adjoint derivative."""
        u, k = ((c_uint * len(names))(*(self.variables[name].valueReference for name in names)) for names in (unknowns, knowns))
        seeds, found = (c_double * len(seed))(*seed), (c_double * len(knowns if adjoint else unknowns))()
        call = self.raw.fmi3GetAdjointDerivative if adjoint else self.raw.fmi3GetDirectionalDerivative
        call(self.raw.component, u, len(unknowns), k, len(knowns), seeds, len(seed), found, len(found))
        return np.array(found)
