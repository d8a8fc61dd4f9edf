from .blocks import Section
def section(run):
    return Section("pattern","x")
