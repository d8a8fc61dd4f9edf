"""The manifest of the evidence has the form of FMI-LS-REF, and the document contains all that a test with fmpy needs."""

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from bevel_differential.verify import FOLDER, MANIFEST

KEPT = Path(__file__).resolve().parents[2] / "modelDescription" / "evidence"
DOCUMENT = "fmi-ls-ref.txt"
NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
# form of the manifest in RelaxNG
GRAMMAR = f"""<grammar xmlns="http://relaxng.org/ns/structure/1.0" datatypeLibrary="http://www.w3.org/2001/XMLSchema-datatypes">
  <start>
    <element name="fmiReferences">
      <attribute name="fmi-ls-name" ns="{NAMESPACE}"><value>org.fmi-standard.fmi-ls-ref</value></attribute>
      <attribute name="fmi-ls-version" ns="{NAMESPACE}"><value>1.0.0-beta.1</value></attribute>
      <attribute name="fmi-ls-description" ns="{NAMESPACE}">
        <value>Layered Standard providing information on related files included in an FMU.</value>
      </attribute>
      <zeroOrMore><element name="Related">
        <attribute name="source"><data type="anyURI"/></attribute>
        <attribute name="role"><data type="string"><param name="pattern">document|requirement|specification|model|parameter|system|testcase|\
experiment(/(smoke-test|validation|uncertainty-analysis))?|result|method|rationale|report|request|delivery|configuration|signature|\
serialized-state(/.*)?|meta-data|other</param></data></attribute>
        <optional><attribute name="type"/></optional>
        <optional><attribute name="description"/></optional>
        <empty/>
      </element></zeroOrMore>
    </element>
  </start>
</grammar>"""
FORM = etree.RelaxNG(etree.fromstring(GRAMMAR))


def manifest():
    return etree.parse(str(KEPT / MANIFEST)).getroot()


def test_the_manifest_has_the_form():
    FORM.assertValid(manifest())


@pytest.mark.parametrize("old, new", [
    ("fmiReferences", "fmi-ls:fmiLayeredStandardManifest"),
    ('fmi-ls-description="Layered', 'fmi-ls-description="Our'),
    ('role="parameter"', 'role="parameters"'),
    ('role="result"', 'role="result/scene"'),
    ('source="tolerances.csv"', ""),
    ("</fmiReferences>", '<Scene name="a"/></fmiReferences>'),
])
def test_other_forms_are_noticed(old, new):
    text = (KEPT / MANIFEST).read_text(encoding="utf-8")
    assert old in text
    assert not FORM.validate(etree.fromstring(text.replace(old, new).encode()))


def test_attributes_of_the_manifest_are_those_of_the_standard_s_schema():
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3LayeredStandardManifest.xsd")))
    # the schema has another root element with the same attributes
    bare = etree.Element(f"{{{NAMESPACE}}}fmiLayeredStandardManifest", dict(manifest().attrib))
    schema.assertValid(bare)
    del bare.attrib[f"{{{NAMESPACE}}}fmi-ls-version"]
    assert not schema.validate(bare)


def test_every_file_is_listed_with_its_role(fmu_file):
    with zipfile.ZipFile(fmu_file) as archive:
        there = {name.removeprefix(f"{FOLDER}/") for name in archive.namelist() if name.startswith(FOLDER)} - {MANIFEST}
        assert f"documentation/{DOCUMENT}" in archive.namelist()
    roles = {"parameters": "parameter", "inputs": "testcase", "results": "result", "tolerances.csv": "testcase"}
    entries = {related.get("source"): related.get("role") for related in manifest()}
    assert len(entries) == len(manifest())
    assert entries == {f"../../documentation/{DOCUMENT}": "document", **{name: roles[name.partition("/")[0]] for name in there}}
    scenes = {folder: {Path(name).stem for name in there if name.startswith(folder)} for folder in ("parameters", "inputs", "results")}
    assert scenes["parameters"] == scenes["results"] > scenes["inputs"]


@pytest.mark.parametrize("version, changed", [("", None), ("3", None), ("", "study_turning")])
def test_the_lines_for_plain_fmpy_test_a_unit(fmu_file, tmp_path, version, changed):
    """The documented lines test a unit, and detect a result that differs."""
    lines = re.search(r"```python\n(.*?)```", (KEPT / DOCUMENT).read_text(encoding="utf-8"), re.DOTALL)[1]
    with zipfile.ZipFile(fmu_file.replace(".fmu", f"{version}.fmu")) as archive, zipfile.ZipFile(tmp_path / "BevelDifferential.fmu", "w") as unit:
        for name in archive.namelist():
            content = archive.read(name)
            unit.writestr(name, content.replace(b"\n0,", b"\n0,1") if name.endswith(f"results/{changed}.csv") else content)
    done = subprocess.run([sys.executable, "-c", lines], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=True)
    found = {name: float(ratio) for name, ratio in re.findall(r"^(\w+) (\S+)$", done.stdout, re.MULTILINE)}
    assert found.keys() == {file.stem for file in (KEPT / "parameters").iterdir()}
    assert {name for name, ratio in found.items() if not ratio <= 1.0} == ({changed} if changed else set())
