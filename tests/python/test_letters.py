"""Commands print to pipes and files of any encoding; letters that it lacks are replaced."""

import io
import sys

import pytest
from bevel_differential.command import COMMANDS, main
from bevel_differential.letters import replaced

ENCODINGS = ["ascii", "cp1252", "cp932"]
# short commands whose output has formulas, units and signs
WORDS = [["geometry", "--out", "gears"], ["plan", "clunk"], ["plan"], ["variables", "half_shaft"], ["run", "clunk", "--stop", "1 ms"],
         ["run", "no_such_scene_Ω"], *([name, "--help"] for name in COMMANDS)]


@pytest.fixture
def pipe(monkeypatch):
    """Replaces standard output and standard error by files in an encoding, and returns them."""
    def opened(encoding):
        streams = [io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="strict") for _ in range(2)]
        for name, stream in zip(("stdout", "stderr"), streams):
            monkeypatch.setattr(sys, name, stream)
        return streams
    return opened


@pytest.mark.parametrize("words", WORDS, ids=" ".join)
def test_a_command_prints_in_every_encoding(words, pipe, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for encoding in ENCODINGS if words[0] == "geometry" else ENCODINGS[:1]:
        output, errors = pipe(encoding)
        status = main(words)
        assert status == (2 if words[1:] == ["no_such_scene_Ω"] else 0)
        assert (output.buffer if status == 0 else errors.buffer).getvalue()
        # a caller of `main` keeps its streams
        assert output.errors == errors.errors == "strict"


@pytest.mark.parametrize("encoding, printed", [("ascii", "delta_a -0.1 um, 2 x 3 N.m, >= 4 mm2, h_0, ?"), ("cp1252", "delta_a -0.1 µm, 2 × 3 N·m, >= 4 mm², h_0, ?"),
                                               ("utf-8", "δ_a −0.1 µm, 2 × 3 N·m, ≥ 4 mm², h_₀, 漢")])
def test_missing_letters_become_similar_ones(encoding, printed, pipe):
    output, _ = pipe(encoding)
    with replaced():
        print("δ_a −0.1 µm, 2 × 3 N·m, ≥ 4 mm², h_₀, 漢", end="", flush=True)
    assert output.buffer.getvalue().decode(encoding) == printed
