"""Tables in CSV files: other programs read them, and a record can be an input."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from command_line import command
from bevel_differential import Scene
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


@pytest.fixture(autouse=True)
def scene(folder):
    Path("scene.toml").write_text(SCENE, encoding="utf-8")


def test_a_pattern_is_in_si_and_its_files_have_plain_headers():
    command("pattern study_turning --set scene.gear_contact=tooth --quick --progress none --out found")
    for name in ("pattern", "contacts", "summary", "outline"):
        found = pd.read_csv(f"found/{name}.csv")
        assert len(found) and found.columns[0] == "case"
    # the cone distance of the study's teeth, which are less than 0.1 m from the apex; more than 10 MPa under load
    contacts = pd.read_csv("found/contacts.csv")
    assert contacts["cone"].between(0.01, 0.1).all() and contacts["pressure"].max() > 1e7


def test_a_record_is_read_by_other_programs_and_as_an_input(fmu_file):
    command("run scene.toml --csv out.csv")
    names = ["time", LOAD, SPEED]
    assert list(np.genfromtxt("out.csv", delimiter=",", names=True, deletechars="").dtype.names) == names
    assert list(read_csv("out.csv").dtype.names) == list(pd.read_csv("out.csv").columns) == names
    done = subprocess.run([sys.executable, "-m", "fmpy", "simulate", fmu_file, "--stop-time", "0.004", "--input-file", "out.csv"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    Path("again.toml").write_text(f'{BENCH}[[inputs]]\nfile = "out.csv"\n', encoding="utf-8")
    with Scene.load("scene.toml") as first, Scene.load("again.toml") as again, pytest.warns(match="left.speed: it is an output"):
        Scene.load("again.toml").close()
        # a table is read just after a communication point, 1e-6 of a step later
        assert again.run()[SPEED] == pytest.approx(first.run()[SPEED], rel=1e-6)


def test_description_and_units_are_metadata_of_parquet():
    import pyarrow.parquet as parquet

    command("run scene.toml --csv out.parquet")
    assert "a load that rises; in SI" in command("run scene.toml --csv out.csv").out
    schema = parquet.read_schema("out.parquet")
    assert schema.metadata[b"description"] == b"a load that rises" and schema.field(LOAD).metadata[b"unit"] == b"N.m"
    assert "fmpy cannot read it" in command("run scene.toml --csv out.csv --unit rpm").out


def test_only_numbers_get_decimal_commas(tmp_path):
    with decimal("comma"):
        file = write(tmp_path / "a.csv", ["name", "x", "count"], [("v. 1.5; new", 1.5, 2), ("b", 1e-7, 3)])
        assert localised("a,b\n1.5e3,v.2\n") == "a;b\n1,5e3;v.2\n"
    assert file.read_text(encoding="utf-8") == 'name;x;count\n"v. 1.5; new";1,5;2\nb;1e-07;3\n'
