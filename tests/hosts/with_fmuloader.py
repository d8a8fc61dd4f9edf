"""fmuloader: the C functions by ctypes, nothing else. It reads no model description; common.py does."""

from importlib.metadata import version

import common


def load():
    import fmuloader  # noqa: F401 - fails here where it is missing

    return version("fmuloader")


def run(fmu, scene):
    """{communication point: values}"""
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

    known = common.variables(fmu)
    guid, identifier = common.description(fmu)
    slave = Fmi2Slave(fmu, model_identifier=identifier)
    # the FMU declares that it does not use the host's memory functions
    slave.instantiate("differential", Fmi2Type.CO_SIMULATION, guid=guid, cannot_use_memory_management_functions=True)
    setters = {"Real": slave.set_real, "Integer": slave.set_integer, "Boolean": slave.set_boolean,
               "Enumeration": slave.set_integer}
    for variable, value in scene.start(known):
        setters[variable.kind]([variable.reference], [value])
    slave.setup_experiment(start_time=0.0, stop_time=scene.stop)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    references = [known[name].reference for name in scene.outputs]
    rows = common.stepped(scene, lambda name, value: slave.set_real([known[name].reference], [value]),
                          lambda k: slave.do_step(k * scene.step, scene.step), lambda: slave.get_real(references))
    slave.terminate()
    slave.free_instance()
    return rows


if __name__ == "__main__":
    common.main(load, run)
