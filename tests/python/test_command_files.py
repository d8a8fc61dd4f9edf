"""Files that commands write and read: unknown kinds are refused before any work."""

import argparse
import importlib
import zipfile

import pytest

from bevel_differential import DifferentialError, Scene
from bevel_differential.command import COMMANDS, PACKAGE, WRONG, main
from bevel_differential.instance import Instance
from bevel_differential.output_file import ENDINGS, checked
from bevel_differential.spectrum import spectrum
from refusals import refused

# required arguments by command
NEEDED = {"accuracy": ["study_turning", "--within", "1%"], "coupling": ["study_turning", "--host", "left:k=1,c=1"],
          "loads": ["study_turning"], "losses": ["torque_bias"],
          "optimise": ["problem.toml"], "plan": ["study_turning"], "report": ["study_turning"], "run": ["study_turning"], "spectrum": ["cycle.csv"],
          "sweep": ["--scene", "study_turning"], "tolerance": ["tolerances.toml"]}
# options for files to read
INPUTS = {"--fmu", "--scene", "--plan-file"}


@pytest.fixture(autouse=True)
def with_fmu(fmu_file, monkeypatch):
    monkeypatch.setenv("BEVEL_DIFFERENTIAL_FMU", fmu_file)


def options():
    """Pairs (command, option) of all options for a file to write."""
    found = []
    for name, (place, *_) in COMMANDS.items():
        parser = argparse.ArgumentParser()
        importlib.import_module(place, PACKAGE).add_arguments(parser)
        found += [(name, action.option_strings[0]) for action in parser._actions if action.option_strings and action.metavar
                  and "FILE" in action.metavar and action.option_strings[0] not in INPUTS]
    return found


@pytest.mark.parametrize("command, option", options(), ids=" ".join)
def test_every_option_that_names_a_file_refuses_an_unknown_ending_before_any_work(command, option, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(Instance, "start", lambda *_: pytest.fail("it works"))
    monkeypatch.chdir(tmp_path)
    assert main([command, *NEEDED.get(command, []), option, "x.xlsx"]) == WRONG
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"argument {option}: x.xlsx: " in said
    kind = next(kind for kind in ENDINGS if f"x.xlsx: a {kind} ends with" in said)
    assert all(ending in said for ending in ENDINGS[kind])
    assert not list(tmp_path.iterdir())


def test_there_is_an_option_of_each_kind():
    assert {("run", "--csv"), ("run", "--plot"), ("loads", "--out"), ("plan", "--ssv"), ("losses", "--simulink"),
            ("report", "--out"), ("sweep", "--out"), ("accuracy", "--write"), ("spectrum", "--csv")} <= set(options())


@pytest.mark.parametrize("kind", ENDINGS)
def test_an_ending_counts_in_capitals_as_well_and_the_message_names_a_file(kind, tmp_path):
    for ending in ENDINGS[kind]:
        assert checked(tmp_path / f"a{ending.upper()}", kind) == tmp_path / f"a{ending.upper()}"
    for name in ("a", "a.xlsx"):
        with pytest.raises(DifferentialError, match=rf"ends with .*; name it a\{ENDINGS[kind][0]}$"):
            checked(tmp_path / name, kind)


def test_the_package_refuses_unknown_endings_too(fmu_file, tmp_path):
    with Scene.load("study_turning", fmu_file, "2 ms") as scene:
        record = scene.run()
        for write in (scene.to_csv, scene.to_parquet, scene.plot):
            with refused("a.xlsx: a  …  ends with"):
                write(record, tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())


@pytest.fixture
def spreadsheet(tmp_path):
    """File in the form of spreadsheet programs."""
    file = tmp_path / "table.xlsx"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", "\u00e9".join(map(str, range(1000))))
    return file


def test_a_spreadsheet_is_named_as_such_where_a_table_is_read(spreadsheet, fmu_file, tmp_path):
    with refused("table.xlsx … spreadsheet … save it as CSV"):
        spectrum(spreadsheet, fmu=fmu_file)
    scene = tmp_path / "scene.toml"
    scene.write_text('description = "driven"\nstop_time = 0.01\nstep = 0.001\noutputs = ["left.speed"]\n[[inputs]]\nfile = "table.xlsx"\n')
    with refused("table.xlsx:  … spreadsheet … save it as CSV"):
        Scene.load(scene, fmu_file)


@pytest.mark.parametrize("line", ["run", "plan", "report", "pattern", "loads --out a.csv", "tolerance", "optimise", "sweep --plan-file"])
def test_a_file_that_is_not_toml_is_wrong_use_and_named(line, spreadsheet, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert main([*line.split(), str(spreadsheet)]) == WRONG
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "table.xlsx" in said and "TOML" in said
