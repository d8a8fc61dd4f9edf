"""Files of test benches: columns named by the scene, spreadsheets, speeds of the vehicle, and the template of a duty cycle."""

import sys

import numpy as np
import openpyxl
import pytest
from command_line import command
from bevel_differential import Scene, spreadsheet
from bevel_differential.csv_table import lines_of
from bevel_differential.spectrum import spectrum
from refusals import refused

SCENE = """description = "measured"
stop_time = "20 ms"
step = "1 ms"
outputs = ["left.load_torque", "carrier.speed_command"]
[set]
scene.gear_contact = "ideal"
[[inputs]]
file = "{file}"
columns = {{ "time" = "t [ms]", left.load_torque = "M_links [Nm]", "speed" = "v" }}
wheel_radius = "{radius}"
"""
HEAD = ["Notiz", "t [ms]", "v [km/h]", "M_links [Nm]", "M_rechts [Nm]"]
ROWS = [["kalt", 0, 36, 800.5, "x"], [None, 10, 72.5, 810.25, None], ["1,5 bar", 20, 36, 805, 3]]


def write_csv(file, sign=1.0):
    cells = [[str(cell).replace(".", ",") if isinstance(cell, float) else "" if cell is None else str(cell) for cell in row] for row in ROWS]
    file.write_text("\n".join(";".join(row) for row in [HEAD, *cells]), encoding="utf-8")


def write_xlsx(file):
    book = openpyxl.Workbook()
    for row in [HEAD, *ROWS]:
        book.active.append(row)
    book.create_sheet("other").append(["not", "read"])
    book.save(file)


@pytest.mark.parametrize("file", ["bench.csv", "bench.xlsx"])
def test_a_scene_reads_the_columns_that_it_names(file, tmp_path):
    {"csv": write_csv, "xlsx": write_xlsx}[file.partition(".")[2]](tmp_path / file)
    (tmp_path / "scene.toml").write_text(SCENE.format(file=file, radius="500 mm"), encoding="utf-8")
    with Scene.load(tmp_path / "scene.toml") as scene:
        tables = {name: (list(times), list(values)) for name, times, values, _ in scene.tables}
        record = scene.run()
    times = [0.0, 0.01, 0.02]
    assert tables["left.load_torque"] == (times, [800.5, 810.25, 805.0])
    # v/r with v in km/h
    assert tables["carrier.speed_command"] == (times, pytest.approx([20.0, 72.5 / 3.6 / 0.5, 20.0], rel=1e-15))
    assert record["carrier.speed_command"][10] == pytest.approx(72.5 / 1.8, rel=1e-6)


def test_commands_of_the_library_read_spreadsheets(folder):
    write_xlsx(folder / "bench.xlsx")
    (folder / "scene.toml").write_text(SCENE.format(file="bench.xlsx", radius="500 mm"), encoding="utf-8")
    command("plan scene.toml --python script.py")
    assert "810.25" in (folder / "script.py").read_text(encoding="utf-8")


def test_without_a_reader_the_package_is_named(tmp_path, monkeypatch):
    write_xlsx(tmp_path / "bench.xlsx")
    (tmp_path / "scene.toml").write_text(SCENE.format(file="bench.xlsx", radius="500 mm"), encoding="utf-8")
    for module in ("openpyxl", "python_calamine"):
        monkeypatch.setitem(sys.modules, module, None)
    with refused("bench.xlsx: a spreadsheet needs the package openpyxl or python-calamine"):
        Scene.load(tmp_path / "scene.toml")


def test_a_broken_spreadsheet_is_named(tmp_path):
    (tmp_path / "bench.xlsx").write_bytes(b"PK\x03\x04 broken")
    with refused("bench.xlsx: it cannot be read as a spreadsheet"):
        spreadsheet.csv_text(tmp_path / "bench.xlsx")


def test_a_spreadsheet_has_the_cells_of_a_csv_file(tmp_path):
    write_xlsx(tmp_path / "bench.xlsx")
    write_csv(tmp_path / "bench.csv")
    texts = ["Notiz", "M_rechts"]
    assert lines_of(tmp_path / "bench.xlsx", texts=texts) == lines_of(tmp_path / "bench.csv", texts=texts)


def test_the_template_of_a_duty_cycle_comes_with_the_examples_and_gives_a_life(folder):
    command("examples")
    template = folder / "examples/design/duty_cycle_template.csv"
    head = next(line for line in template.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    assert all(word in head for word in ("torque [N.m]", "speed [km/h]", "duration [h]", "turn_radius [m]"))
    result = spectrum(template)
    assert result.hours == pytest.approx(242.0) and np.isfinite(result.life_hours) and result.damage["damage.planet_flank"] > 0.0
