"""The evidence that the FMU carries, and the command that holds a unit to it. Its form: test_evidence_form.py; evidence of other units:
test_verify_others.py."""

import csv
import re
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree
from stand_in import manifest, related

from bevel_differential import DifferentialError, Scene
from bevel_differential.command import main
from bevel_differential.scene_file import find, read_scene, shipped_scenes
from bevel_differential.verify import verify
from bevel_differential.verify.evidence import FOLDER, MANIFEST

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "modelDescription" / "evidence"
OTHERS = ROOT / "fmu-build" / "evidence"
# files of all scenes in the evidence: the shipped ones, and those in which acts what no shipped one needs
SCENES = {**{name: find(name) for name in shipped_scenes()}, **{file.stem: file for file in OTHERS.glob("*.toml")}}
LARGEST = 1_000_000  # bytes of all files
ROWS = 300
LONGEST = 60.0  # seconds of a scene that results have
# scenes of units that carry few: one of a second without teeth, one with teeth from an equilibrium
FEW = ("hil", "study_turning")


@pytest.fixture(scope="module")
def content(fmu_file):
    """Files of the packaged FMU by name."""
    with zipfile.ZipFile(fmu_file) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.startswith("documentation/")}


def few(content, scenes):
    """The files with the experiments of these scenes alone."""
    files, names = dict(content), "|".join(name for name in SCENES if name not in scenes)
    for name, others in {MANIFEST: rf'  <Related [^>]*source="\w+/(?:{names})(?:_smoke)?\.[^>]*>\n',
                         "validation.exp": rf'  <Experiment name="(?:{names})" .*?</Experiment>\n',
                         "smoke-tests.exp": rf'  <Experiment name="(?:{names})_smoke" .*?</Experiment>\n'}.items():
        files[f"{FOLDER}/{name}"] = re.sub(others, "", files[f"{FOLDER}/{name}"].decode(), flags=re.DOTALL)
    return files


@pytest.fixture
def unit(content, tmp_path):
    """unit({file of the evidence: content or function of the present one, or None for none}, scenes): an FMU with other evidence."""

    def made(changes, scenes=FEW):
        files = few(content, scenes)
        for name, change in changes.items():
            path = f"{FOLDER}/{name}"
            if callable(change):
                old = files[path] if isinstance(files[path], str) else files[path].decode()
                new = change(old)
                assert new != old, f"{name} is as it was"
            else:
                new = change
            files.pop(path, None)
            if new is not None:
                files[path] = new
        with zipfile.ZipFile(tmp_path / "unit.fmu", "w") as archive:
            for name, data in files.items():
                archive.writestr(name, data)
        return str(tmp_path / "unit.fmu")

    return made


# of the unit's default experiment, which is the study straight ahead from an equilibrium
def default_result(fmu_file):
    record = fmpy.simulate_fmu(fmu_file, output=["left.speed", "left.shaft_torque"], logger=lambda *_: None)
    return "".join(f"{','.join(map(repr, row))}\n" for row in [record.dtype.names, *record.tolist()]).replace("'", "")


@pytest.mark.parametrize("version", ["", "3"])
def test_the_shipped_unit_passes_all_its_experiments(fmu_file, capsys, version):
    assert main(["verify", fmu_file.replace(".fmu", f"{version}.fmu")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == f"{2 * len(SCENES)} experiments, {2 * len(SCENES)} passed"
    for name in SCENES:
        for ending, kind in (("", "validation"), ("_smoke", "smoke test")):
            assert any(re.match(rf"{name}{ending} +{kind} .* passed$", line) for line in lines), name
    assert not any(line.startswith("fault") for line in lines)


def test_quick_runs_smoke_tests_alone_and_the_table_has_every_variable(fmu_file, tmp_path, capsys):
    file = tmp_path / "table.csv"
    assert main(["verify", fmu_file, "--quick", "--csv", str(file)]) == 0
    assert f"{len(SCENES)} experiments" in capsys.readouterr().out
    rows = list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))
    assert {row["kind"] for row in rows} == {"smoke test"}
    for name in SCENES:
        outputs = Scene.load(SCENES[name], fmu=fmu_file).outputs
        assert sorted(row["variable"] for row in rows if row["experiment"] == f"{name}_smoke") == sorted(outputs)
    assert all(abs(float(row["value"]) - float(row["expected"])) <= float(row["tolerance"]) for row in rows)


@pytest.mark.parametrize("scene, name, variable", [
    ("clunk", "half_shaft.left_stiffness", "left.twist"),
    ("study_turning", "left.load_torque", "left.tangential_force"),
    ("one_wheel_on_ice", "inertia.left_end", "left.wheel_speed"),
    ("rattle", "carrier.speed_command", None),
])
def test_other_physics_is_noticed_with_scene_variable_time_and_by_how_much(unit, fmu_file, capsys, scene, name, variable):
    def changed(text):
        parameter = re.compile(rf'(name="{re.escape(name)}".*?value=")([^"]+)(")', re.DOTALL)
        return parameter.sub(lambda found: f"{found[1]}{1.02 * float(found[2]) + (variable is None) * 0.01}{found[3]}", text, count=1)

    # the scene rattle follows a table from 0 s on, so that a start value changes nothing
    file = f"parameters/{scene}.ssv" if variable else f"inputs/{scene}.csv"
    change = changed if variable else (lambda text: text.replace("3.49", "3.56"))
    assert main(["verify", unit({file: change}, {*FEW, scene})]) == 3
    lines = capsys.readouterr().out.splitlines()
    said = [line for line in lines if line.startswith(f"{scene}, validation: {variable or ''}")]
    found = re.search(r": (\S+) at (\S+) s is (\S+) .*expected (\S+) .*within (\S+): off by (\S+), (\S+) times the tolerance$", said[0])
    assert found and 0.0 <= float(found[2]) <= Scene.load(scene, fmu=fmu_file).stop
    value, expected, tolerance, off, ratio = map(float, found.groups()[2:])
    assert abs(value - expected) == pytest.approx(off, rel=0.02, abs=1e-8 * abs(value)) and off > tolerance
    assert ratio == pytest.approx(off / tolerance, rel=0.06) and ratio > 10.0
    # the other scenes still pass
    verdicts = {line.split()[0]: line.split()[-1] for line in lines[1:2 * len({*FEW, scene}) + 1]}
    assert {f"{each}{ending}" for each in {*FEW, scene} for ending in ("", "_smoke")} == set(verdicts)
    assert {each for each, verdict in verdicts.items() if verdict != "passed"} <= {scene, f"{scene}_smoke"}
    assert verdicts[scene] == "failed"


@pytest.mark.parametrize("changes, parts", [
    ({"results/hil.csv": None}, ["hil, validation", "results/hil.csv", "not in the FMU"]),
    ({"results/hil.csv": lambda text: text.replace("left.twist", "left.twits")}, ["results/hil.csv, line 1", "left.twits", "did you mean left.twist"]),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n0.05,x", 1)}, ["results/hil.csv, line 3", "column carrier.speed", "'x"]),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n0.05,1,", 1)}, ["results/hil.csv, line 3", "8 cells", "has 7"]),
    ({"results/hil.csv": lambda text: text.replace("\n0.05,", "\n-0.05,", 1)}, ["results/hil.csv", "times fall"]),
    ({"results/hil.csv": b""}, ["results/hil.csv", "it is empty"]),
    ({"results/hil.csv": lambda text: text.replace("time,", "speed,", 1)}, ["results/hil.csv, line 1", "'speed'", "must be time"]),
    ({"results/hil.csv": lambda text: text.replace("\n10,", "\n20,", 1)}, ["hil, validation", "ends at 10 s", "20 s"]),
    ({"parameters/hil.ssv": lambda text: text.replace('"scene.left_drive"', '"scene.left_driv"')},
     ["parameters/hil.ssv", "scene.left_driv", "did you mean scene.left_drive"]),
    ({"parameters/hil.ssv": lambda text: text.replace('value="ideal"', 'value="idel"')}, ["parameters/hil.ssv", "scene.gear_contact", "'idel'", "ideal"]),
    ({"parameters/hil.ssv": lambda text: text.replace('value="10.0"', 'value="ten"', 1)}, ["parameters/hil.ssv", "'ten'", "no number"]),
    ({"parameters/hil.ssv": lambda text: text.replace('unit="N.m"', 'unit="lbf.ft"', 1)}, ["parameters/hil.ssv", "lbf.ft", "N.m"]),
    ({"parameters/hil.ssv": b"<"}, ["parameters/hil.ssv", "no valid XML"]),
    ({"parameters/hil.ssv": lambda text: text.replace('value="10.0"', 'value="-10.0"', 1)}, ["hil, validation", "the unit fails", "half_shaft"]),
    ({"tolerances.csv": lambda text: text.replace("hil,left.twist", "hil,right.twits")}, ["tolerances.csv", "left.twist", "hil"]),
    ({"tolerances.csv": lambda text: re.sub(r"(hil,left.twist,rad),\S+", r"\1,0", text)}, ["tolerances.csv, line", "value 0", "above 0"]),
])
def test_broken_evidence_is_reported_by_name(unit, capsys, changes, parts):
    assert main(["verify", unit(changes)]) == 3
    lines = capsys.readouterr().out.splitlines()
    said = [line for line in lines if line.startswith("hil, validation: ")]
    assert len(said) == 1 and all(part in said[0] for part in parts) and not re.search("fmi[23][A-Z]", said[0]), said
    assert any(re.match(r"hil +validation +broken$", line) for line in lines)
    assert sum(line.endswith(" passed") for line in lines) >= len(FEW)


@pytest.mark.parametrize("separator, comma", [(";", ","), ("\t", ","), (";", ".")])
def test_tables_of_spreadsheets_are_evidence_too(unit, capsys, separator, comma):
    def written(text):
        rows = [line.split(",") for line in text.splitlines()]
        return "\r\n".join(separator.join(cell if row is rows[0] else cell.replace(".", comma) for cell in row) for row in rows)

    assert main(["verify", unit({"results/hil.csv": written, "inputs/hil.csv": written})]) == 0
    assert any(re.match(r"hil +validation .* passed$", line) for line in capsys.readouterr().out.splitlines())


def test_without_the_file_of_validations_smoke_tests_are_left_and_the_command_fails(unit, capsys):
    assert main(["verify", unit({"validation.exp": None})]) == 3
    lines = capsys.readouterr().out.splitlines()
    assert any(re.match(r"validation.exp +validation +broken$", line) for line in lines)
    assert "validation.exp, validation: validation.exp: it is not in the FMU" in lines
    assert lines[-1] == f"{len(FEW) + 1} experiments, {len(FEW)} passed, 1 not"


def test_tolerances_without_their_column_leave_nothing_to_judge_by(unit, capsys):
    assert main(["verify", unit({"tolerances.csv": b"experiment,variable\n"})]) == 3
    lines = capsys.readouterr().out.splitlines()
    assert sum("tolerances.csv" in line and "no column tolerance" in line for line in lines) == 2 * len(FEW)


@pytest.mark.parametrize("source, fault", [("results/default.csv", None), ("default.csv", "results/default.csv is taken")])
def test_a_result_alone_is_held_to_the_default_experiment(unit, fmu_file, capsys, source, fault):
    assert main(["verify", unit({MANIFEST: manifest(related(source)), "results/default.csv": default_result(fmu_file)})]) == 0
    said = capsys.readouterr().out
    assert "default experiment" in said and "1 experiments, 1 passed" in said and "is assumed" in said
    faults = [line for line in said.splitlines() if line.startswith("fault: ")]
    assert len(faults) == (fault is not None) and all(fault in line for line in faults)


def test_a_result_alone_that_differs_fails(unit, fmu_file, capsys):
    result = default_result(fmu_file)
    row = result.splitlines()[7].split(",")
    row[1] = repr(1.01 * float(row[1]))
    changed = result.replace(result.splitlines()[7], ",".join(row))
    assert main(["verify", unit({MANIFEST: manifest(related("results/a.csv")), "results/a.csv": changed})]) == 3
    assert f"left.speed at {float(row[0]):.6g} s is" in capsys.readouterr().out


@pytest.mark.parametrize("changes, parts", [
    ({MANIFEST: None}, [FOLDER, MANIFEST, "no evidence"]),
    ({MANIFEST: manifest()}, [MANIFEST, "no experiment and no result"]),
    ({MANIFEST: b"no XML"}, [MANIFEST, "nothing in it can be read"]),
])
def test_a_unit_without_evidence_is_refused(unit, changes, parts):
    with pytest.raises(DifferentialError) as refused:
        verify(unit(changes))
    assert all(part in str(refused.value) for part in parts), refused.value


def test_parameter_sets_are_valid_by_the_standard_s_schema():
    schema = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "ssp" / "schema" / "SystemStructureParameterValues.xsd")))
    files = sorted((KEPT / "parameters").glob("*.ssv"))
    assert [file.stem for file in files] == sorted(SCENES)
    for file in files:
        schema.assertValid(etree.parse(str(file)))


def test_the_unit_carries_what_the_repository_keeps_and_that_is_small(content):
    kept = {file.relative_to(KEPT).as_posix(): file.read_bytes() for file in KEPT.rglob("*") if file.is_file()}
    assert {f"{FOLDER}/{name}": data for name, data in kept.items()} == {name: data for name, data in content.items() if name.startswith(FOLDER)}
    assert sum(map(len, kept.values())) < LARGEST
    assert all(data.count(b"\n") <= ROWS for name, data in kept.items() if name.startswith("results/"))


@pytest.fixture(scope="module")
def made(fmu_file, tmp_path_factory):
    """What the command makes now."""
    import evidence

    folder = tmp_path_factory.mktemp("evidence") / "made"
    evidence.main(fmu_file, OTHERS, folder)
    return folder


def test_the_repository_keeps_what_the_command_makes(made):
    names = sorted(file.relative_to(made).as_posix() for file in made.rglob("*") if file.is_file())
    assert names == sorted(file.relative_to(KEPT).as_posix() for file in KEPT.rglob("*") if file.is_file())
    for name in names:
        if not name.startswith(("results/", "tolerances")):
            assert (made / name).read_bytes() == (KEPT / name).read_bytes(), f"{name} is out of date; renew it: cargo run --release -- evidence"
    kept, new = ({(row["experiment"], row["variable"]): float(row["tolerance"]) for row in csv.DictReader((folder / "tolerances.csv").open())}
                 for folder in (KEPT, made))
    assert kept.keys() == new.keys()
    for key, tolerance in kept.items():
        assert new[key] == pytest.approx(tolerance, rel=0.5), key
    for experiment in {experiment for experiment, _ in kept}:
        old, now = (np.genfromtxt(folder / "results" / f"{experiment}.csv", delimiter=",", names=True, deletechars="", replace_space=" ")
                    for folder in (KEPT, made))
        assert old.dtype.names == now.dtype.names and np.array_equal(old["time"], now["time"])
        for name in old.dtype.names[1:]:
            assert np.abs(old[name] - now[name]).max() <= kept[experiment, name], (experiment, name)


@pytest.mark.parametrize("name", sorted(SCENES))
def test_results_are_those_of_the_scenes(fmu_file, name):
    """The package's own way to simulate a scene, with its own reader of inputs, gives the results too."""
    # results are those of hosts, which hold inputs between communication points
    with Scene(**(read_scene(SCENES[name]) | {"input_slopes": False}), fmu=fmu_file) as scene:
        scene.stop = min(scene.stop, LONGEST)
        record = scene.run()
    result = np.genfromtxt(KEPT / "results" / f"{name}.csv", delimiter=",", names=True, deletechars="", replace_space=" ")
    allowed = {row["variable"]: float(row["tolerance"]) for row in csv.DictReader((KEPT / "tolerances.csv").open()) if row["experiment"] == name}
    places = np.array([int(np.argmin(np.abs(record["time"] - time))) for time in result["time"]])
    assert np.allclose(record["time"][places], result["time"], rtol=1e-9, atol=1e-12)
    assert sorted(result.dtype.names[1:]) == sorted(scene.outputs) == sorted(allowed)
    for output in scene.outputs:
        assert np.abs(record[output][places] - result[output]).max() <= allowed[output], output
