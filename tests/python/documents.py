"""Contents of the documents: links, commands, Python snippets, files to save, and outputs of commands and snippets."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# pages for users; those in docs/inside are for makers
FOR_USERS = sorted(ROOT.glob("docs/*.md"))
PAGES = [ROOT / "README.md", *FOR_USERS, *sorted(ROOT.glob("docs/inside/*.md")), *sorted(ROOT.glob("examples/*/README.md"))]
LINK = re.compile(r'\]\(([^)\s]+)\)|(?:src|href)="([^"]+)"')
# a command may be in an HTML comment if the page's text describes it in other words
COMMAND = re.compile(r"^(?: {4}|\$ |<!-- )?((?:bevel-differential|cargo run|python3 crates/lab/lab.py|target/python/bin/fmpy) (?:.*\\\n)*.*?)(?: -->)?$", re.MULTILINE)
SAVED = re.compile(r"`(\w+\.toml)`[^\n]*\n\n```toml\n(.*?)```", re.DOTALL)
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# sections that a command of the laboratory updates
MARKED = re.compile(r"^<!-- ([\w -]+?)[ :]begin.*?^<!-- \1[ :]end", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class Command:
    """Command line of a page."""

    page: str
    words: tuple[str, ...]

    def __str__(self):
        return f"{self.page}: {shlex.join(self.words)}"


@dataclass(frozen=True)
class Block:
    """Text between two fences of a page; `start`: number of letters of the page before it."""

    page: str
    kind: str
    start: int
    text: str

    def __str__(self):
        return f"{self.page}: {self.text.splitlines()[0]}"


def links(page: Path) -> list[str]:
    """Addresses within the repository to which a page links."""
    found = [first or second for first, second in LINK.findall(page.read_text(encoding="utf-8"))]
    return [address for address in found if not address.startswith(("http", "mailto"))]


def anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as created by GitHub."""
    heads = re.findall(r"^#+ (.*)", page.read_text(encoding="utf-8"), re.MULTILINE)
    plain = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"[`*]", "", head)) for head in heads]
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in plain}


def commands(program: str) -> list[Command]:
    """Command lines of all pages that begin with `program`."""
    found = [command for page in PAGES for _, command in _commands(page) if shlex.join(command.words).startswith(program)]
    return list(dict.fromkeys(found))


def _commands(page: Path) -> list[tuple[int, Command]]:
    """Command lines of a page, with their positions. Text after two blanks is a comment."""
    found = []
    for shown in COMMAND.finditer(page.read_text(encoding="utf-8")):
        line = " ".join(part.strip() for part in shown[1].split("\\\n"))
        words = shlex.split(re.split(r" {2,}(?=\w)", line, maxsplit=1)[0], comments=True)
        found.append((shown.start(), Command(page.relative_to(ROOT).as_posix(), tuple(words))))
    return found


def blocks(*kinds: str) -> list[Block]:
    """Fenced texts of all pages with one of these words after the fence."""
    return [Block(page.relative_to(ROOT).as_posix(), shown[1], shown.start(2), shown[2]) for page in PAGES
            for shown in FENCE.finditer(page.read_text(encoding="utf-8")) if shown[1] in kinds]


def printed() -> list[tuple[Command | Block, Block]]:
    """Outputs on pages, each with the last command or snippet above it."""
    found = []
    for block in blocks("text"):
        text = (ROOT / block.page).read_text(encoding="utf-8")
        if any(marked.start() < block.start < marked.end() for marked in MARKED.finditer(text)):
            continue
        snippets = [(snippet.start, snippet) for snippet in blocks("python") if snippet.page == block.page]
        above = [each for each in _commands(ROOT / block.page) + snippets if each[0] < block.start]
        assert above, f"{block.page}: nothing above prints\n{block.text}"
        found.append((max(above, key=lambda each: each[0])[1], block))
    return found


def saved(page: str) -> dict[str, str]:
    """Files that a page tells the reader to save, by name."""
    return dict(SAVED.findall((ROOT / page).read_text(encoding="utf-8")))
