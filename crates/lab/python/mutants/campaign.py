"""Tests if changes of the source are noticed: all are in one build, and an environment variable activates one of them.

usage: campaign.py REPOSITORY FOLDER COUNT SEED        changes of all kinds, tested by the test programs
       campaign.py REPOSITORY FOLDER COUNT SEED FMU    coefficients that are 2 % larger, tested by `verify` with the evidence of the FMU

FOLDER contains the results, and an interrupted run continues there. Prints the report as Markdown."""

import json
import os
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from build import WATCH, built, say
from tests import Tests
from wrong_units import WrongUnits


def main(repository, folder, count, seed, *fmu):
    repository, folder, count = Path(repository), Path(folder), int(count)
    if not 0 < count < WATCH:
        raise SystemExit(f"{count} changes: a run takes 1 to {WATCH - 1}")
    folder.mkdir(parents=True, exist_ok=True)
    kind = WrongUnits if fmu else Tests
    changes, messages = built(repository, folder, kind, count, int(seed))
    judge, store = kind(folder, changes, messages, *fmu), folder / "fates.jsonl"
    keys = [f"{change.file}: {change.name} in byte {change.begin}" for change in changes]
    # the fates of an interrupted run
    fates = dict(map(json.loads, store.read_text(encoding="utf-8").splitlines())) if store.is_file() else {}
    with ThreadPoolExecutor(os.cpu_count()) as pool, store.open("a", encoding="utf-8") as file:
        tried = {pool.submit(judge.fate, number): key for number, key in enumerate(keys, 1) if key not in fates}
        try:
            for done in as_completed(tried):
                fates[tried[done]] = found = done.result()
                file.write(json.dumps([tried[done], found]) + "\n")
                file.flush()
                say(len(fates) / len(changes), f"{found['fate']}: {tried[done]}")
        finally:
            # otherwise, an error or Ctrl-C would wait for all further changes
            pool.shutdown(wait=False, cancel_futures=True)
    explained = tomllib.loads((repository / "docs" / "mutants.toml").read_text(encoding="utf-8")).get(kind.explained, [])
    print(judge.report(list(zip(changes, map(fates.get, keys))), seed, explained))


if __name__ == "__main__":
    main(*sys.argv[1:])
