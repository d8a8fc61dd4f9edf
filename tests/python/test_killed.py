"""Commands in separate processes that are killed at ten random times, and two at the same time: each file is the old or the new one.

As a program, `python test_killed.py FOLDER SEED` runs them and prints the results. Answers are cached, so that commands spend their time
on writing."""

import os
import random
import re
import signal
import subprocess
import sys
import threading
import time
import traceback
from pathlib import Path

import pytest
from tqdm import tqdm

from bevel_differential import Scene, answers, style
from bevel_differential.command import main
from bevel_differential.designs import store
from bevel_differential.designs.sweep import sweep

KILLS = 10
# one spring per mesh: a run takes a few milliseconds
LUMPED = {"scene.gear_contact": "lumped", "left.load_torque": 835.0, "right.load_torque": 835.0}
SWEEP = {"vary": {"geometry.backlash": "0.1 mm..0.2 mm:100"}, "plan": "grid", "wants": ["left.speed"], "workers": 0}
OLD = b"old"
FIGURE = style.figure(1.0)


def remembered(function):
    """Function that caches the answer to each question."""
    known = {}

    def answer(question, *_, **__):
        key = repr(question)
        if key not in known:
            known[key] = function(question)
        return known[key]

    return answer


def written(folder):
    """Writes dimensions, curves and a mesh of the gears, and a scene for other hosts."""
    shown, sys.stdout = sys.stdout, open(os.devnull, "w", encoding="utf-8")
    assert main(["geometry", "--stl", "--part", "planet", "--facets", "4", "--out", str(folder / "gears")]) == 0
    assert main(["plan", "study_straight", "--ssv", str(folder / "start.ssv"), "--python", str(folder / "run.py")]) == 0
    sys.stdout = shown
    style.save(FIGURE, folder / "picture.png")


def content(folder, names):
    """Existing files among `names`, with their contents."""
    found = {}
    for name in names:
        try:
            found[name] = (folder / name).read_bytes()
        except FileNotFoundError:
            continue
    return found


def forked(work):
    """Starts a process that does the work and exits."""
    process = os.fork()
    if process:
        return process
    status = 1
    # forked processes share the lock of progress bars: a killed process that holds it would stop all others
    tqdm.set_lock(threading.RLock())
    try:
        work()
        status = 0
    except Exception:
        traceback.print_exc()
    finally:
        os._exit(status)


def killed_after(moment, work):
    """Kills the work after `moment` seconds."""
    process = forked(work)
    time.sleep(moment)
    os.kill(process, signal.SIGKILL)
    status = os.waitpid(process, 0)[1]
    assert os.WIFSIGNALED(status) or status == 0, "the command has failed"


def duration(work):
    """Duration of the work in a separate process, s."""
    begin = time.monotonic()
    assert os.waitpid(forked(work), 0)[1] == 0
    return time.monotonic() - begin


def killed(folder, whole, draw):
    """Kills commands that write files, before, during and after the writing."""
    (folder / "gears").mkdir(parents=True)
    longest, counts = 1.2 * duration(lambda: written(folder)), []
    for _ in range(KILLS):
        for name in whole:
            (folder / name).write_bytes(OLD)
        killed_after(draw.uniform(0.0, longest), lambda: written(folder))
        found = content(folder, whole)
        assert found.keys() == whole.keys() and all(text in (OLD, whole[name]) for name, text in found.items())
        counts.append(sum(text == whole[name] for name, text in found.items()))
    print(f"killed: {counts} of {len(whole)} files are new")


def together(folder, whole):
    """Runs two commands and a reader at the same time."""
    folder.mkdir()

    def often():
        for _ in range(5):
            written(folder)

    left, read = {forked(often), forked(often)}, 0
    while left:
        found = content(folder, whole)
        assert all(text == whole[name] for name, text in found.items())
        read += len(found)
        for process in list(left):
            ended, status = os.waitpid(process, os.WNOHANG)
            if ended:
                assert status == 0, "a command has failed"
                left.remove(process)
    assert content(folder, whole) == whole and not list(folder.rglob(".*"))
    print(f"together: {read} files read")


def resumed(folder, draw):
    """Checks that a killed and resumed sweep, and two sweeps at the same time, have the rows of an uninterrupted one."""
    folder.mkdir()
    # a part for each row
    store.INTERVAL = 0.0

    def swept(name):
        with Scene("lumped", set=LUMPED, outputs=["left.speed"], stop=2e-3, step=1e-3) as scene:
            return sweep(scene, **SWEEP, out=folder / name, resume=True)

    # durations of a whole sweep, and of one without a run
    longest, least = (duration(lambda: swept("whole.parquet")) for _ in range(2))
    whole, parts, counts = swept("whole.parquet"), folder / "killed.parquet.parts", []
    for _ in range(KILLS):
        killed_after(least + draw.uniform(0.0, 1.5 * (longest - least) / KILLS), lambda: swept("killed.parquet"))
        counts.append(len(list(parts.glob("part-*"))))
    last = swept("killed.parquet")
    assert last.digest() == whole.digest() and not parts.exists()
    assert [os.waitpid(process, 0)[1] for process in [forked(lambda: swept("both.parquet")) for _ in range(2)]] == [0, 0]
    assert swept("both.parquet").digest() == whole.digest()
    print(f"sweep: {counts} of {len(whole.table)} rows are kept; {last.new} new ones at last")


def begin(folder, seed):
    """Runs all checks."""
    draw = random.Random(seed)
    # no thread of progress bars, because forks of a process with threads may hang
    tqdm.monitor_interval = 0
    answers.ask = remembered(answers.ask)
    (folder / "whole").mkdir()
    written(folder / "whole")
    names = [file.relative_to(folder / "whole").as_posix() for file in (folder / "whole").rglob("*") if file.is_file()]
    whole = content(folder / "whole", names)
    killed(folder / "killed", whole, draw)
    together(folder / "together", whole)
    resumed(folder / "resumed", draw)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")
def test_killed_commands_and_two_at_the_same_time_leave_whole_files(tmp_path):
    program = subprocess.run([sys.executable, "-W", "ignore", __file__, str(tmp_path), "1"], check=False, capture_output=True, text=True,
                             timeout=300, env={**os.environ, "TMPDIR": str(tmp_path)})
    assert program.returncode == 0, program.stderr
    killed, together, sweep = program.stdout.splitlines()
    # some processes are killed; those that are not were too fast
    counts = [int(count) for count in re.search(r"\[(.*)\]", killed)[1].split(", ")]
    assert len(counts) == 10 and min(counts) < 19 and together.startswith("together: ") and sweep.startswith("sweep: ")


if __name__ == "__main__":
    begin(Path(sys.argv[1]), int(sys.argv[2]))
