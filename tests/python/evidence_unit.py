"""FMUs with a few scenes of the evidence, and with changed files."""

import re
import zipfile

from bevel_differential.verify import FOLDER, MANIFEST

# a scene of one second without teeth, and a scene with teeth from an equilibrium
FEW = ("hil", "study_turning")


def packed(fmu_file, target, scenes=FEW, changes=None):
    """Writes an FMU whose manifest lists only these scenes, and returns its path.

    `changes`: by path in the archive or in the folder of the evidence, the new text, a function of the old text, or None to
    remove the file."""
    with zipfile.ZipFile(fmu_file) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if not name.startswith("documentation/")}
    manifest = f"{FOLDER}/{MANIFEST}"
    kept = "|".join((*scenes, "tolerances"))
    files[manifest] = re.sub(rf'  <Related [^>]*source="\w+/(?!(?:{kept})\.)[^>]*>\n', "", files[manifest].decode()).encode()
    for name, change in (changes or {}).items():
        path = name if name in files else f"{FOLDER}/{name}"
        old = files.pop(path, b"").decode()
        new = change(old) if callable(change) else change
        assert new != old, f"{name} is unchanged"
        if new is not None:
            files[path] = new.encode()
    with zipfile.ZipFile(target, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return str(target)
