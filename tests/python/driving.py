"""Drives an opened FMU from communication point to communication point and keeps account of the energy it turns over."""


LEAST = 1e-9


class Drive:
    """A started scene.

    What the energy residual is measured against is the energy that went through: the heat of all causes, and
    ∫(|P_in| + |P_out|) dt of drives and wheels, by the trapezoidal rule between communication points. Powers are read
    under the inputs that act in the step."""

    def __init__(self, opened, values=None):
        for name, value in (values or {}).items():
            opened.set(name, value)
        opened.initialise()
        self.opened, self.time, self.exchanged = opened, 0.0, 0.0
        self.heats = [name for name in opened.reference if name.startswith("heat.")]

    def __getitem__(self, name):
        return self.opened.get(name)

    def set(self, values):
        for name, value in values.items():
            self.opened.set(name, value)

    def read(self, names):
        return self.opened.fmu.getReal([self.opened.reference[name] for name in names])

    def powers(self):
        return sum(map(abs, self.read(["power.in", "power.out"])))

    def step(self, size):
        begin = self.powers()
        self.opened.fmu.doStep(self.time, size)
        self.time += size
        self.exchanged += 0.5 * size * (begin + self.powers())

    def to(self, stop, size, each=None):
        """On to the time `stop` in steps of `size`; `each(drive)` hears every communication point."""
        begin = self.time
        for k in range(1, round((stop - begin) / size) + 1):
            # times without a sum of roundings
            self.step(begin + k * size - self.time)
            if each:
                each(self)
        return self

    def heat(self):
        return sum(self.read(self.heats))

    def residual(self):
        """Energy residual [J]."""
        return abs(self["solver.energy_residual"])

    def imbalance(self):
        """Energy residual over the energy turned over."""
        return self.residual() / max(self.heat() + self.exchanged, LEAST)

    def work(self):
        """What the integrator did: accepted and rejected steps, evaluations of the tooth forces."""
        accepted, rejected, calls = self.read(["solver.steps", "solver.rejected", "solver.rhs_calls"])
        return accepted + rejected, calls
