"""libcosim, the engine of the Open Simulation Platform, a host in C++ with FMI Library, used through libcosimpy.

libcosim does not support enumerations and ignores their variables. Values before initialisation are set as initial values.
Inputs are set with the override manipulator, which acts at the start of the next step. libcosim initialises within the first
step, so nothing can be read at the start. Time is an integer number of nanoseconds.
"""

from importlib.metadata import version

import common

NANOSECOND = 1e-9


def load():
    import libcosimpy.CosimExecution  # noqa: F401
    from libcosimpy._internal import libcosimc

    libcosimc()
    return version("libcosimpy")


def run(fmu, scene):
    """{communication point: values}"""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_step_size(round(scene.step / NANOSECOND))
    local = CosimLocalSlave(fmu, "differential")
    slave = execution.add_local_slave(local)
    seen = {variable.name.decode(): variable.reference for variable in execution.slave_variables(slave)}
    setters = {"Real": execution.real_initial_value, "Integer": execution.integer_initial_value,
               "Boolean": execution.boolean_initial_value}
    for variable, value in scene.start(common.variables(fmu)):
        if not setters[variable.kind](slave, seen[variable.name], value):
            raise SystemExit(f"libcosim does not set {variable.name}")
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    references = [seen[name] for name in scene.outputs]

    def step(k):
        if not execution.step():
            raise SystemExit(f"libcosim does not complete the step from {k * scene.step} s")

    return common.stepped(scene, lambda name, value: manipulator.slave_real_values(slave, [seen[name]], [value]), step,
                          lambda: list(observer.last_real_values(slave, references)), at_start=False)


if __name__ == "__main__":
    common.main(load, run)
