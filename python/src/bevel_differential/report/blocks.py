"""Contents of a report: sections with sentences, tables and pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Text:
    """Paragraph. `kind` "warning" or "verdict" highlights it; `good` colours a verdict."""

    text: str
    kind: str = ""
    good: bool | None = None


@dataclass(frozen=True)
class Table:
    """Table with a caption; columns from `left` on are numbers."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str
    left: int = 1


@dataclass(frozen=True)
class Picture:
    """Picture as SVG, with a caption that describes it."""

    name: str
    svg: str
    caption: str


Block = Text | Table | Picture


@dataclass
class Section:
    """Section of a report; `name` is its anchor."""

    name: str
    title: str
    blocks: list[Block] = field(default_factory=list)

    def say(self, text: str) -> None:
        """Adds a paragraph."""
        self.blocks.append(Text(text))

    def add(self, *blocks: Block) -> None:
        """Adds blocks."""
        self.blocks.extend(blocks)
