"""DaeBuilder of CasADi, a host in C++ with its own FMI import for model exchange of FMI 2.0. It evaluates derivatives and their Jacobian.

DaeBuilder sets states and inputs as variables in one call and computes the Jacobian from directional derivatives. It would set tunable
parameters (its inputs `p`) between events, which the FMU refuses. The script therefore sets all parameters in advance.
"""

import tempfile
import zipfile
from importlib.metadata import version

import common
import derivatives


def load():
    import casadi  # noqa: F401 - fails here if it is missing

    return version("casadi")


def run(fmu, scene):
    """{point: values}"""
    import casadi

    equations = derivatives.Equations(fmu)
    scene.outputs = equations.columns()
    with derivatives.started(fmu, scene) as (_, start):
        points = list(equations.points(start, scene))
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(fmu) as archive:
            archive.extractall(folder)
        builder = casadi.DaeBuilder("differential", folder)
        for variable, value in scene.start(common.variables(fmu)):
            builder.set(variable.name, float(value))
        evaluate = builder.create("evaluate", ["x", "u"], ["ode", "jac_ode_x", "jac_ode_u"])
        states, inputs, values = builder.x(), builder.u(), dict(zip(builder.u(), builder.start(builder.u())))
        for k, point in enumerate(points):
            values |= point.inputs
            found = evaluate([point.states[name] for name in states], [values[name] for name in inputs])
            rates, by_states, by_inputs = (block.full() for block in found)
            slopes = {(state, name): block[i, j] for names, block in ((states, by_states), (inputs, by_inputs))
                      for i, state in enumerate(states) for j, name in enumerate(names)}
            rows[k] = equations.row(dict(zip(states, rates[:, 0])), slopes)
    return rows


if __name__ == "__main__":
    common.main(load, run)
