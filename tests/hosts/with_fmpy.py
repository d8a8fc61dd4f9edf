"""FMPy, call by call: the others are compared with this one. Python, its own import by ctypes."""

import shutil
from importlib.metadata import version

import common


def load():
    import fmpy.fmi2  # noqa: F401

    return version("FMPy")


def run(fmu, scene):
    """{communication point: values}"""
    return stepped(fmu, scene, common.variables(fmu), scene.outputs)


def stepped(fmu, scene, known, outputs):
    import fmpy
    from fmpy.fmi2 import FMU2Slave

    folder = fmpy.extract(fmu)
    guid, identifier = common.description(fmu)
    slave = FMU2Slave(guid=guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="differential")
    slave.instantiate()
    for variable, value in scene.start(known):
        kind = "Integer" if variable.kind == "Enumeration" else variable.kind
        getattr(slave, "set" + kind)([variable.reference], [value])
    slave.setupExperiment(startTime=0.0, stopTime=scene.stop)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    references = [known[name].reference for name in outputs]
    rows = common.stepped(scene, lambda name, value: slave.setReal([known[name].reference], [value]),
                          lambda k: slave.doStep(k * scene.step, scene.step), lambda: slave.getReal(references))
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)
    return rows


if __name__ == "__main__":
    common.main(load, run)
