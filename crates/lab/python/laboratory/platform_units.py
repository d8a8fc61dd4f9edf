"""FMUs that the command `platforms` compares, one for each library, and the programs that run them."""

import zipfile

from .paths import FMU, TARGET, TOOLCHAINS, library, packaged
from .terminal import Failure

INSTALL = "cargo run --release -- toolchains"
ALL = ["linux64", "win64", "aarch64-linux", "darwin64"]
# label of the library for Linux, which supports systems since this version of glibc
LABELS = {"linux64": "linux64, glibc 2.17"}


def arguments(work):
    """Splits the packaged FMU and returns the arguments of the script: a folder, TOOL=FILE..., NAME=FMU..."""
    zig = TOOLCHAINS / "linux" / "bin" / "python"
    if not zig.exists():
        raise Failure(f"the tool chains for other machines are not installed; to get them: {INSTALL}")
    fmu, folder = packaged(), TARGET / "platforms"
    folder.mkdir(exist_ok=True)
    with zipfile.ZipFile(fmu) as archive:
        platforms = list(dict.fromkeys(name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")))
    left_out = ", ".join(name for name in ALL if name not in platforms)
    if left_out and work.options.write:
        raise Failure(f"the documents name all platforms, but these are left out: {left_out}; to get them: {INSTALL}")
    if left_out:
        work.progress.note(f"left out: {left_out}; to get it: {INSTALL}")
    tools = {"wine": TOOLCHAINS / "windows" / "bin" / "wine64", "qemu": TOOLCHAINS / "aarch64" / "bin" / "qemu-aarch64", "zig": zig}
    # the library for ARM can run here only under qemu
    names = [name for name in platforms if name != "aarch64-linux" or tools["qemu"].exists()]
    own = library("bevel_differential").read_bytes()
    units = [("linux64, plain", "linux64", own), ("linux64, narrow", "linux64", own), *((LABELS.get(name, name), name, None) for name in names)]
    named = [f"{tool}={file}" for tool, file in tools.items() if file.exists()]
    for index, (label, platform, library_bytes) in enumerate(units):
        file = folder / f"{index}.fmu"
        write_unit(file, platform, library_bytes)
        named.append(f"{label}={file}")
    return [folder, *named]


def write_unit(file, platform, replacement):
    """Writes an FMU with the library of one platform, or with its `replacement`."""
    with zipfile.ZipFile(FMU) as given, zipfile.ZipFile(file, "w") as unit:
        for name in given.namelist():
            is_library = name.startswith(f"binaries/{platform}/")
            if is_library or not name.startswith("binaries/"):
                unit.writestr(name, replacement if is_library and replacement else given.read(name))
