"""The same bits in Chromium, in node and in the native FMU: nothing is rounded, no tolerance."""

import base64
import json
import lzma
import re
import subprocess

import numpy as np
import pytest
from bevel_differential import Scene

from conftest import named_file
from live import HERE, address_of

WEB = HERE.parents[1] / "fmu-build" / "page" / "web"
SCENES = ["study_straight", "study_turning", "torque_bias", "clunk"]
# the page records the first of them for its picture, and the last because they are drawn
OUTPUTS = ["left.angle", "left.speed", "right.speed", "carrier.speed", "planet[1].spin_angle", "planet[1].left_normal_force",
           "solver.energy_residual", "left.shaft_torque", "right.shaft_torque", "left.normal_force"]


def bits(numbers):
    return np.ascontiguousarray(numbers, np.float64).view(np.uint64)


def library_of(page_file):
    """The library in WebAssembly that is packed into the page."""
    packed = re.search(r'<script[^>]*id="library"[^>]*>([^<]*)<', page_file.read_text(encoding="utf-8"))[1]
    return lzma.decompress(base64.b64decode(packed))


@pytest.fixture(scope="module")
def in_chromium(shared):
    """{scene: ({output: bits}, scene as the page gives it to its worker)}."""
    records = {}
    for name in SCENES:
        answer = shared.go(address_of({"scene": name, "show": " ".join(OUTPUTS[-3:])}))
        assert "over" in answer, f"{name}: {answer}"
        record = shared.record(OUTPUTS)
        records[name] = {output: bits(record[output]) for output in ["time", *OUTPUTS]}, shared.ask("ear.asked.scene")
    return records


@pytest.fixture(scope="module")
def in_node(in_chromium, fmu, page_file, tmp_path_factory):
    """{scene: {output: bits}}."""
    folder = tmp_path_factory.mktemp("node")
    (folder / "library.wasm").write_bytes(library_of(page_file))
    references = [fmu.variable(output).reference for output in OUTPUTS]
    scenes = {name: {"scene": scene, "references": references} for name, (_, scene) in in_chromium.items()}
    (folder / "scenes.json").write_text(json.dumps(scenes))
    files = [WEB, folder / "library.wasm", folder / "scenes.json", folder / "records.json"]
    ran = subprocess.run([named_file("NODE"), HERE / "runner.mjs", *files], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    rows = json.loads((folder / "records.json").read_text())
    columns = {name: np.array([[int(number, 16) for number in row] for row in rows[name]], np.uint64).T for name in SCENES}
    return {name: dict(zip(["time", *OUTPUTS], columns[name])) for name in SCENES}


@pytest.mark.parametrize("scene", SCENES)
def test_chromium_node_and_the_native_fmu_give_the_same_bits(scene, in_chromium, in_node, fmu, found):
    record = Scene.load(scene).run(OUTPUTS)
    native = {name: bits(record[name]) for name in ["time", *OUTPUTS]}
    chromium, node = in_chromium[scene][0], in_node[scene]
    for name, numbers in native.items():
        for where, other in (("Chromium", chromium[name]), ("node", node[name])):
            assert other.shape == numbers.shape, f"{name} in {where}"
            different = np.flatnonzero(other != numbers)
            assert different.size == 0, f"{name} in {where}: {different.size} of {numbers.size} differ, from {different[:1]}"
    # values that never change would be no proof
    moving = sum(np.unique(numbers).size > 1 for numbers in native.values())
    assert moving > len(OUTPUTS) / 2
    found(f"{scene} {len(record)} × {len(OUTPUTS)}")
