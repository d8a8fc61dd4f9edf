"""Letters that the encoding of a pipe or file lacks are replaced by similar ones."""

import io
import sys

import pytest
from bevel_differential.letters import replaced


@pytest.mark.parametrize("encoding, printed", [("ascii", "delta_a -0.1 um, 2 x 3 N.m, >= 4 mm2, h_0, ?"),
                                               ("cp932", "δ_a －0.1 um, 2 × 3 N.m, >= 4 mm2, h_0, 漢"),
                                               ("cp1252", "delta_a -0.1 µm, 2 × 3 N·m, >= 4 mm², h_0, ?"),
                                               ("utf-8", "δ_a −0.1 µm, 2 × 3 N·m, ≥ 4 mm², h_₀, 漢")])
def test_missing_letters_become_similar_ones(encoding, printed, monkeypatch):
    output = io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="strict")
    monkeypatch.setattr(sys, "stdout", output)
    with replaced():
        print("δ_a −0.1 µm, 2 × 3 N·m, ≥ 4 mm², h_₀, 漢", end="", flush=True)
    assert output.buffer.getvalue().decode(encoding) == printed
