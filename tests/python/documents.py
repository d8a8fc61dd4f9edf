"""What the documents show: links, commands and files to save."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted(ROOT.glob("docs/*.md")), *sorted(ROOT.glob("examples/*/README.md"))]
LINK = re.compile(r'\]\(([^)\s]+)\)|(?:src|href)="([^"]+)"')
COMMAND = re.compile(r"^(?: {4}|\$ )?((?:bevel-differential|cargo run) (?:.*\\\n)*.*)", re.MULTILINE)
SAVED = re.compile(r"`(\w+\.toml)`[^\n]*\n\n```toml\n(.*?)```", re.DOTALL)


@dataclass(frozen=True)
class Command:
    """A command line of a page."""

    page: str
    words: tuple[str, ...]

    def __str__(self):
        return f"{self.page}: {shlex.join(self.words)}"


def links(page: Path) -> list[str]:
    """Addresses that a page names within the repository."""
    found = [first or second for first, second in LINK.findall(page.read_text(encoding="utf-8"))]
    return [address for address in found if not address.startswith(("http", "mailto"))]


def anchors(page: Path) -> set[str]:
    """Names of a page's headings, as GitHub makes them."""
    heads = re.findall(r"^#+ (.*)", page.read_text(encoding="utf-8"), re.MULTILINE)
    plain = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"[`*]", "", head)) for head in heads]
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in plain}


def commands(program: str) -> list[Command]:
    """Command lines of all pages that begin with these words; a comment after two blanks is none of it."""
    found = []
    for page in PAGES:
        for shown in COMMAND.findall(page.read_text(encoding="utf-8")):
            line = " ".join(part.strip() for part in shown.split("\\\n"))
            words = shlex.split(re.split(r" {2,}(?=\w)", line, maxsplit=1)[0], comments=True)
            if shlex.join(words).startswith(program):
                found.append(Command(page.relative_to(ROOT).as_posix(), tuple(words)))
    return list(dict.fromkeys(found))


def saved(page: str) -> dict[str, str]:
    """Files that a page tells to save, by name."""
    return dict(SAVED.findall((ROOT / page).read_text(encoding="utf-8")))
