"""Files that are to be written, checked before the work."""

from pathlib import Path

from .values import DifferentialError
from .writing import try_whole

PICTURES = (".png", ".svg", ".pdf")


def checked(file) -> Path | None:
    """The path of a file that can be written as far as its folder tells; None stays None."""
    if file is None:
        return None
    file = Path(file)
    folder = file.absolute().parent
    if not folder.is_dir():
        raise DifferentialError(f"{file}: there is no folder {folder}; make it first")
    if file.is_dir():
        raise DifferentialError(f"{file}: it is a folder; name a file")
    try_whole(file)
    return file


def is_parquet(file) -> bool:
    """Whether a table is written as Parquet: its file's ending says so."""
    return file is not None and Path(file).suffix.lower() in (".parquet", ".pq")


def checked_picture(file) -> Path | None:
    """The same of a picture, whose ending says its kind."""
    file = checked(file)
    if file is not None and file.suffix.lower() not in PICTURES:
        raise DifferentialError(f"{file}: a picture ends with {', '.join(PICTURES)}")
    return file
