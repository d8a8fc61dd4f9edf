"""Runs the SSP archives in hosts written by others, which step all parts at the same time with held inputs."""

import zipfile

import numpy as np
from fmpy import read_model_description
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import ParameterSet, read_ssd

import content

NANO = 1_000_000_000


def fmpy(ssp, signals, size, times):
    """Outputs at `times` from FMPy's SSP simulator. It needs one set of parameters for the whole system."""
    parameters, truth = [], {"true": 1.0, "false": 0.0}
    for component in read_ssd(ssp).system.elements:
        for binding in component.parameterBindings:
            for values in binding.parameterValues:
                for parameter in values.parameters:
                    parameter.name = f"{component.name}.{parameter.name}"
                    # FMPy compares Booleans with 0
                    parameter.value = truth.get(parameter.value, parameter.value)
                    parameters.append(parameter)
    rows = simulate_ssp(str(ssp), stop_time=times[-1], step_size=size, parameter_set=ParameterSet(parameters=parameters))
    # a row has the time at which its step began
    at = [round(time / size) - 1 for time in times]
    return np.array([[rows[f"{part}.{output}"][k] for part, output in signals] for k in at])


def libcosim(ssp, signals, size, times):
    """Outputs at `times` from libcosim, the Open Simulation Platform."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_ssp_file(str(ssp), round(size * NANO))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    index = {part.name.decode(): part.index for part in execution.slave_infos()}
    places = [(index[part], reference(ssp, part, output)) for part, output in signals]
    rows = []
    for time in times:
        if not execution.simulate_until(round(time * NANO)):
            raise RuntimeError(f"libcosim does not reach {time} s")
        rows.append([observer.last_real_values(part, [output])[0] for part, output in places])
    return np.array(rows)


def reference(ssp, part, output):
    """Value reference of a part's output."""
    _, source, _ = content.read(ssp)["components"][part]
    with zipfile.ZipFile(ssp) as archive, archive.open(source) as fmu:
        variables = read_model_description(fmu).modelVariables
    return next(variable.valueReference for variable in variables if variable.name == output)


# hosts by label, each with the version of its archive. FMPy 0.3.32 refuses SSP 2.0
HOSTS = {"FMPy": (fmpy, "1.0"), "libcosim": (libcosim, "1.0"), "libcosim, SSP 2.0": (libcosim, "2.0")}
