"""The page's own programs in node: its library in WebAssembly, and the code that runs a scene."""

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
    """The library in WebAssembly that is packed into the page."""
    packed = re.search(r'<script[^>]*id="library"[^>]*>([^<]*)<', page_file.read_text(encoding="utf-8"))[1]
    return lzma.decompress(base64.b64decode(packed))


def run_in_node(page_file, folder, scenes):
    """{scene: columns of bits}: time, then the outputs. `scenes`: {name: {scene, references}} as in runner.mjs; `folder` is for files."""
    (folder / "library.wasm").write_bytes(library_of(page_file))
    (folder / "scenes.json").write_text(json.dumps(scenes))
    files = [WEB, folder / "library.wasm", folder / "scenes.json", folder / "records.json"]
    ran = subprocess.run([named_file("NODE"), HERE / "runner.mjs", *files], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    rows = json.loads((folder / "records.json").read_text())
    return {name: np.array([[int(number, 16) for number in row] for row in rows[name]], np.uint64).T for name in scenes}
