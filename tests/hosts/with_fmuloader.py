"""fmuloader: the C functions by ctypes, nothing else. It reads no model description; common.py does.

It asks every FMU for the functions of model exchange too. One that has none, as FMI allows, gives it stand-ins here that
nobody calls.
"""

import ctypes
from importlib.metadata import version

import common


class Lenient(ctypes.CDLL):
    """A library whose missing functions are missed when called, not before."""

    def __getattr__(self, name):
        try:
            return super().__getattr__(name)
        except AttributeError:
            if not name.startswith("fmi2"):
                raise
            return ctypes.CFUNCTYPE(ctypes.c_int)(lambda *_: 3)


def load():
    import fmuloader.fmi2

    fmuloader.fmi2.CDLL = Lenient
    return version("fmuloader")


def run(fmu, scene):
    """{communication point: values}"""
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

    known = common.variables(fmu)
    guid, identifier = common.description(fmu)
    slave = Fmi2Slave(fmu, model_identifier=identifier)
    # the FMU declares that it does without the host's memory
    slave.instantiate("differential", Fmi2Type.CO_SIMULATION, guid=guid, cannot_use_memory_management_functions=True)
    setters = {"Real": slave.set_real, "Integer": slave.set_integer, "Boolean": slave.set_boolean,
               "Enumeration": slave.set_integer}
    for variable, value in scene.start(known):
        setters[variable.kind]([variable.reference], [value])
    slave.setup_experiment(start_time=0.0, stop_time=scene.stop)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    references = [known[name].reference for name in scene.outputs]
    rows = {0: slave.get_real(references)}
    for k in range(scene.steps):
        for name, value in scene.changes(k).items():
            slave.set_real([known[name].reference], [value])
        slave.do_step(k * scene.step, scene.step)
        rows[k + 1] = slave.get_real(references)
    slave.terminate()
    slave.free_instance()
    return rows


if __name__ == "__main__":
    common.main(load, run)
