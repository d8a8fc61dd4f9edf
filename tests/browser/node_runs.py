"""Runs scenes in node with the programs of the page: its WebAssembly library and its run loop."""

import base64
import json
import lzma
import re
import subprocess

import numpy as np

from conftest import named_file
from live import HERE

WEB = HERE.parents[1] / "fmu-build" / "page" / "web"


def library_of(page_file):
    """Unpacks the WebAssembly library of the page."""
    packed = re.search(r'<script[^>]*id="library"[^>]*>([^<]*)<', page_file.read_text(encoding="utf-8"))[1]
    return lzma.decompress(base64.b64decode(packed))


def run_in_node(page_file, folder, scenes):
    """Returns {name: columns of bits}, time first and then the outputs. `scenes` is {name: {scene, references}} as in runner.mjs.
    Temporary files are written to `folder`."""
    (folder / "library.wasm").write_bytes(library_of(page_file))
    (folder / "scenes.json").write_text(json.dumps(scenes))
    files = [WEB, folder / "library.wasm", folder / "scenes.json", folder / "records.json"]
    ran = subprocess.run([named_file("NODE"), HERE / "runner.mjs", *files], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    rows = json.loads((folder / "records.json").read_text())
    return {name: np.array([[int(number, 16) for number in row] for row in rows[name]], np.uint64).T for name in scenes}
