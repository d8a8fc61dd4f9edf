"""The evidence in the FMU, and the command that tests a unit with it. test_evidence_form.py tests the form of the files."""

import csv
import re
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from command_line import command
from refusals import pattern, refused
from lxml import etree

from evidence_unit import FEW, packed

from bevel_differential import Scene
from bevel_differential.command import FINDING, WRONG
from bevel_differential.scene_file import find, read_scene, shipped_scenes
from bevel_differential.verify import FOLDER, MANIFEST, verify

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "modelDescription" / "evidence"
OTHERS = ROOT / "fmu-build" / "evidence"
# files of all scenes in the evidence: the shipped scenes, and those for laws, levels and effects that no shipped scene uses
SCENES = {**{name: find(name) for name in shipped_scenes()}, **{file.stem: file for file in OTHERS.glob("*.toml")}}
LARGEST = 1_000_000  # bytes of all files
ROWS = 300
LONGEST = 60.0  # seconds of a scene that results have
DESCRIPTION = "modelDescription.xml"


@pytest.fixture
def unit(fmu_file, tmp_path):
    """unit(changes, scenes): path of an FMU with changed evidence."""
    return lambda changes, scenes=FEW: packed(fmu_file, tmp_path / "unit.fmu", scenes, changes)


def result_of(folder, name):
    """The result of a scene, read by numpy."""
    return np.genfromtxt(folder / "results" / f"{name}.csv", delimiter=",", names=True, deletechars="", replace_space=" ")


def tolerances_in(folder):
    """Tolerances by scene and variable."""
    return {(row["scene"], row["variable"]): float(row["tolerance"]) for row in csv.DictReader((folder / "tolerances.csv").open())}


@pytest.mark.parametrize("version", ["", "3"])
def test_the_shipped_unit_passes_in_all_scenes(fmu_file, tmp_path, version):
    file = tmp_path / "table.csv"
    lines = command(f"verify {fmu_file.replace('.fmu', f'{version}.fmu')} --csv {file}").out.splitlines()
    assert f"{len(SCENES)} scenes, {len(SCENES)} passed" in lines
    assert all(any(re.match(rf"{name} .* passed$", line) for line in lines) for name in SCENES)
    rows = list(csv.DictReader(file.read_text().splitlines()))
    for name, scene in SCENES.items():
        outputs = Scene.load(scene).outputs
        assert sorted(row["variable"] for row in rows if row["scene"] == name) == sorted(outputs)
    assert all(abs(float(row["value"]) - float(row["expected"])) <= float(row["tolerance"]) for row in rows)


@pytest.mark.parametrize("scene, name, variable", [
    ("clunk", "half_shaft.left_stiffness", "left.twist"),
    ("study_turning", "left.load_torque", "left.tangential_force"),
    ("one_wheel_on_ice", "inertia.left_end", "left.wheel_speed"),
    ("rattle", "carrier.speed_command", None),
])
def test_changed_physics_is_reported_with_scene_variable_time_and_deviation(unit, scene, name, variable):
    def changed(text):
        parameter = re.compile(rf'(name="{re.escape(name)}".*?value=")([^"]+)(")', re.DOTALL)
        return parameter.sub(lambda found: f"{found[1]}{1.02 * float(found[2])}{found[3]}", text, count=1)

    # the scene rattle follows a table from 0 s on, so that a change of its start value has no effect
    change = {f"parameters/{scene}.ssv": changed} if variable else {f"inputs/{scene}.csv": lambda text: text.replace("3.49", "3.56")}
    lines = command(f"verify {unit(change, {*FEW, scene})}", FINDING).out.splitlines()
    said = [line for line in lines if line.startswith(f"{scene}: {variable or ''}")]
    found = re.search(r": (\S+) at (\S+) s is (\S+) .*expected (\S+) within (\S+): (\S+) times the tolerance$", said[0])
    assert found and 0.0 <= float(found[2]) <= Scene.load(scene).stop
    value, expected, tolerance, ratio = map(float, found.groups()[2:])
    assert ratio == pytest.approx(abs(value - expected) / tolerance, rel=0.1) and ratio > 10.0
    # the other scenes still pass
    verdicts = {line.split()[0]: line.split()[-1] for line in lines[1:len({*FEW, scene}) + 1]}
    assert verdicts == {name: "failed" if name == scene else "passed" for name in {*FEW, scene}}


def test_one_wrong_value_of_a_result_is_noticed_at_its_place(unit):
    file = unit({"results/hil.csv": lambda text: re.sub(r"(\n0\.05,)([^,]+)", r"\g<1>17", text)})
    lines = command(f"verify {file}", FINDING).out.splitlines()
    assert re.fullmatch(r"hil: carrier\.speed at 0\.05 s is 16\.65\d* rad/s, expected 17 within \S+: \S+ times the tolerance", lines[-2])
    assert lines[-1] == "2 scenes, 1 passed, 1 not"


@pytest.mark.parametrize("changes, message", [
    ({"results/hil.csv": None}, "results/hil.csv … not in the FMU"),
    ({"inputs/hil.csv": None}, "inputs/hil.csv … not in the FMU"),
    ({"parameters/hil.ssv": None}, "parameters/hil.ssv … not in the FMU"),
    ({MANIFEST: lambda text: text.replace("parameters/hil.ssv", "parameters/other.ssv")}, f"{MANIFEST} … no file of hil … parameter"),
    ({"results/hil.csv": lambda text: text.replace("left.twist", "left.twits")}, "results/hil.csv, line 1 … left.twits … did you mean left.twist"),
    ({"results/hil.csv": lambda text: text.replace("left.twist", "right.twist")}, "results/hil.csv, line 1 … right.twist … twice"),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n0.05,x", 1)}, "results/hil.csv, line 4 … carrier.speed … 'x"),
    ({"results/hil.csv": lambda text: re.sub(r"\n0\.05,[^,]+", r"\n0.05,nan", text)}, "results/hil.csv, line 4 … carrier.speed … 'nan'"),
    ({"results/hil.csv": lambda text: re.sub(r"\n0\.05,[^,]+", r"\n0.05,", text)}, "results/hil.csv, line 4 … carrier.speed … ''"),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n0.05,1,", 1)}, "results/hil.csv, line 4 … 8 cells … has 7"),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n-0.05,", 1)}, "results/hil.csv, line 4 … times fall"),
    ({"results/hil.csv": lambda text: text.partition("\n")[0]}, "results/hil.csv … two rows"),
    ({"results/hil.csv": "time\n0\n1\n"}, "results/hil.csv … needs an output"),
    ({"results/hil.csv": ""}, "results/hil.csv … it is empty"),
    ({"results/hil.csv": lambda text: text.replace("time,", "speed,", 1)}, "results/hil.csv, line 1 … 'speed' … must be time"),
    ({"inputs/hil.csv": lambda text: re.sub(r"\n0\.0,[^,]+", r"\n0.0,inf", text)}, "inputs/hil.csv, line 2 … 'inf'"),
    ({"parameters/hil.ssv": lambda text: text.replace('"scene.left_drive"', '"scene.left_driv"')},
     "parameters/hil.ssv … scene.left_driv … did you mean scene.left_drive"),
    ({"parameters/hil.ssv": lambda text: text.replace('value="ideal"', 'value="idel"')}, "parameters/hil.ssv … scene.gear_contact … 'idel' … ideal"),
    ({"parameters/hil.ssv": lambda text: text.replace('value="10.0"', 'value="ten"', 1)}, "parameters/hil.ssv … 'ten' … is a number"),
    ({"parameters/hil.ssv": lambda text: text.replace('value="10.0"', 'value="NaN"', 1)}, "parameters/hil.ssv … 'NaN' … finite"),
    ({"parameters/hil.ssv": lambda text: text.replace('unit="N.m"', 'unit="stone.ft"', 1)}, "parameters/hil.ssv … stone.ft … N.m"),
    ({"parameters/hil.ssv": lambda text: re.sub('<ssv:Real value="10.0".*?/>', "", text, count=1)}, "parameters/hil.ssv … half_shaft … ''"),
    ({"parameters/hil.ssv": "<"}, "parameters/hil.ssv … not valid XML"),
    ({"parameters/hil.ssv": lambda text: text.replace('value="10.0"', 'value="-10.0"', 1)}, "the unit fails … half_shaft"),
    ({"tolerances.csv": lambda text: text.replace("hil,left.twist", "clunk,left.twist")}, "tolerances.csv … left.twist … hil"),
    ({"tolerances.csv": lambda text: text.replace("hil,left.twist", "hil,left.twits")}, "tolerances.csv, line … left.twits … did you mean"),
    ({"tolerances.csv": lambda text: re.sub(r"(hil,left.twist,rad),\S+", r"\1,0", text)}, "tolerances.csv, line … = 0 … above 0"),
    ({"tolerances.csv": lambda text: re.sub(r"(hil,left.twist,rad),\S+", r"\1,nan", text)}, "tolerances.csv, line … 'nan' … finite number"),
    ({"tolerances.csv": lambda text: text.replace("hil,left.twist,rad,", "hil,left.twist,deg,")}, "tolerances.csv, line … left.twist … rad, not 'deg'"),
])
def test_broken_evidence_is_reported_by_name(unit, changes, message):
    lines = command(f"verify {unit(changes)}", FINDING).out.splitlines()
    said = [line for line in lines if line.startswith("hil: ")]
    assert len(said) == 1 and re.search(pattern(message), said[0]) and not re.search("fmi[23][A-Z]|/tmp", said[0]), said
    assert any(re.match(r"hil +broken$", line) for line in lines)
    assert lines[-1] == "2 scenes, 1 passed, 1 not"


@pytest.mark.parametrize("content, part", [(None, "tolerances.csv: it is not in the FMU"), ("scene,variable,unit\n", "no column tolerance")])
def test_without_tolerances_no_scene_is_compared(unit, content, part):
    lines = command(f"verify {unit({'tolerances.csv': content})}", FINDING).out.splitlines()
    assert sum(part in line for line in lines) == len(FEW) and lines[-1] == "2 scenes, 0 passed, 2 not"


@pytest.mark.parametrize("changes, message", [
    ({MANIFEST: None}, f"no evidence … {FOLDER}/{MANIFEST}"),
    ({MANIFEST: lambda text: text.replace('role="result"', 'role="report"')}, f"{MANIFEST} … no file with the role result"),
    ({MANIFEST: "no XML"}, f"{MANIFEST} … not valid XML"),
    ({DESCRIPTION: lambda text: text.replace('modelName="BevelDifferential"', 'modelName="Gearbox"')}, "the unit Gearbox … BevelDifferential"),
    ({DESCRIPTION: "no XML"}, "its model description cannot be read"),
])
def test_another_unit_and_one_without_evidence_are_refused(unit, changes, message):
    file = unit(changes)
    with refused(f"{file} … {message}"):
        verify(file)
    assert command(f"verify {file}", WRONG).err.startswith(f"bevel-differential: {file}")


def test_parameter_sets_are_valid_by_the_standard_s_schema():
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "ssp" / "schema" / "SystemStructureParameterValues.xsd")))
    files = sorted((KEPT / "parameters").glob("*.ssv"))
    assert [file.stem for file in files] == sorted(SCENES)
    for file in files:
        schema.assertValid(etree.parse(str(file)))


@pytest.mark.parametrize("version", ["", "3"])
def test_both_units_have_the_small_evidence_of_the_repository(fmu_file, version):
    kept = {file.relative_to(KEPT).as_posix(): file.read_bytes() for file in KEPT.rglob("*") if file.is_file()}
    document = kept.pop("fmi-ls-ref.txt")
    with zipfile.ZipFile(fmu_file.replace(".fmu", f"{version}.fmu")) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    assert {f"{FOLDER}/{name}": data for name, data in kept.items()} == {name: data for name, data in content.items() if name.startswith(FOLDER)}
    assert content["documentation/fmi-ls-ref.txt"] == document
    assert sum(map(len, kept.values())) < LARGEST
    assert all(data.count(b"\n") <= ROWS for name, data in kept.items() if name.startswith("results/"))


def test_the_evidence_of_the_repository_is_that_of_the_command(fmu_file, tmp_path):
    import evidence

    made = tmp_path / "made"
    evidence.main(fmu_file, OTHERS, made)
    names = sorted(file.relative_to(made).as_posix() for file in made.rglob("*") if file.is_file())
    assert names == sorted(file.relative_to(KEPT).as_posix() for file in KEPT.rglob("*") if file.is_file())
    for name in names:
        if not name.startswith(("results/", "tolerances")):
            assert (made / name).read_bytes() == (KEPT / name).read_bytes(), f"{name} is out of date; renew it: cargo run --release -- evidence"
    kept, new = tolerances_in(KEPT), tolerances_in(made)
    assert kept.keys() == new.keys()
    for key, tolerance in kept.items():
        assert new[key] == pytest.approx(tolerance, rel=0.5), key
    for scene in SCENES:
        old, now = result_of(KEPT, scene), result_of(made, scene)
        assert old.dtype.names == now.dtype.names and np.array_equal(old["time"], now["time"])
        for name in old.dtype.names[1:]:
            assert np.abs(old[name] - now[name]).max() <= kept[scene, name], (scene, name)


@pytest.mark.parametrize("name", sorted(SCENES))
def test_results_are_those_of_the_scenes(name):
    """The package simulates a scene and reads its inputs with other code than the command, and gives equal results."""
    # the results are those of hosts that hold inputs between communication points
    with Scene(**(read_scene(SCENES[name]) | {"input_slopes": False})) as scene:
        scene.stop = min(scene.stop, LONGEST)
        record = scene.run()
    result, allowed = result_of(KEPT, name), {variable: value for (of, variable), value in tolerances_in(KEPT).items() if of == name}
    assert result["time"][1] - result["time"][0] == pytest.approx(scene.step, rel=1e-9)
    places = np.array([int(np.argmin(np.abs(record["time"] - time))) for time in result["time"]])
    assert np.allclose(record["time"][places], result["time"], rtol=1e-9, atol=1e-12)
    assert sorted(result.dtype.names[1:]) == sorted(scene.outputs) == sorted(allowed)
    for output in scene.outputs:
        assert np.abs(record[output][places] - result[output]).max() <= allowed[output], output
