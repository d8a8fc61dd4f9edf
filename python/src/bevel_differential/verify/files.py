"""What files of the evidence are made of: types, paths, XML and numbers."""

import math
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

from lxml import etree

# types of files; `ANY` says nothing
ANY = "application/octet-stream"
PARAMETERS = ("application/x-ssp-parameter-set",)
TABLES = ("text/csv",)
_WORDS = {"true": 1.0, "false": 0.0}


class Broken(Exception):
    """Evidence that cannot be used."""


def local(what: Any) -> str:
    """Name of an element or an attribute in small letters without its namespace, also where the prefix is not declared."""
    tag = getattr(what, "tag", what)
    return tag.rpartition("}")[2].rpartition(":")[2].lower() if isinstance(tag, str) else ""


def mime(element: Any) -> str:
    """The type of the file that an element names, without its parameters."""
    return element.get("type", ANY).partition(";")[0].strip().lower()


def path_of(uri: str) -> str:
    """The path that a relative URI means. One with a scheme or a host is left as it is: it is not in the FMU."""
    try:
        parts = urlsplit(uri.strip())
    except ValueError:
        return uri
    return uri.strip() if parts.scheme or parts.netloc else unquote(parts.path)


def parsed(name: str, file: Path, faults: list[str]) -> Any:
    """The root of an XML file; of a damaged one what can be read, with a fault, or None."""
    content = file.read_bytes()
    try:
        return etree.fromstring(content)
    except etree.XMLSyntaxError as error:
        faults.append(f"{name}: it is no valid XML ({error})")
    try:
        return etree.fromstring(content, etree.XMLParser(recover=True))
    except etree.XMLSyntaxError:
        return None


def attribute_number(text: str | None) -> float | None:
    """The number of an attribute, None where it is not given."""
    return None if text is None else number(text)


def number(text: str) -> float:
    """The finite number that a text stands for."""
    word = text.strip().lower()
    try:
        value = _WORDS[word] if word in _WORDS else float(word)
    except ValueError:
        raise Broken(f"is {text!r}: it is no number") from None
    if not math.isfinite(value):
        raise Broken(f"is {text!r}: it must be finite")
    return value
