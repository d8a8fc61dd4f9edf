"""Launch of a whole drivetrain on split friction, coupled from FMUs: hosts, errors against the communication step, limits.

    python run.py FMU LIBRARY FOLDER [--quick]

FMU is the FMU of this program, LIBRARY is foreign-solvers as cargo built it. Writes SSP archives, errors.csv, summary.md and
pictures to FOLDER and prints the tables. Fails if an archive does not conform to its version of SSP, if archives or hosts disagree, or if
errors, orders or limits contradict theory.
`python3 crates/lab/lab.py drivetrain` creates the environment and runs this script.
"""

import contextlib
import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import advice  # noqa: E402
import checks  # noqa: E402
import figures  # noqa: E402
import measure  # noqa: E402
import report  # noqa: E402
import validation  # noqa: E402
from fmus import make_parts  # noqa: E402
from library import Library  # noqa: E402
from measure import progress  # noqa: E402
from parameters import structure  # noqa: E402
from system import VERSIONS, archive_file, write_ssp  # noqa: E402


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--quick"]
    if len(arguments) != 3:
        raise SystemExit("usage: run.py FMU LIBRARY FOLDER [--quick]")
    # messages of FMUs and hosts do not belong in the tables
    with open(os.devnull, "w") as silence, contextlib.redirect_stdout(silence):
        text, wrong = everything(*(Path(argument) for argument in arguments), quick="--quick" in sys.argv)
    print(text, end="")
    if wrong:
        raise SystemExit("\n".join(wrong))


def everything(fmu, library_path, folder, quick):
    folder.mkdir(parents=True, exist_ok=True)
    library, contacts = Library(library_path), ("ideal",) if quick else ("ideal", "tooth")
    progress(0.0, "making the parts")
    fmus = make_parts(fmu, folder / "parts")
    wrong = []
    for contact in ("ideal", "tooth"):
        name = f"drivetrain_{contact}"
        for version in VERSIONS:
            write_ssp(archive_file(folder, name, version), fmus, structure(contact), version)
        wrong += validation.wrong(folder, name)
    hosts = measure.hosts(folder, fmus, quick)
    progress(0.1, "the whole as one set of equations")
    references = {contact: measure.references(library_path, fmus, contact) for contact in contacts}
    limits = measure.limits(fmus, quick)
    contact = contacts[-1]
    advised = advice.advice(fmus, contact, references[contact])
    errors = measure.errors(fmus, references, quick)
    mesh = measure.mesh(library)
    measure.write_csv(folder / "errors.csv", errors)
    found = {"hosts": hosts, "references": references, "limits": limits, "advice": advised, "errors": errors, "mesh": mesh}
    figures.launch(folder / "drivetrain_launch.png", references[contact].dense, measure.coupled(fmus, contact), contact)
    figures.errors(folder / "drivetrain_errors.png", errors, limits)
    figures.signals(folder / "drivetrain_signals.png")
    (folder / "summary.md").write_text(report.summary(found), encoding="utf-8")
    return report.markdown(found), wrong + checks.wrong(found)


if __name__ == "__main__":
    main()
