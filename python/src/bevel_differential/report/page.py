"""The page: one HTML file that needs nothing else."""

from collections.abc import Sequence
from pathlib import Path

from ..extras import needed
from ..values import DifferentialError, FileName
from .blocks import Picture, Section, Table, Text
from .simulated import Simulated

TEMPLATE = "template.html"


def page(run: Simulated, sections: Sequence[Section]) -> str:
    """The page as text."""
    jinja2 = needed("jinja2", "report")
    # what scenes and the FMU say is text, never markup; a name that is missing in the template is an error
    environment = jinja2.Environment(loader=jinja2.PackageLoader(__package__, ""), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.tests.update(text=lambda block: isinstance(block, Text), table=lambda block: isinstance(block, Table),
                             picture=lambda block: isinstance(block, Picture))
    return environment.get_template(TEMPLATE).render(scene=run.scene, sections=sections) + "\n"


def write(text: str, file: FileName) -> Path:
    """Writes it."""
    try:
        Path(file).write_text(text, encoding="utf-8")
    except OSError as error:
        raise DifferentialError(f"{file}: {error.strerror}") from None
    return Path(file)
