"""Commands that are killed at ten random times, and two at the same time (killed.py): each file is the old or the new one."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")
def test_killed_commands_and_two_at_the_same_time_leave_whole_files(fmu_file, tmp_path):
    program = subprocess.run([sys.executable, "-W", "ignore", str(Path(__file__).with_name("killed.py")), str(tmp_path), "1"], check=False,
                             capture_output=True, text=True, timeout=300, env={**os.environ, "BEVEL_DIFFERENTIAL_FMU": fmu_file,
                                                                              "TMPDIR": str(tmp_path)})
    assert program.returncode == 0, program.stderr
    killed, together, sweep = program.stdout.splitlines()
    # some processes are killed; those that are not were too fast
    counts = [int(count) for count in re.search(r"\[(.*)\]", killed)[1].split(", ")]
    assert len(counts) == 10 and min(counts) < 19 and together.startswith("together: ") and sweep.startswith("sweep: ")
