"""Base class of the parts of the drivetrain that pythonfmu builds.

A part holds its inputs over a communication step. If the input `der(NAME)` has a slope [unit/s], the part follows a line
instead. This input replaces fmi2SetRealInputDerivatives, which pythonfmu does not offer. A part integrates with steps so
short that its own error is negligible compared with that of the coupling. Its state can be saved and restored.
"""

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

# longest step of the part's own integration, classical Runge-Kutta of order 4 [s]
LONGEST = 5e-5


class Part(Fmi2Slave):
    license = "MIT OR Apache-2.0"
    inputs = ()
    outputs = ()
    parameters = {}
    states = ()

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.x = [0.0] * len(self.states)
        self.u = [0.0] * len(self.inputs)
        self.slope = [0.0] * len(self.inputs)
        for name, (value, description) in self.parameters.items():
            setattr(self, name, value)
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable,
                                        description=description))
        for i, (name, description) in enumerate(self.inputs):
            self.register_input(name, self.u, i, description)
            self.register_input(f"der({name})", self.slope, i, f"Slope of {name} within a step, per second; 0: held")
        for name, description in self.outputs:
            self.register_variable(Real(name, causality=Fmi2Causality.output, description=description,
                                        getter=lambda name=name: self.output_values(self.x, self.u)[name]))

    def register_input(self, name, values, i, description):
        def put(value):
            values[i] = value

        self.register_variable(Real(name, causality=Fmi2Causality.input, description=description, start=0.0,
                                    getter=lambda: values[i], setter=put))

    def rates(self, t, x, u):
        """Rates of the states."""
        raise NotImplementedError

    def output_values(self, x, u):
        """Outputs by name."""
        raise NotImplementedError

    def do_step(self, current_time, step_size):
        count = max(1, -int(-step_size // LONGEST))
        h, begin, slope = step_size / count, list(self.u), self.slope
        held = not any(slope)

        def at(t):
            return begin if held else [value + rate * t for value, rate in zip(begin, slope)]

        rates, x = self.rates, self.x
        for k in range(count):
            t = k * h
            middle, end = at(t + 0.5 * h), at(t + h)
            k1 = rates(current_time + t, x, at(t))
            k2 = rates(current_time + t + 0.5 * h, [a + 0.5 * h * b for a, b in zip(x, k1)], middle)
            k3 = rates(current_time + t + 0.5 * h, [a + 0.5 * h * b for a, b in zip(x, k2)], middle)
            k4 = rates(current_time + t + h, [a + h * b for a, b in zip(x, k3)], end)
            x = [a + h / 6.0 * (b + 2.0 * (c + d) + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4)]
        self.x[:] = x
        self.u[:] = at(step_size)
        return True

    def _get_fmu_state(self):
        return {"x": list(self.x), "u": list(self.u), "slope": list(self.slope)}

    def _set_fmu_state(self, state):
        self.x[:], self.u[:], self.slope[:] = state["x"], state["u"], state["slope"]
