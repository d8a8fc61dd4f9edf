"""The program of the laboratory: its commands, usage errors, tables for a terminal, and messages about missing programs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "crates" / "lab"))
import lab  # noqa: E402
from laboratory.terminal import for_terminal  # noqa: E402

MARKDOWN = "| case           | error, µm |\n|----------------|----------:|\n| `turn`         |         2 |\n| straight ahead |       128 |\n"


def run(*words, **variables):
    """A completed run of the program."""
    return subprocess.run([sys.executable, "crates/lab/lab.py", *words], cwd=ROOT, env={**os.environ, **variables}, capture_output=True,
                          encoding="utf-8")


@pytest.mark.parametrize("name", lab.COMMANDS)
def test_every_command_has_a_sentence_and_a_short_run(name):
    command = lab.COMMANDS[name]
    assert command.sentence and "\n" not in command.sentence
    lab.Parser(command).parsed(command.short)
    assert name == lab.everything.NAME or f"\n  {name} " in lab.overview()


@pytest.mark.parametrize("words", [[], ["help"], ["--help"]])
def test_without_a_command_the_overview_is_shown(words):
    done = run(*words)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == lab.overview() + "\n"


def test_help_shows_the_options_of_a_command():
    shown = run("help", "survey").stdout
    assert shown == run("survey", "--help").stdout
    assert "Checks answers of" in shown and "--scenes" in shown


@pytest.mark.parametrize("words, parts", [
    (["survei"], ["'survey'", "lab.py --help)"]),
    (["solids", "--quik"], ["'--quik'", "'--quick'", "lab.py solids --help)"]),
    (["solids", "--quick", "--write"], ["'--write' cannot be used with '--quick'"]),
    (["survey", "--scenes", "0"], ["--scenes", "'0'"]),
    (["fuzz", "--fmi", "4"], ["'4'", "2 to 3"]),
    (["all", "moon"], ["moon is not a command that is run here"]),
])
def test_a_usage_error_is_one_line_with_a_suggestion(words, parts):
    done = run(*words)
    assert done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1
    assert all(part in done.stderr for part in parts), done.stderr


def test_the_last_of_repeated_options_applies():
    values = lab.Parser(lab.COMMANDS["survey"]).parsed(["--write", "--write", "--seed", "1", "--seed", "2"])
    assert values.write and values.seed == 2


def test_words_for_pytest_are_passed_on():
    assert lab.Parser(lab.COMMANDS["test-python"]).parsed(["-k", "random", "--scenes", "9"]).more == ["-k", "random", "--scenes", "9"]


def test_a_page_of_markdown_is_shown_with_aligned_tables():
    shown = for_terminal(f"Before.\n\n{MARKDOWN}\nAfter.\n")
    assert shown == ("Before.\n\ncase            error, µm\n-------------------------\nturn                    2\nstraight ahead        128\n"
                     "\nAfter.\n")


def test_a_missing_page_is_reported_with_the_command_that_builds_it():
    done = run("test-page", "target/no_such_page.html")
    assert done.returncode == 1
    assert done.stderr == "error: target/no_such_page.html is not there; make it: cargo run --release -- page\n"


@pytest.mark.skipif(sys.platform == "win32", reason="no programs without an ending on Windows")
def test_a_missing_node_or_browser_is_reported_with_what_to_install(tmp_path):
    page, node = tmp_path / "page.html", tmp_path / "path" / "node"
    page.touch()
    node.parent.mkdir()
    found = {"PATH": str(node.parent), "CHROME": ""}
    assert run("test-page", page, **found).stderr == "error: node is not installed: apt install nodejs (or see nodejs.org)\n"
    node.write_text("#!/bin/sh\n", encoding="ascii")
    node.chmod(0o755)
    assert run("test-page", page, **found).stderr == "error: Chromium is not installed: apt install chromium, or name one by CHROME\n"
    named = run("test-page", page, **{**found, "CHROME": "/no/such/browser"}).stderr
    assert named == "error: CHROME = /no/such/browser: this program does not run; name a Chromium\n"
