"""Tests as judges of changes: the tests that reach each change, and those that notice it."""

import hashlib
import html
import json
import os
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import changes
from bevel_differential.text import markdown
from build import WATCH, active, say

PROGRAMS = ["strength", "fmi2", "integrator", "geometry", "contact", "model"]
# a test that exceeds its time without a change by this factor plus this number of seconds counts as endless
PATIENCE, GRACE = 5.0, 10.0
# tests that take longer without a change [s] are not used: they check which settings have any effect, not how much
LONGEST = 300.0


class Tests:
    """Judge of changes of all kinds: runs the test programs of the library until one notices the change."""

    modules = ["src/contact", "src/geometry", "src/friction", "src/strength", "src/integrate", "src/model/dynamics", "src/model/effects"]
    build = ["cargo", "test", "--no-run", *(word for name in PROGRAMS for word in ("--test", name))]
    explained, is_closed = "survivor", staticmethod(changes.is_closed)

    def __init__(self, folder, drawn, messages):
        self.folder = folder
        built = {message["target"]["name"]: message["executable"] for message in messages if message.get("executable")}
        self.programs = {name: built[name] for name in PROGRAMS if name in built}
        self.tests = self.watched(len(drawn))

    @staticmethod
    def prepare(_source):
        """Leaves the source unchanged, because all changes are built into it directly."""

    @staticmethod
    def replacement(_file, node):
        """Expression that replaces another one."""
        return changes.replacement(node)

    def fate(self, number):
        """Fate of a change, and the test that noticed it."""
        quick = [test for test in self.tests if number in test["reached"] and test["seconds"] < LONGEST]
        for test in sorted(quick, key=lambda test: test["seconds"]):
            fate, _ = self.trial(test["program"], test["name"], number, PATIENCE * test["seconds"] + GRACE)
            if fate != "survived":
                return {"fate": fate, "by": f"{test['program']}: {test['name']}"}
        return {"fate": "survived", "by": f"{len(quick)} tests"}

    def report(self, tried, seed, explained):
        """Counts by module, and the survivors with their explanations in docs/mutants.toml."""
        rows, kinds = [["module", "changes", "noticed", "timed out", "survived"]], ("noticed", "no end", "survived")
        for module in [*dict.fromkeys(change.module for change, _ in tried), "all"]:
            own = [fate["fate"] for change, fate in tried if module in (change.module, "all")]
            rows.append([module if module == "all" else f"`{module}`", str(len(own)), *(str(own.count(kind)) for kind in kinds)])
        text = f"{len(tried)} changes, drawn by seed {seed}:\n\n{markdown(rows)}"
        why = {(each["file"], each["change"]): each["why"] for each in explained}
        rows = [[f"`{change.file}`: <code>{html.escape(change.name)}</code>".replace("||", "\\|\\|"),
                 why.get((change.file, change.name), "**not explained**")] for change, fate in tried if fate["fate"] == "survived"]
        return (f"{text}\n{markdown([['survivor', 'explanation'], *rows], left=(0, 1))}" if rows else text).rstrip()

    def watched(self, count):
        """Each test without a change: its seconds, and the changes that it reaches."""
        store = self.folder / "tests.json"
        digests = {program: hashlib.sha256(Path(path).read_bytes()).hexdigest() for program, path in self.programs.items()}
        before = json.loads(store.read_text(encoding="utf-8")) if store.is_file() else {}
        if before.get("programs") == digests:
            return before["tests"]
        names = [(program, line.removesuffix(": test")) for program, path in self.programs.items()
                 for line in subprocess.run([path, "--list"], capture_output=True, text=True, check=True).stdout.splitlines()
                 if line.endswith(": test")]

        def watch(number):
            program, name = names[number]
            file = self.folder / f"reached{number}.txt"
            file.unlink(missing_ok=True)
            fate, seconds = self.trial(program, name, WATCH, None, MUTANTS_REACHED=str(file))
            reached = [*map(int, file.read_text().split())] if file.is_file() else []
            file.unlink(missing_ok=True)
            if fate != "survived":  # such as a test that counts allocations, and also counts those of the observation
                reached = [*range(1, count + 1)]
                fate, seconds = self.trial(program, name, 0, None)
            if fate != "survived":  # such as a test of a small stack, whose frames contain all changes
                say(0.0, f"left out, as it fails without any change: {name} of {program}")
                return None
            if number % 20 == 0:
                say(0.0, f"tests watched: {number} of {len(names)}")
            return {"program": program, "name": name, "seconds": seconds, "reached": reached}

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            tests = [test for test in pool.map(watch, range(len(names))) if test]
        if len(tests) < 0.99 * len(names):
            raise SystemExit(f"{len(names) - len(tests)} of {len(names)} tests fail without any change")
        store.write_text(json.dumps({"programs": digests, "tests": tests}), encoding="utf-8")
        return tests

    def trial(self, program, test, number, patience, **more):
        """Fate of a change in a test, and the duration of the test in seconds."""
        begin = time.monotonic()
        try:
            done = subprocess.run([self.programs[program], "--exact", test], cwd=self.folder / "source", stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, env=active(number, RUST_BACKTRACE="0", **more), timeout=patience)
        except subprocess.TimeoutExpired:
            return "no end", patience
        return "noticed" if done.returncode else "survived", time.monotonic() - begin
