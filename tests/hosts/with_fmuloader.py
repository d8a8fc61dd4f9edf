"""fmuloader: the C functions by ctypes, nothing else. It reads no model description; common.py does."""

from importlib.metadata import version

import common


def load():
    import fmuloader  # noqa: F401 - fails here where it is missing

    return version("fmuloader")


def run(fmu, scene):
    """{communication point: values}"""
    known = common.variables(fmu)
    slave, write, read = (three if common.is_three(fmu) else two)(fmu, scene, known)
    references = [known[name].reference for name in scene.outputs]
    rows = common.stepped(scene, lambda name, value: write([known[name].reference], [value]),
                          lambda k: slave.do_step(k * scene.step, scene.step), lambda: read(references))
    slave.terminate()
    slave.free_instance()
    return rows


def two(fmu, scene, known):
    """An initialised slave of FMI 2.0, and what sets and reads its real numbers."""
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

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
    return slave, slave.set_real, slave.get_real


def three(fmu, scene, known):
    """The same of FMI 3.0, whose structural parameters are set in configuration mode."""
    from fmuloader.fmi3 import Fmi3Slave

    guid, identifier = common.description(fmu)
    slave = Fmi3Slave(fmu, model_identifier=identifier)
    slave.instantiate_co_simulation("differential", instantiation_token=guid)
    setters = {"Float64": slave.set_float64, "Int32": slave.set_int32, "UInt64": slave.set_uint64, "Boolean": slave.set_boolean,
               "Enumeration": slave.set_int64}

    def write(structural):
        for variable, value in scene.start(known):
            if variable.structural == structural:
                setters[variable.kind]([variable.reference], [value])

    slave.enter_configuration_mode()
    write(structural=True)
    slave.exit_configuration_mode()
    write(structural=False)
    slave.enter_initialization_mode(start_time=0.0, stop_time=scene.stop)
    slave.exit_initialization_mode()
    return slave, slave.set_float64, slave.get_float64


if __name__ == "__main__":
    common.main(load, run)
