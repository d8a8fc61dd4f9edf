"""Tries changes of the source against the tests: all in one build, each woken by an environment variable.

usage: campaign.py REPOSITORY FOLDER COUNT SEED

Results are in FOLDER, where a run that was stopped goes on. Prints the report as Markdown."""

import hashlib
import html
import json
import os
import subprocess
import sys
import threading
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from build import WATCH, built
from changes import drawn

MODULES = ["src/contact", "src/geometry", "src/friction", "src/strength", "src/integrate", "src/model/dynamics", "src/model/effects"]
PROGRAMS = ["strength", "fmi2", "integrator", "geometry", "contact", "model"]
# a test that takes so many times as long as without a change, and so many seconds more, does not come to its end
PATIENCE, GRACE = 5.0, 10.0
# tests that take longer without a change [s] try none: they ask which settings act at all, not how much
LONGEST = 300.0


def main():
    repository, folder, count, seed = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    if not 0 < count < WATCH:
        raise SystemExit(f"{count} changes: a run takes 1 to {WATCH - 1}")
    folder.mkdir(parents=True, exist_ok=True)
    build = ["cargo", "test", "--no-run", *(word for name in PROGRAMS for word in ("--test", name))]
    changes, messages = built(repository, folder, lambda source, refused: drawn(source, MODULES, count, seed, refused), build)
    programs = programs_of(messages)
    tests = watched(programs, folder, len(changes))
    done = known(folder)
    lock = threading.Lock()

    def tried(number, change):
        key = f"{change.file}: {change.name} in byte {change.begin}"
        if key not in done:
            quick = [test for test in tests if number in test["reached"] and test["seconds"] < LONGEST]
            reaching = sorted(quick, key=lambda test: test["seconds"])
            fate, by = "survived", f"{len(reaching)} tests"
            for test in reaching:
                fate, _ = trial(programs[test["program"]], test["name"], number, PATIENCE * test["seconds"] + GRACE, folder)
                if fate != "survived":
                    by = f"{test['program']}: {test['name']}"
                    break
            with lock:
                done[key] = {"fate": fate, "by": by}
                with (folder / "outcomes.jsonl").open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"key": key, **done[key]}) + "\n")
                print(f"progress {len(done) / len(changes):.4f} {fate}: {key}", file=sys.stderr, flush=True)
        return done[key]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        fates = list(pool.map(tried, range(1, len(changes) + 1), changes))
    print(report(changes, fates, seed, repository))


def watched(programs, folder, count):
    """Each test without a change: its seconds, and which changes it reaches."""
    store = folder / "tests.json"
    names = [(program, line.removesuffix(": test")) for program, path in programs.items()
             for line in subprocess.run([path, "--list"], capture_output=True, text=True, check=True).stdout.splitlines()
             if line.endswith(": test")]
    digests = {program: hashlib.sha256(Path(path).read_bytes()).hexdigest() for program, path in programs.items()}
    before = json.loads(store.read_text(encoding="utf-8")) if store.is_file() else {}
    if before.get("programs") == digests:
        return before["tests"]

    def watch(each):
        number, (program, name) = each
        file = folder / f"reached{number}.txt"
        file.unlink(missing_ok=True)
        fate, seconds = trial(programs[program], name, WATCH, None, folder, {"MUTANTS_REACHED": str(file)})
        reached = [int(line) for line in file.read_text().split()] if file.is_file() else []
        if fate != "survived":  # as a test that counts allocations, and so counts those of being watched
            reached = list(range(1, count + 1))
            fate, seconds = trial(programs[program], name, 0, None, folder)
        if fate != "survived":  # as a test of a small stack, whose frames hold all changes
            print(f"progress 0.0 left out, as it fails without any change: {name} of {program}", file=sys.stderr, flush=True)
            return None
        file.unlink(missing_ok=True)
        if number % 20 == 0:
            print(f"progress 0.0 tests watched: {number} of {len(names)}", file=sys.stderr, flush=True)
        return {"program": program, "name": name, "seconds": seconds, "reached": reached}

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tests = [test for test in pool.map(watch, enumerate(names)) if test]
    if len(tests) < 0.99 * len(names):
        raise SystemExit(f"{len(names) - len(tests)} of {len(names)} tests fail without any change")
    store.write_text(json.dumps({"programs": digests, "tests": tests}), encoding="utf-8")
    return tests


def programs_of(messages):
    """The test programs by name."""
    found = {message["target"]["name"]: message["executable"] for message in messages if message.get("executable")}
    return {name: found[name] for name in PROGRAMS if name in found}


def trial(program, test, number, patience, folder, more={}):
    """What a test makes of a change: its fate, and the seconds that it took."""
    begin = time.monotonic()
    surroundings = {**os.environ, "MUTANT": str(number), "RUST_BACKTRACE": "0", **more}
    try:
        done = subprocess.run([program, "--exact", test], cwd=folder / "source", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              env=surroundings, timeout=patience)
    except subprocess.TimeoutExpired:
        return "no end", patience
    return "noticed" if done.returncode else "survived", time.monotonic() - begin


def known(folder):
    """Outcomes of a run that was stopped."""
    file = folder / "outcomes.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
    return {entry.pop("key"): entry for entry in map(json.loads, lines)}


def report(changes, fates, seed, repository):
    """Counts by module, and the survivors with what docs/mutants.toml says about them."""
    said = tomllib.loads((repository / "docs" / "mutants.toml").read_text(encoding="utf-8")).get("survivor", [])
    rows = []
    for module in [*dict.fromkeys(change.module for change in changes), "all"]:
        own = [fate["fate"] for change, fate in zip(changes, fates) if module in (change.module, "all")]
        rows.append(f"| {module if module == 'all' else f'`{module}`'} | {len(own)} | {own.count('noticed')} | {own.count('no end')} | "
                    f"{own.count('survived')} |")
    lines = [f"{len(changes)} changes, drawn by seed {seed}:", "", "| module | changes | noticed | timed out | survived |",
             "|---|---:|---:|---:|---:|", *rows]
    survivors = [change for change, fate in zip(changes, fates) if fate["fate"] == "survived"]
    if survivors:
        lines += ["", "| survivor | explanation |", "|---|---|"]
    for change in survivors:
        why = next((each["why"] for each in said if (each["file"], each["change"]) == (change.file, change.name)), "**not explained**")
        lines.append(f"| `{change.file}`: <code>{html.escape(change.name)}</code>".replace("||", "\\|\\|") + f" | {why} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
