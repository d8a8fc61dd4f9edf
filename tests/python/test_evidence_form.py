"""The evidence that the FMU carries has the form of FMI-LS-REF 1.0.0-alpha.1, and says all that a test by a plain host needs."""

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from bevel_differential.verify.evidence import MANIFEST, NAMESPACE

KEPT = Path(__file__).resolve().parents[2] / "modelDescription" / "evidence"
SETS = {"smoke-tests.exp": "experiment/smoke-test", "validation.exp": "experiment/validation"}
# the two forms, in words of RelaxNG
GRAMMAR = """<grammar xmlns="http://relaxng.org/ns/structure/1.0" datatypeLibrary="http://www.w3.org/2001/XMLSchema-datatypes">
  <start><ref name="{start}"/></start>
  <define name="manifest">
    <element name="fmiReferences">
      <attribute name="fmi-ls-name" ns="{namespace}"><value>org.fmi-standard.fmi-ls-ref</value></attribute>
      <attribute name="fmi-ls-version" ns="{namespace}"><value>1.0.0-alpha.1</value></attribute>
      <attribute name="fmi-ls-description" ns="{namespace}">
        <value>Layered Standard providing information on related files included in an FMU.</value>
      </attribute>
      <zeroOrMore><element name="Related">
        <attribute name="source"><data type="anyURI"/></attribute>
        <attribute name="role"><choice>{roles}</choice></attribute>
        <optional><attribute name="type"/></optional>
        <optional><attribute name="description"/></optional>
        <empty/>
      </element></zeroOrMore>
    </element>
  </define>
  <define name="experiments">
    <element name="Experiments">
      <attribute name="name"/><optional><attribute name="description"/></optional>
      <oneOrMore><element name="Experiment">
        <attribute name="name"/><optional><attribute name="description"/></optional>
        {times}
        <optional><element name="Parameters"><ref name="file"/></element></optional>
        <optional><element name="Stimuli"><ref name="file"/></element></optional>
        <optional><element name="References"><ref name="file"/></element></optional>
      </element></oneOrMore>
    </element>
  </define>
  <define name="file"><attribute name="source"><data type="anyURI"/></attribute><optional><attribute name="type"/></optional><empty/></define>
</grammar>"""
ROLES = """document requirement specification model parameter system testcase experiment experiment/smoke-test experiment/validation
           experiment/uncertainty-analysis result method rationale report request delivery configuration signature other""".split()


def form(start):
    times = "".join(f'<optional><attribute name="{key}"><data type="double"/></attribute></optional>'
                    for key in ("startTime", "stopTime", "stepSize", "tolerance"))
    return etree.RelaxNG(etree.fromstring(GRAMMAR.format(
        start=start, namespace=NAMESPACE, times=times, roles="".join(f"<value>{role}</value>" for role in ROLES))))


def tree(name):
    return etree.parse(str(KEPT / name)).getroot()


def test_the_manifest_has_the_form():
    form("manifest").assertValid(tree(MANIFEST))


@pytest.mark.parametrize("name", SETS)
def test_files_of_experiments_have_the_form(name):
    form("experiments").assertValid(tree(name))


@pytest.mark.parametrize("name, old, new", [
    (MANIFEST, "fmiReferences", "fmi-ls:fmiLayeredStandardManifest"),
    (MANIFEST, 'fmi-ls-description="Layered', 'fmi-ls-description="Our'),
    (MANIFEST, 'role="parameter"', 'role="parameters"'),
    (MANIFEST, 'role="experiment/validation"', 'role="experiment/whole"'),
    (MANIFEST, 'source="tolerances.csv"', ""),
    (MANIFEST, "</fmiReferences>", '<Experiment name="a"/></fmiReferences>'),
    ("validation.exp", 'name="hil"', 'name="hil" kind="validation"'),
    ("validation.exp", 'stopTime="10"', 'stopTime="10 s"'),
    ("validation.exp", "Parameters", "ParameterSet"),
    ("validation.exp", "<Experiments ", '<Experiments xmlns="http://fmi-standard.org/fmi-ls-manifest" '),
    ("validation.exp", "</Experiment>", '<Parameters source="a.ssv"/></Experiment>'),
])
def test_other_forms_are_noticed(name, old, new):
    text = (KEPT / name).read_text(encoding="utf-8")
    assert old in text
    assert not form("manifest" if name == MANIFEST else "experiments").validate(etree.fromstring(text.replace(old, new).encode()))


def test_attributes_of_the_manifest_are_those_of_the_standard_s_schema():
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3LayeredStandardManifest.xsd")))
    # the schema knows an element of its own with them
    bare = etree.Element(f"{{{NAMESPACE}}}fmiLayeredStandardManifest", dict(tree(MANIFEST).attrib))
    schema.assertValid(bare)
    del bare.attrib[f"{{{NAMESPACE}}}fmi-ls-version"]
    assert not schema.validate(bare)


def test_every_file_is_named_with_its_role_and_every_name_leads_to_a_file():
    entries = {related.get("source"): related.get("role") for related in tree(MANIFEST)}
    assert len(entries) == len(tree(MANIFEST))
    there = {file.relative_to(KEPT).as_posix() for file in KEPT.rglob("*") if file.is_file()} - {MANIFEST}
    named = {child.get("source") for name in SETS for child in tree(name).iterfind("*/*")}
    assert there == set(entries) | named
    # results of scenes are none of the default experiment, which readers would take an entry for
    assert entries == {**{name: "parameter" for name in there if name.startswith("parameters/")}, **SETS,
                       "tolerances.csv": "other", "requirements.md": "document"}


def test_each_scene_has_a_smoke_test_and_a_validation_with_the_same_files():
    smoke, whole = ({experiment.get("name"): experiment for experiment in tree(name)} for name in SETS)
    assert whole.keys() == {file.stem for file in (KEPT / "parameters").iterdir()}
    assert smoke.keys() == {f"{name}_smoke" for name in whole}
    for name, experiment in whole.items():
        first, files = smoke[f"{name}_smoke"], {child.tag: child.get("source") for child in experiment}
        assert files.keys() - {"Stimuli"} == {"Parameters", "References"} and files["References"] == f"results/{name}.csv"
        assert {child.tag: child.get("source") for child in first} == {**files, "References": f"results/{name}_smoke.csv"}
        assert float(first.get("stopTime")) == pytest.approx(0.1 * float(experiment.get("stopTime")))
        assert all(first.get(key) == experiment.get(key) for key in ("startTime", "stepSize", "description"))


@pytest.mark.parametrize("changed", [None, "study_turning"])
def test_the_lines_of_plain_fmpy_hold_a_unit_to_the_evidence(fmu_file, tmp_path, changed):
    """As documented, and they notice a result that differs."""
    lines = re.search(r"```python\n(.*?)```", (KEPT / "requirements.md").read_text(encoding="utf-8"), re.DOTALL)[1]
    with zipfile.ZipFile(fmu_file) as archive, zipfile.ZipFile(tmp_path / "BevelDifferential.fmu", "w") as unit:
        for name in archive.namelist():
            content = archive.read(name)
            unit.writestr(name, content.replace(b"\n0,", b"\n0,1") if name.endswith(f"results/{changed}.csv") else content)
    done = subprocess.run([sys.executable, "-c", lines], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=True)
    found = {name: float(ratio) for name, ratio in re.findall(r"^(\w+) (\S+)$", done.stdout, re.MULTILINE)}
    assert found.keys() == {file.stem for file in (KEPT / "parameters").iterdir()}
    assert {name for name, ratio in found.items() if not ratio <= 1.0} == ({changed} if changed else set())
