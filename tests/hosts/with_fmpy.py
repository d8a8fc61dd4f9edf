"""FMPy, a Python host that imports the FMU with ctypes, used with individual FMI calls. It is the reference for the other hosts."""

import shutil
from importlib.metadata import version

import common


def load():
    import fmpy.fmi2
    import fmpy.fmi3  # noqa: F401

    return version("FMPy")


def run(fmu, scene):
    """{communication point: values}"""
    return stepped(fmu, scene, common.variables(fmu), scene.outputs)


def stepped(fmu, scene, known, outputs):
    import fmpy

    folder = fmpy.extract(fmu)
    guid, identifier = common.description(fmu)
    use = three if common.is_three(fmu) else two
    slave, write, read = use(scene, known, {"guid": guid, "unzipDirectory": folder, "modelIdentifier": identifier,
                                            "instanceName": "differential"})
    references = [known[name].reference for name in outputs]
    rows = common.stepped(scene, lambda name, value: write([known[name].reference], [value]),
                          lambda k: slave.doStep(k * scene.step, scene.step), lambda: read(references))
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)
    return rows


def two(scene, known, options):
    """An initialised slave of FMI 2.0, and the functions that set and read its real variables."""
    from fmpy.fmi2 import FMU2Slave

    slave = FMU2Slave(**options)
    begun(slave, scene, known)
    return slave, slave.setReal, slave.getReal


def begun(instance, scene, known):
    """Initialises an instance of FMI 2.0."""
    instance.instantiate()
    for variable, value in scene.start(known):
        kind = "Integer" if variable.kind == "Enumeration" else variable.kind
        getattr(instance, "set" + kind)([variable.reference], [value])
    instance.setupExperiment(startTime=0.0, stopTime=scene.stop)
    instance.enterInitializationMode()
    instance.exitInitializationMode()


def three(scene, known, options):
    """An initialised slave of FMI 3.0, and the functions that set and read its real variables. Structural parameters are set in
    configuration mode."""
    from fmpy.fmi3 import FMU3Slave

    slave = FMU3Slave(**options)
    slave.instantiate()

    def write(structural):
        for variable, value in scene.start(known):
            kind = "Int64" if variable.kind == "Enumeration" else variable.kind
            if variable.structural == structural:
                getattr(slave, "set" + kind)([variable.reference], [value])

    slave.enterConfigurationMode()
    write(structural=True)
    slave.exitConfigurationMode()
    write(structural=False)
    slave.enterInitializationMode(startTime=0.0, stopTime=scene.stop)
    slave.exitInitializationMode()
    return slave, slave.setFloat64, slave.getFloat64


if __name__ == "__main__":
    common.main(load, run)
