"""Tests as judges of changes: the tests that reach each change, and those that notice it."""

import hashlib
import html
import json
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from build import WATCH
from changes import possible

MODULES = ["src/contact", "src/geometry", "src/friction", "src/strength", "src/integrate", "src/model/dynamics", "src/model/effects"]
PROGRAMS = ["strength", "fmi2", "integrator", "geometry", "contact", "model"]
# a test that exceeds its time without a change by this factor plus this number of seconds counts as endless
PATIENCE, GRACE = 5.0, 10.0
# tests that take longer without a change [s] are not used: they check which settings have any effect, not how much
LONGEST = 300.0


class Tests:
    """Judge of changes of all kinds: runs the test programs of the library until one notices the change."""

    modules, changes_of = MODULES, staticmethod(possible)
    build = ["cargo", "test", "--no-run", *(word for name in PROGRAMS for word in ("--test", name))]
    explained = "survivor"

    def __init__(self, folder, changes, messages):
        self.folder, self.programs = folder, programs_of(messages)
        self.tests = watched(self.programs, folder, len(changes))

    @staticmethod
    def prepare(_source):
        """Leaves the source unchanged, because all changes are built into it directly."""

    def fate(self, number):
        """Fate of a change, and the test that noticed it."""
        quick = [test for test in self.tests if number in test["reached"] and test["seconds"] < LONGEST]
        for test in sorted(quick, key=lambda test: test["seconds"]):
            program, patience = self.programs[test["program"]], PATIENCE * test["seconds"] + GRACE
            fate, _ = trial(program, test["name"], number, patience, self.folder)
            if fate != "survived":
                return {"fate": fate, "by": f"{test['program']}: {test['name']}"}
        return {"fate": "survived", "by": f"{len(quick)} tests"}

    def report(self, changes, fates, seed, said):
        """Counts by module, and the survivors with their explanations in docs/mutants.toml."""
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


def watched(programs, folder, count):
    """Each test without a change: its seconds, and the changes that it reaches."""
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
        if fate != "survived":  # such as a test that counts allocations, and also counts those of the observation
            reached = list(range(1, count + 1))
            fate, seconds = trial(programs[program], name, 0, None, folder)
        if fate != "survived":  # such as a test of a small stack, whose frames contain all changes
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
    """Test programs by name."""
    found = {message["target"]["name"]: message["executable"] for message in messages if message.get("executable")}
    return {name: found[name] for name in PROGRAMS if name in found}


def trial(program, test, number, patience, folder, more={}):
    """Fate of a change in a test, and the duration of the test in seconds."""
    begin = time.monotonic()
    surroundings = {**os.environ, "MUTANT": str(number), "RUST_BACKTRACE": "0", **more}
    try:
        done = subprocess.run([program, "--exact", test], cwd=folder / "source", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              env=surroundings, timeout=patience)
    except subprocess.TimeoutExpired:
        return "no end", patience
    return "noticed" if done.returncode else "survived", time.monotonic() - begin
