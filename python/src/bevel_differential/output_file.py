"""Checks of files to write, before the work."""

from pathlib import Path

from .extras import needed
from .values import DifferentialError
from .writing import try_whole

PARQUET = (".parquet", ".pq")
# endings of the files that are written, by kind
ENDINGS = {"table": (".csv", *PARQUET), "CSV file": (".csv",), "Parquet file": PARQUET, "picture": (".png", ".svg", ".pdf"),
           "page": (".html", ".htm"), "scene": (".toml",), "parameter set": (".ssv",), "Python script": (".py",), "MATLAB script": (".m",)}


def checked(file, kind: str | None = None) -> Path | None:
    """Path of a file that can be written, tested by a trial in its folder; None stays None. Its ending must be one of its kind in
    `ENDINGS`, and the packages that write it must be installed."""
    if file is None:
        return None
    file = Path(file)
    folder = file.absolute().parent
    if not folder.is_dir():
        raise DifferentialError(f"{file}: there is no folder {folder}; create it first")
    if file.is_dir():
        raise DifferentialError(f"{file}: it is a folder; name a file")
    if kind is not None and file.suffix.lower() not in ENDINGS[kind]:
        first, *others = ENDINGS[kind]
        raise DifferentialError(f"{file}: a {kind} ends with {' or '.join([', '.join([first, *others[:-1]]), *others[-1:]])}; name it "
                                f"{file.with_suffix(first).name}")
    if is_parquet(file):
        needed("pyarrow", "sweep")
    if kind == "picture":
        needed("matplotlib", "plot")
    try_whole(file)
    return file


def is_parquet(file) -> bool:
    """True if the ending of a table's file is one of Parquet."""
    return file is not None and Path(file).suffix.lower() in PARQUET
