"""A unit of FMI 3.0 that exists as a description alone, for evidence of other units: arrays, texts, faults. `StandIn` takes the place of
fmpy's `simulate_fmu`; records have the form that fmpy gives them."""

import zipfile
from posixpath import normpath

import numpy as np
from fmpy.simulation import Recorder

from bevel_differential.verify.evidence import FOLDER, NAMESPACE

# y = gain (time + u), w = (y, 2 y, 3 y), count = the whole seconds
DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="StandIn" instantiationToken="{0}">
  <CoSimulation modelIdentifier="StandIn"/>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.25"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
    <Float64 name="gain" valueReference="1" causality="parameter" variability="fixed" start="1"/>
    <Float64 name="u" valueReference="2" causality="input" start="0"/>
    <Float64 name="y" valueReference="3" causality="output"/>
    <Float64 name="w" valueReference="4" causality="output"><Dimension start="3"/></Float64>
    <Int32 name="count" valueReference="5" causality="output"/>
    <String name="text" valueReference="6" causality="output"/>
    <Binary name="raw" valueReference="7" causality="output"/>
    <String name="said" valueReference="8" causality="input"><Start value=""/></String>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="3"/><Output valueReference="4"/><Output valueReference="5"/><Output valueReference="6"/><Output valueReference="7"/>
  </ModelStructure>
</fmiModelDescription>
"""
HEAD = {"name": "org.fmi-standard.fmi-ls-ref", "version": "1.0.0-alpha.1",
        "description": "Layered Standard providing information on related files included in an FMU."}
# values of the default experiment
DEFAULT = "time,y\n0,0\n0.25,0.25\n0.5,0.5\n0.75,0.75\n1,1\n"


class StandIn:
    """Simulates, and keeps what it was asked for; `ends` is the time at which a run breaks off."""

    def __init__(self, ends=np.inf):
        self.asked, self.ends = {}, ends

    def __call__(self, folder, model_description, start_values, start_time, stop_time, output_interval, relative_tolerance, input, output,
                 logger, debug_logging=False):
        self.asked = {"values": start_values, "start": start_time, "stop": stop_time, "step": output_interval, "tolerance": relative_tolerance}
        gain, start = float(start_values.get("gain", 1.0)), start_time or 0.0
        recorder = Recorder(self, model_description, output)
        for step in range(round((stop_time - start) / output_interval) + 1):
            self.time = start + step * output_interval
            self.y = gain * (self.time + (0.0 if input is None else np.interp(self.time, input["time"], input["u"])))
            if self.time <= self.ends:
                recorder.sample(self.time)
        return recorder.result()

    def getFloat64(self, vr, nValues=None):
        return [value for reference in vr for value in {3: [self.y], 4: [self.y, 2.0 * self.y, 3.0 * self.y]}[reference]]

    def getInt32(self, vr, nValues=None):
        return [int(self.time)] * len(vr)

    def getString(self, vr, nValues=None):
        raise AssertionError("texts are not recorded")

    getBinary = getString


def manifest(*related, root="fmiReferences", more="", **attributes):
    """A manifest with such children; attributes that are None are left out."""
    given = {key: value for key, value in {**HEAD, **attributes}.items() if value is not None}
    words = " ".join(f'fmi-ls:fmi-ls-{key}="{value}"' for key, value in given.items())
    return f'<{root} xmlns:fmi-ls="{NAMESPACE}" {words}>{"".join(related)}{more}</{root}>'


def related(source, role="result", kind="text/csv"):
    """An entry of a manifest."""
    return f'<Related type="{kind}" source="{source}" role="{role}"/>'


def experiments(*children):
    """A file of experiments with such children."""
    return f'<?xml version="1.0"?><Experiments name="some">{"".join(children)}</Experiments>'


def packed(file, evidence, description=DESCRIPTION):
    """Writes the unit with these files of evidence; returns its path."""
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("modelDescription.xml", description)
        for name, text in evidence.items():
            if text is not None:
                archive.writestr(normpath(f"{FOLDER}/{name}"), text)
    return str(file)
