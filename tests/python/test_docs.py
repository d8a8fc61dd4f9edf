"""Pages for readers: links have targets, commands of the builder are known, and long texts are limited."""

import re
import sys

import pytest
from documents import FOR_USERS, MARKED, PAGES, ROOT, anchors, commands, links

sys.path.append(str(ROOT / "crates" / "lab"))
import lab  # noqa: E402

# of the pages for users: how many, and their words without generated tables; lines of the README; letters of a row of a table
MOST_PAGES, WORDS, LINES, WIDEST = 12, 22_000, 120, 160


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_leads_somewhere(page):
    for address in links(page):
        file, _, anchor = address.partition("#")
        there = (page.parent / file).resolve() if file else page
        assert there.exists(), address
        assert not anchor or there.suffix != ".md" or anchor in anchors(there), address


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_tables_fit_a_page(page):
    wide = [line for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("|") and len(line) > WIDEST]
    assert not wide, wide[0]


def test_the_pages_for_users_are_short():
    assert len(FOR_USERS) <= MOST_PAGES
    texts = [MARKED.sub("", page.read_text(encoding="utf-8")) for page in FOR_USERS]
    assert sum(len(text.split()) for text in texts) <= WORDS
    assert len(PAGES[0].read_text(encoding="utf-8").splitlines()) <= LINES


def test_the_readme_begins_with_the_picture_and_the_commands_that_set_everything_up():
    begin, _, rest = PAGES[0].read_text(encoding="utf-8").partition("## Install")
    for command_line in ("cargo run --release", "cargo test --release"):
        assert re.search(rf"^{command_line} +# (\d+ to )?\d+ minutes$", begin, re.MULTILINE)
        assert f"| `{command_line}` |" not in rest
    assert "figures/differential.png" in begin


@pytest.mark.parametrize("shown", commands("cargo run"), ids=str)
def test_a_command_of_the_builder_is_there(shown):
    words = list(shown.words)
    given = words[words.index("--") + 1:] if "--" in words else []
    if not given or given[0].isupper() or given[0].startswith("-"):
        return
    source = "\n".join(file.read_text(encoding="utf-8") for file in (ROOT / "fmu-build" / "src").rglob("*.rs"))
    spoken = "".join(part.capitalize() for part in given[0].split("-"))
    assert re.search(rf"\b{spoken}\b|\b{spoken}Command\b|\"{given[0]}\"", source), given[0]
    for option in (word for word in given[1:] if word.startswith("--")):
        field = option[2:].replace("-", "_")
        assert re.search(rf"\b{field}\b|\"{option[2:]}\"", source), option


@pytest.mark.parametrize("shown", commands("python3 crates/lab/lab.py"), ids=str)
def test_a_command_of_the_laboratory_is_understood(shown):
    name, *arguments = shown.words[2:]
    lab.Parser(lab.COMMANDS[name]).parsed(arguments)
