"""Tests if changes of the source are noticed: all are in one build, and an environment variable activates one of them.

usage: campaign.py REPOSITORY FOLDER COUNT SEED        changes of all kinds, tested by the test programs
       campaign.py REPOSITORY FOLDER COUNT SEED FMU    coefficients that are 2 % larger, tested by `verify` with the evidence of the FMU

FOLDER contains the results, and an interrupted run continues there. Prints the report as Markdown."""

import json
import os
import sys
import threading
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from build import WATCH, built
from changes import drawn
from tests import Tests
from wrong_units import WrongUnits


def main():
    repository, folder, count, seed = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    kind = WrongUnits if len(sys.argv) > 5 else Tests
    if not 0 < count < WATCH:
        raise SystemExit(f"{count} changes: a run takes 1 to {WATCH - 1}")
    folder.mkdir(parents=True, exist_ok=True)

    def draw(source, refused):
        kind.prepare(source)
        return drawn(source, kind.modules, count, seed, refused, kind.changes_of)

    changes, messages = built(repository, folder, draw, kind.build)
    judge = kind(folder, changes, messages, *map(Path, sys.argv[5:]))
    done, lock = known(folder), threading.Lock()

    def tried(number, change):
        key = f"{change.file}: {change.name} in byte {change.begin}"
        if key not in done:
            found = judge.fate(number)
            with lock:
                done[key] = found
                with (folder / "outcomes.jsonl").open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"key": key, **found}) + "\n")
                print(f"progress {len(done) / len(changes):.4f} {found['fate']}: {key}", file=sys.stderr, flush=True)
        return done[key]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        fates = list(pool.map(tried, range(1, len(changes) + 1), changes))
    said = tomllib.loads((repository / "docs" / "mutants.toml").read_text(encoding="utf-8")).get(kind.explained, [])
    print(judge.report(changes, fates, seed, said))


def known(folder):
    """Outcomes of an interrupted run."""
    file = folder / "outcomes.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
    return {entry.pop("key"): entry for entry in map(json.loads, lines)}


if __name__ == "__main__":
    main()
