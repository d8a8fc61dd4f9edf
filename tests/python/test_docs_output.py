"""Commands, snippets and files of the pages run as printed, and the outputs on a page equal their output to the digit.

Only times that depend on the machine may differ. Lines `...` of a page stand for any lines, and a page may omit warnings.
With `RENEW=1` in the environment, the present outputs are written into the pages, except for these times."""

import difflib
import io
import os
import re
import runpy
import shutil
import subprocess
import sys
import textwrap
import webbrowser
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from bevel_differential import command
from bevel_differential.command import page as page_command
from documents import ROOT, blocks, commands, printed, saved
from command_line import without_warnings

# values that depend on the machine
TIME = re.compile(r"\b[\d.e+-]+(?=\s+x\s+real\s+time)|(?<=The start takes )[\d.e+-]+ of the [\d.e+-]+(?= ms of a run)")
# longest line of a page, and the length at which longer lines are wrapped
WIDEST, WIDTH = 160, 120
GAP = re.compile(r"^ *\.\.\.\n", re.MULTILINE)
# options that make a command quick, if no page shows its output
QUICKER = {
    "optimise": ["--quick", "--population", "16", "--generations", "1"],
    "tolerance": ["--runs", "8", "--no-indices", "--workers", "0"],
    "pattern": ["--quick"],
    "sweep": ["--runs", "4"],
    "losses": ["--torque", "1000 N.m", "--speed", "10 rad/s", "--difference", "1 rad/s", "--temperature", "80 degC", "--unseen", "4"],
    "bench": ["breakaway"],
    "report": ["--quick"],
}
# file contents on pages that do not name the file, by a word that they contain: the name, and the command that reads the file
FILES = {
    "stop_time": ("scene.toml", ["run"]),
    "objectives": ("problem.toml", ["optimise"]),
    "[factors]": ("tolerances.toml", ["tolerance"]),
    "plan =": ("plan.toml", ["sweep", "--plan-file"]),
    "name,count": ("events.csv", ["spectrum"]),
    "time [s]": ("cycle.csv", None),
}
SHOWN = {}
for source, block in printed():
    SHOWN.setdefault(source, []).append(block)
COMMANDS = [one for one in commands("bevel-differential") if not one.words[1].isupper()]
OF_FMPY = commands("target/python/bin/fmpy info")
# one run of each command in a separate process, which shows that the command does not depend on others; `page` opens a browser
ALONE = list({one.words[1]: one for one in reversed(COMMANDS) if one.words[1] != "page"}.values())


@pytest.fixture
def reader(fmu_file, tmp_path, monkeypatch):
    """reader(page): folder, now the current one, with all that a reader of the page has: an FMU, examples, the scenes of
    docs/your-car.md and the files on the page."""

    def prepared(page):
        for name in ("design", "four_wheel_drive"):
            shutil.copytree(ROOT / "examples" / name, tmp_path / "examples" / name)
        (tmp_path / "target").mkdir()
        (tmp_path / "target" / "fmu").symlink_to(Path(fmu_file).resolve().parent)
        for name, text in (saved("docs/your-car.md") | saved(page)).items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        monkeypatch.setenv("MPLBACKEND", "Agg")
        # only a build creates this file
        monkeypatch.setattr(page_command, "page_file", lambda: tmp_path / "page.html")
        monkeypatch.setattr(webbrowser, "open", lambda address: True)
        monkeypatch.chdir(tmp_path)
        return tmp_path

    return prepared


def file_of(block):
    """Name of the file that a block of a page shows, and words of the command that reads it."""
    return next(found for word, found in FILES.items() if word in block.text)


def called(words, alone=False):
    """Exit status of the command with these words, and its output in a terminal."""
    if alone:
        done = subprocess.run([sys.executable, "-u", "-m", "bevel_differential", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, encoding="utf-8", timeout=300, check=False)
        return done.returncode, done.stdout
    said = io.StringIO()
    with redirect_stdout(said), redirect_stderr(said):
        return command.main(words), said.getvalue()


def plain(text, wrapped):
    """Text without parts that may differ: times, and line breaks if a page wraps lines."""
    text = TIME.sub("(time)", text)
    return " ".join(text.split()) if wrapped else text.strip("\n")


def shows(block, said):
    """True if the block shows the text `said`."""
    wrapped = TIME.search(block) or any(len(line) > WIDEST for line in said.splitlines())
    parts = GAP.split(block)
    return re.fullmatch(r"[\s\S]*?".join(re.escape(plain(part, wrapped)) for part in parts), plain(said, wrapped)) is not None


def now(block, said):
    """Block with the present output. For an excerpt, these are the lines most similar to its own lines, in their order."""
    lines = said.strip("\n").splitlines()
    chosen, place = lines, 0
    if GAP.search(block):
        chosen = []
        for line in block.splitlines():
            if GAP.match(f"{line}\n"):
                chosen.append("...")
                continue
            nearest = difflib.get_close_matches(line, lines[place:], n=1, cutoff=0.0)
            if not nearest:
                break
            found = lines.index(nearest[0], place)
            if found > place and chosen[-1:] != ["..."]:
                chosen.append("...")
            chosen.append(lines[found])
            place = found + 1
        if place < len(lines) and chosen[-1] != "...":
            chosen.append("...")
    fitting = (textwrap.wrap(line, WIDTH, break_on_hyphens=False) if len(line) > WIDEST else [line] for line in chosen)
    renewed = "".join(f"{part}\n" for parts in fitting for part in parts)
    times = TIME.findall(block)
    # this machine may be another one, or busy
    return TIME.sub(lambda _: times.pop(0), renewed) if len(times) == len(TIME.findall(renewed)) else renewed


def check(source, said):
    """Checks all blocks that show the output of a command or snippet. With RENEW=1, it updates them."""
    for shown in SHOWN.get(source, []):
        heard = said if "warning: " in shown.text else without_warnings(said)
        if shows(shown.text, heard):
            continue
        renewed = now(shown.text, heard)
        can_be_renewed = os.environ.get("RENEW") and shows(renewed, heard)
        assert can_be_renewed, f"{shown.page} shows\n{shown.text}\nand printed is (RENEW=1 renews the page)\n{renewed}"
        page = ROOT / shown.page
        text = page.read_text(encoding="utf-8")
        page.write_text(text.replace(f"```text\n{shown.text}```", f"```text\n{renewed}```"), encoding="utf-8")


@pytest.mark.parametrize("shown", COMMANDS, ids=str)
def test_a_command_runs_and_prints_what_its_page_shows(shown, reader):
    reader(shown.page)
    words = [*shown.words[1:], *([] if shown in SHOWN else QUICKER.get(shown.words[1], []))]
    status, said = called(words, shown in ALONE)
    check(shown, said)
    # a page may show a refusal, and a quick search may find nothing
    assert status == 0 or shown in SHOWN or "no feasible design among" in said, said


@pytest.mark.parametrize("shown", OF_FMPY, ids=str)
def test_fmpy_prints_what_the_page_shows(shown, reader):
    reader(shown.page)
    done = subprocess.run([sys.executable, "-m", "fmpy", *shown.words[1:]], capture_output=True, text=True, check=True)
    check(shown, done.stdout)


# another test runs the snippet that reads a map
@pytest.mark.parametrize("snippet", [snippet for snippet in blocks("python") if "LossMap" not in snippet.text], ids=str)
def test_a_snippet_runs_and_prints_what_its_page_shows(snippet, reader):
    script = reader(snippet.page) / "snippet.py"
    script.write_text(snippet.text, encoding="utf-8")
    with redirect_stdout(io.StringIO()) as said:
        runpy.run_path(str(script), run_name="__main__")
    check(snippet, said.getvalue())


@pytest.mark.parametrize("shown", blocks("toml", "csv"), ids=str)
def test_a_file_of_a_page_is_understood_as_it_is_printed(shown, reader):
    folder = reader(shown.page)
    if shown.text in saved(shown.page).values():
        # a command of the page names the file
        return
    name, words = file_of(shown)
    with chdir(folder / "examples" / "design"):
        for other in blocks("toml", "csv"):
            if other.page == shown.page and other.text not in saved(shown.page).values():
                Path(file_of(other)[0]).write_text(other.text, encoding="utf-8")
        if words:
            status, said = called([*words, name, *QUICKER.get(words[0], [])])
            assert status == 0, said


def test_every_output_on_a_page_is_compared():
    assert not [str(source) for source in SHOWN if source not in [*COMMANDS, *OF_FMPY, *blocks("python")]]


def test_outputs_are_compared_by_their_digits_but_not_by_their_times():
    said = "force 12.5 N\n\nerror 1.0 %; 50 x real time; more\nends\n"
    assert shows("force 12.5 N\n\nerror 1.0 %; 7.25 x real time; more\nends\n", said)
    assert shows("...\nerror 1.0 %; 7.25 x real\ntime; more\n...\n", said)
    assert not shows("force 12.6 N\n\nerror 1.0 %; 50 x real time; more\nends\n", said)
    assert not shows("force 12.5 N\n\nerror 1.0 %; 50 x real time; more\n", said)
    assert not shows("force 12.5 N\nends\n", said)
    assert now("force 9 N\n...\nends\n", said) == "force 12.5 N\n...\nends\n"
    assert now("...\nends\nforce 9 N\n", said) == "...\nends\n"
    assert now("...\nforce 9 N\nends\n", said) == "...\nforce 12.5 N\n...\nends\n"
    assert now("...\nerror 2.0 %; 7.25 x real time; more\n...\n", said) == "...\nerror 1.0 %; 7.25 x real time; more\n...\n"
