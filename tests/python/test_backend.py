"""Pictures in a process whose environment names a backend of matplotlib, as processes inherit it from a notebook."""

import os
import subprocess
import sys

import pytest

# a notebook's backend whose package is missing, and a name that matplotlib refuses while it is imported
MISSING, REFUSED = "module://no_notebook.backend_inline", "Qt4Agg"
DRAWING = """
import os
from bevel_differential import Differential
with Differential() as straight:
    straight.plot(straight.run(outputs=["left.speed"], stop=0.001), file="a.png")
import matplotlib
print(matplotlib.rcParams["backend"], os.environ.get("MPLBACKEND"))
"""


def process(words, backend, folder):
    plain = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    return subprocess.run([sys.executable, *words], env={**plain, "MPLBACKEND": backend}, cwd=folder, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("line, picture, backend", [
    ("run clunk --stop 1ms --plot a.png", "a.png", MISSING), ("pattern study_turning --quick --out p", "p/contact_lines.png", REFUSED),
    ("report clunk --quick --stop 1ms --out r.html", "r.html", REFUSED)])
def test_the_program_draws_whatever_backend_it_inherits(line, picture, backend, tmp_path):
    done = process(["-m", "bevel_differential", *line.split()], backend, tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / picture).stat().st_size > 1000


@pytest.mark.parametrize("backend, used", [("svg", "svg"), (MISSING, MISSING), (REFUSED, "Agg")])
def test_the_package_keeps_the_user_s_backend_if_it_can_be_imported(backend, used, tmp_path):
    done = process(["-W", "ignore", "-c", DRAWING], backend, tmp_path)
    assert done.returncode == 0, done.stderr
    shown, inherited = done.stdout.split()
    assert shown.lower() == used.lower() and inherited == backend
    assert (tmp_path / "a.png").is_file()
