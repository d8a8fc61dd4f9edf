"""Files that commands write and read: unknown kinds are refused."""

import zipfile

import pytest
from command_line import command

from bevel_differential import DifferentialError, Scene
from bevel_differential.command import WRONG
from bevel_differential.output_file import ENDINGS, checked
from bevel_differential.spectrum import spectrum
from refusals import refused


@pytest.mark.parametrize("kind", ENDINGS)
def test_an_ending_counts_in_capitals_as_well_and_the_message_names_a_file(kind, tmp_path):
    for ending in ENDINGS[kind]:
        assert checked(tmp_path / f"a{ending.upper()}", kind) == tmp_path / f"a{ending.upper()}"
    for name in ("a", "a.xlsx"):
        with pytest.raises(DifferentialError, match=rf"ends with .*; name it a\{ENDINGS[kind][0]}$"):
            checked(tmp_path / name, kind)


def test_the_package_refuses_unknown_endings_too(tmp_path):
    with Scene.load("study_turning") as scene:
        record = scene.run(stop="2 ms")
        for write in (scene.to_csv, scene.to_parquet, scene.plot):
            with refused("a.xlsx: a … ends with"):
                write(record, tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())


@pytest.fixture
def spreadsheet(tmp_path):
    """File in the form of spreadsheet programs."""
    file = tmp_path / "table.xlsx"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", "\u00e9".join(map(str, range(1000))))
    return file


def test_a_spreadsheet_is_named_as_such_where_a_table_is_read(spreadsheet, tmp_path):
    with refused("table.xlsx … spreadsheet … save it as CSV"):
        spectrum(spreadsheet)
    scene = tmp_path / "scene.toml"
    scene.write_text('description = "driven"\nstop_time = 0.01\nstep = 0.001\noutputs = ["left.speed"]\n[[inputs]]\nfile = "table.xlsx"\n')
    with refused("table.xlsx: … spreadsheet … save it as CSV"):
        Scene.load(scene)


@pytest.mark.parametrize("line", ["run", "plan", "report", "pattern", "loads --out a.csv", "tolerance", "optimise", "sweep --plan-file"])
def test_a_file_that_is_not_toml_is_wrong_use_and_named(line, spreadsheet, folder):
    [said] = command(f"{line} {spreadsheet}", WRONG).err.splitlines()
    assert "table.xlsx" in said and "TOML" in said
