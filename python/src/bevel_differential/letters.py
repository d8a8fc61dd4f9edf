"""Printing on terminals, pipes and files whose encoding lacks letters, such as the code pages of Windows."""

import codecs
import sys
import unicodedata
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from io import TextIOWrapper

# name of the handler of encoding errors
HANDLER = "bevel_differential.similar"
SIMILAR = {"−": "-", "–": "-", "·": ".", "×": "x", "µ": "u", "°": "deg", "≥": ">=", "≤": "<=", "→": "->", "←": "<-", "√": "sqrt"}


@contextmanager
def replaced() -> Iterator[None]:
    """Context in which standard output and standard error replace letters that their encoding lacks."""
    codecs.register_error(HANDLER, _similar)
    with ExitStack() as ended:
        for stream in (sys.stdout, sys.stderr):
            # streams of other kinds, as in a notebook, accept all letters
            if isinstance(stream, TextIOWrapper):
                ended.callback(stream.reconfigure, errors=stream.errors)
                stream.reconfigure(errors=HANDLER)
        yield


def _similar(error):
    """ASCII text in place of the letters that cannot be encoded."""
    return "".join(map(_ascii, error.object[error.start:error.end])), error.end


def _ascii(letter):
    """ASCII text similar to a letter, the name of a Greek letter, or a question mark."""
    alphabet, _, name = unicodedata.name(letter, "").partition(" ")
    if letter in SIMILAR:
        return SIMILAR[letter]
    if alphabet == "GREEK":
        return name.rpartition(" ")[2].lower()
    return unicodedata.normalize("NFKD", letter).encode("ascii", "ignore").decode() or "?"
