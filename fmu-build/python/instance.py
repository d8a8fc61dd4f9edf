"""An instance of an FMU whose variables are called by their names: one way for tests, comparisons and measurements."""


class Instance:
    """Wraps an instance that fmpy made.

    Values are set as they are written: an enumeration by its literal or number, a Real as a number in SI or as text with
    a display unit, as "954 deg/s"."""

    def __init__(self, fmu, description):
        self.fmu = fmu
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.factors = {(unit.name, shown.name): float(shown.factor) for unit in description.unitDefinitions
                        for shown in unit.displayUnits}

    def set(self, name, value):
        kind = self.variables[name].type
        if kind == "Enumeration":
            kind, value = "Integer", self.number(name, value)
        elif kind == "Real":
            value = self.si(name, value)
        getattr(self.fmu, f"set{kind}")([self.variables[name].valueReference], [value])

    def number(self, name, literal):
        """Of a literal; numbers stay."""
        items = self.variables[name].declaredType.items
        return next((int(item.value) for item in items if item.name == literal), literal)

    def si(self, name, value):
        """A number; text has the variable's unit or one of its display units."""
        if not isinstance(value, str):
            return value
        number, unit = value.split()
        variable = self.variables[name]
        own = variable.unit or variable.declaredType.unit
        return float(number) / (1.0 if unit == own else self.factors[own, unit])

    def get(self, name):
        return self.read([name])[0]

    def read(self, names):
        """Values of Reals."""
        return self.fmu.getReal([self.variables[name].valueReference for name in names])

    def initialise(self, **options):
        self.fmu.setupExperiment(**options)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
