"""Builds the FMUs of the other parts with pythonfmu."""

import shutil
import sys
from pathlib import Path

from pythonfmu.builder import FmuBuilder

HERE = Path(__file__).parent
# files in each of these FMUs: the base class of the parts, and the package's equations of tyre, motor and body
SHARED = [HERE / "parts" / "part.py", HERE.parents[1] / "python/src/bevel_differential/vehicle/equations.py"]
# pythonfmu imports a part to describe it. The folder is last on the path because it also contains a part.py
sys.path.append(str(SHARED[1].parent))
# file of each class of the drivetrain that pythonfmu builds
SOURCES = {name: HERE / "parts" / file for name, file in
           (("Engine", "engine.py"), ("FinalDrive", "final_drive.py"), ("Wheel", "wheel.py"), ("Vehicle", "vehicle.py"))}


def make_parts(differential, folder, sources=SOURCES, more=()):
    """FMUs by class, in `folder`; `differential` is the FMU of this program, `more` are further files that the other FMUs need."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for source in sources.values():
        FmuBuilder.build_FMU(str(source), dest=str(folder), project_files=[*SHARED, *more], canGetAndSetFMUstate="true")
    shutil.copyfile(differential, folder / "BevelDifferential.fmu")
    return {name: folder / f"{name}.fmu" for name in (*sources, "BevelDifferential")}
