"""SSP archives of the examples with the FMU under test."""

import sys
from pathlib import Path

# only while they are imported, because the laboratory has modules of the same names
EXAMPLE = str(Path(__file__).resolve().parents[2] / "examples" / "drivetrain")
sys.path.insert(0, EXAMPLE)
import content  # noqa: E402, F401
import parameters  # noqa: E402, F401
import system  # noqa: E402
sys.path.remove(EXAMPLE)


def written(folder, made, fmu_file):
    """Archive of a `Structure` by version. Files without content replace the other parts."""
    fmus = {name: folder / f"{name}.fmu" for name in made.parts.values()}
    for file in fmus.values():
        file.touch()
    fmus["BevelDifferential"] = Path(fmu_file)
    files = {version: system.archive_file(folder, made.name, version) for version in system.VERSIONS}
    for version, file in files.items():
        system.write_ssp(file, fmus, made, version)
    return files
