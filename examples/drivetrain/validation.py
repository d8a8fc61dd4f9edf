"""Validation of the SSP archives with pyssp-standard, which contains the schemas of SSP 1.0 and 2.0, and their comparison."""

import tempfile
import zipfile
from pathlib import Path

from pyssp_standard import SSP
from xmlschema import XMLSchemaException

import content
from system import VERSIONS, archive_file

# a fault in each description and each table of values, which the schemas of both versions forbid
FAULTS = {".ssd": (b'kind="input"', b'kind="inward"'), ".ssv": (b" value=", b" amount=")}


def wrong(folder, name):
    """Messages if an archive `name` does not conform to its version of the standard, or if the archives of both versions differ."""
    files = [archive_file(folder, name, version) for version in VERSIONS]
    contents = [content.read(file) for file in files]
    problems = [f"{file.name}: {problem}" for file in files for problem in [*faults(file), *overlooked(file)]]
    problems += [f"{file.name}: states the versions {sorted(found['versions'])}, expected {version} everywhere"
                 for file, found, version in zip(files, contents, VERSIONS) if found["versions"] != {version}]
    return problems + [f"{' and '.join(file.name for file in files)}: {each}" for each in content.differences(*contents)]


def faults(file):
    """Messages about files that violate the schema of the version that they state. If there are none, messages about connections that
    the standard forbids, and about inputs without a source, because every input of these systems has one."""
    with SSP(file, mode="r") as archive:
        description = archive.system_structure
        problems = [f"{each.file_path.name}: {fault}" for each in (description, *archive.ssv) for fault in violations(each)]
        if problems:
            return problems
        try:
            return description.check_connections(unconnected_inputs=True)
        except KeyError as error:
            # pyssp-standard 0.9.1 looks both ends up before it checks that they exist
            return [f"no connector {error}"]


def violations(part):
    """The schema's message about a description or a table of values, if it has one."""
    try:
        part.__check_compliance__()
    except XMLSchemaException as error:
        return [f"{getattr(error, 'path', '')}: {getattr(error, 'reason', error)}"]
    return []


def overlooked(file):
    """Messages about files in which the validation does not find a fault. They show that its silence proves something."""
    with tempfile.TemporaryDirectory() as folder:
        faulty = Path(folder) / file.name
        with zipfile.ZipFile(file) as archive, zipfile.ZipFile(faulty, "w") as target:
            names = [name for name in archive.namelist() if Path(name).suffix in FAULTS]
            for name in names:
                target.writestr(name, archive.read(name).replace(*FAULTS[Path(name).suffix], 1))
        found = "\n".join(faults(faulty))
    return [f"a fault in {name} is not found" for name in names if f"{Path(name).name}: " not in found]
