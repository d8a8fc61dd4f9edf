"""Tables in CSV files: other programs read them, and a record can be an input."""

import csv
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from bevel_differential import Scene
from bevel_differential.answers import about, ask
from bevel_differential.command import main
from bevel_differential.records import decimal, localised, write
from fmpy.util import read_csv

LOAD, SPEED = "left.load_torque", "left.speed"
SCENE = f"""description = "a load that rises"
stop_time = "4 ms"
step = "1 ms"
outputs = ["{LOAD}", "{SPEED}"]
[set]
scene.gear_contact = "ideal"
[[table]]
input = "{LOAD}"
time = ["0 ms", "2.5 ms", "2.5 ms", "4 ms"]
value = [800.0, 840.0, 820.0, 835.0]
"""
BENCH = SCENE.partition("[[table]]")[0]
# commands that write one table, with the quickest scene
COMMANDS = {
    "run": ["run", "{scene}", "--csv", "out.csv"],
    "run of two": ["run", "{scene}", "{other}", "--csv", "out.csv"],
    "sweep": ["sweep", "--scene", "{scene}", "--vary", "right.load_torque=800, 810.5", "--plan", "grid", "--want", SPEED, "--workers", "0",
              "--csv", "out.csv"],
    "variables": ["variables", "load", "--csv", "out.csv"],
    "loads": ["loads", "study_straight", "--stop", "1 ms", "--out", "out.csv"],
    "losses": ["losses", "{scene}", "--set", "scene.carrier_drive=torque", "--torque", "800 N.m", "--speed", "10 rad/s", "--difference", "1 rad/s",
               "--temperature", "353.15 K", "--unseen", "2", "--workers", "0", "--csv", "out.csv"],
    "spectrum": ["spectrum", "{cycle}", "--csv", "out.csv"],
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    (tmp_path / "other.toml").write_text(SCENE.replace("835.0", "836.0"), encoding="utf-8")
    (tmp_path / "cycle.csv").write_text("name,count,duration [s],speed [km/h],torque [N.m],wheel_radius [mm]\nahead,2,1,40,900.5,334\n"
                                        "back,1,1,-10,400,334\n", encoding="utf-8")
    return tmp_path


def written(name, folder, *more):
    """Path of the table of a command."""
    files = {"scene": "scene.toml", "other": "other.toml", "cycle": "cycle.csv"}
    assert main([word.format(**files) for word in COMMANDS[name]] + list(more)) == 0
    return folder / "out.csv"


@pytest.mark.parametrize("name", COMMANDS)
def test_a_table_has_a_plain_header_and_may_have_decimal_commas(name, folder):
    file = written(name, folder)
    rows = list(csv.reader(file.read_text(encoding="utf-8").splitlines()))
    assert not rows[0][0].startswith("#") and len(rows) > 1 and all(len(row) == len(rows[0]) for row in rows)
    found = pd.read_csv(file)
    assert list(found.columns) == rows[0] and not any(" [" in head for head in rows[0] if head != "locking_effect [%]")
    file.unlink()
    commas = pd.read_csv(written(name, folder, "--csv-decimal", "comma"), sep=";", decimal=",")
    assert list(commas.columns) == rows[0]
    # all but the computing time
    numbers = [head for head in found.select_dtypes("number").columns if head != "seconds"]
    assert len(numbers) and np.allclose(commas[numbers].to_numpy(float), found[numbers].to_numpy(float), rtol=1e-12, equal_nan=True)


def test_a_pattern_is_in_si_and_its_files_have_plain_headers(folder):
    assert main(["pattern", "study_turning", "--set", "scene.gear_contact=tooth", "--quick", "--progress", "none", "--out", "found"]) == 0
    for name in ("pattern", "contacts", "summary", "outline"):
        found = pd.read_csv(folder / "found" / f"{name}.csv")
        assert len(found) and found.columns[0] == "case"
    # the cone distance of the study's teeth, which are less than 0.1 m from the apex; more than 10 MPa under load
    contacts = pd.read_csv(folder / "found/contacts.csv")
    assert contacts["cone"].between(0.01, 0.1).all() and contacts["pressure"].max() > 1e7


def test_a_record_is_read_by_other_programs_and_as_an_input(folder, fmu_file):
    file = written("run", folder)
    names = ["time", LOAD, SPEED]
    assert list(np.genfromtxt(file, delimiter=",", names=True, deletechars="").dtype.names) == names
    assert list(read_csv(str(file)).dtype.names) == list(pd.read_csv(file).columns) == names
    done = subprocess.run([sys.executable, "-m", "fmpy", "simulate", str(fmu_file), "--stop-time", "0.004", "--input-file", str(file)],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    (folder / "again.toml").write_text(f'{BENCH}[[inputs]]\nfile = "out.csv"\n', encoding="utf-8")
    with Scene.load("scene.toml") as first, Scene.load("again.toml") as again, pytest.warns(match="left.speed: it is an output"):
        Scene.load("again.toml").close()
        # a table is read just after a communication point, 1e-6 of a step later
        assert again.run()[SPEED] == pytest.approx(first.run()[SPEED], rel=1e-6)


def test_the_library_writes_the_same_file(folder):
    ask({"ask": "run", "of": about("scene.toml"), "out": "own.csv"})
    own, found = (list(csv.reader(open(file, encoding="utf-8"))) for file in ("own.csv", written("run", folder)))
    assert own[0] == found[0] and [[float(cell) for cell in row] for row in own[1:]] == [[float(cell) for cell in row] for row in found[1:]]


def test_description_and_units_are_metadata_of_parquet(folder, capsys):
    import pyarrow.parquet as parquet

    assert main(["run", "scene.toml", "--csv", "out.parquet"]) == main(["run", "scene.toml", "--csv", "out.csv"]) == 0
    schema = parquet.read_schema("out.parquet")
    assert schema.metadata[b"description"] == b"a load that rises" and schema.field(LOAD).metadata[b"unit"] == b"N.m"
    assert "a load that rises; in SI" in capsys.readouterr().out
    assert main(["run", "scene.toml", "--csv", "out.csv", "--unit", "rpm"]) == 0
    assert "fmpy cannot read it" in capsys.readouterr().out


def test_only_numbers_get_decimal_commas(tmp_path):
    with decimal("comma"):
        file = write(tmp_path / "a.csv", ["name", "x", "count"], [("v. 1.5; new", 1.5, 2), ("b", 1e-7, 3)])
        assert localised("a,b\n1.5e3,v.2\n") == "a;b\n1,5e3;v.2\n"
    assert file.read_text(encoding="utf-8") == 'name;x;count\n"v. 1.5; new";1,5;2\nb;1e-07;3\n'
