"""fmpy draws results in this environment, by the command line for users.

Its plot has a panel for each variable, at most 17. By default it uses the first 19 outputs and fails, so the command must name the
outputs to draw."""

import os
import shlex
import subprocess
import sys

DRAWN = ["left.speed", "right.speed", "left.tangential_force"]
# replaces the browser: fetches the page that fmpy serves once
BROWSER = """
import sys, urllib.request
open(sys.argv[1], "wb").write(urllib.request.urlopen(sys.argv[2], timeout=60).read())
"""


def test_fmpy_shows_its_plot_in_the_browser(fmu_file, tmp_path):
    script, page = tmp_path / "browser.py", tmp_path / "page.html"
    script.write_text(BROWSER, encoding="utf-8")
    browser = " ".join(shlex.quote(str(part)) for part in (sys.executable, script, page)) + " %s &"
    command = [sys.executable, "-m", "fmpy", "simulate", fmu_file, "--stop-time", "0.01", "--show-plot",
               "--output-variables", *DRAWN]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300,
                          env={**os.environ, "BROWSER": browser, "PLOTLY_RENDERER": "browser"})
    assert done.returncode == 0, done.stderr
    shown = page.read_text(encoding="utf-8")
    assert "Plotly.newPlot" in shown
    for name in DRAWN:
        assert name in shown, name
