"""Tries changes of the source against the tests: all in one build, each woken by an environment variable.

usage: campaign.py REPOSITORY FOLDER COUNT SEED

Results are in FOLDER, where a run that was stopped goes on. Prints the report as Markdown."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
import threading
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from io import BytesIO
from pathlib import Path

from changes import build_in, drawn

ROOMS = ["src/contact", "src/geometry", "src/friction", "src/strength", "src/integrate", "src/model/dynamics", "src/model/effects"]
# quick ones first
PROGRAMS = ["strength", "fmi2", "integrator", "geometry", "contact", "model"]
# the program that is nearest to a room, and runs before all others
NEAREST = {"src/contact": "contact", "src/geometry": "geometry", "src/friction": "contact", "src/strength": "strength",
           "src/integrate": "integrator", "src/model/dynamics": "model", "src/model/effects": "model"}
# a program that takes so many times as long as without a change does not come to its end
PATIENCE = 5.0
SWITCH = '''//! Which change acts.
use std::sync::OnceLock;
static CHOSEN: OnceLock<u32> = OnceLock::new();
/// Whether change `k` acts.
#[inline]
pub fn on(k: u32) -> bool {
    k == *CHOSEN.get_or_init(|| std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0))
}
'''


def main():
    repository, folder, count, seed = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    folder.mkdir(parents=True, exist_ok=True)
    changes, programs = built(repository, folder, count, seed)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        usual = dict(zip(programs, pool.map(lambda program: trial(program, 0, None, folder), programs.values())))
    failed = [name for name, (fate, _) in usual.items() if fate != "survived"]
    if failed:
        raise SystemExit(f"the tests fail without any change: {', '.join(failed)}")
    done = known(folder)
    lock = threading.Lock()

    def tried(number, change):
        key = f"{change.file}: {change.name} in byte {change.begin}"
        if key not in done:
            for name in sorted(programs, key=lambda name: name != NEAREST[change.room]):
                fate, test = trial(programs[name], number, PATIENCE * usual[name][1] + 10.0, folder)
                if fate != "survived":
                    break
            with lock:
                done[key] = {"fate": fate, "by": f"{name}: {test}" if fate == "noticed" else name}
                with (folder / "outcomes.jsonl").open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"key": key, **done[key]}) + "\n")
                print(f"progress {len(done) / len(changes):.4f} {done[key]['fate']}: {key}", file=sys.stderr, flush=True)
        return done[key]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        fates = list(pool.map(tried, range(1, len(changes) + 1), changes))
    print(report(changes, fates, seed, repository))


def built(repository, folder, count, seed):
    """The changes, and the test programs with all of them built in. What the compiler refuses is replaced by other changes."""
    source, refused = folder / "source", set()
    for _ in range(20):
        shutil.rmtree(source, ignore_errors=True)
        archive = subprocess.run(["git", "archive", "HEAD"], cwd=repository, check=True, capture_output=True).stdout
        tarfile.open(fileobj=BytesIO(archive)).extractall(source, filter="data")
        changes = drawn(source, ROOMS, count, seed, refused)
        places = build_in(source, changes)
        (source / "src" / "mutants.rs").write_text(SWITCH, encoding="utf-8")
        library = source / "src" / "lib.rs"
        library.write_text(library.read_text(encoding="utf-8") + "\npub mod mutants;\n", encoding="utf-8")
        print(f"progress 0.0 compiling {len(changes)} changes, {len(refused)} refused so far", file=sys.stderr, flush=True)
        messages, programs = compiled(source, folder)
        wrong = {change for file, begin, end in messages for first, last, change in places.get(file, []) if begin < last and first < end}
        if not messages:
            return changes, programs
        if not wrong:
            raise SystemExit(f"the source does not compile: {messages[:3]}")
        refused |= wrong
    raise SystemExit("too many changes are no programs")


def compiled(source, folder):
    """Places of errors (file, begin, end), and the test programs by name."""
    command = ["cargo", "test", "--release", "--no-run", "-p", "bevel-differential", "--message-format", "json", "--target-dir",
               str(folder / "build"), *(word for name in PROGRAMS for word in ("--test", name))]
    settings = {"CARGO_PROFILE_RELEASE_CODEGEN_UNITS": "16", "RUSTFLAGS": "-Aunused"}
    done = subprocess.run(command, cwd=source, env={**os.environ, **settings}, capture_output=True, text=True)
    messages, programs = [], {}
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("reason") == "compiler-message" and message["message"]["level"] == "error":
            messages += [(span["file_name"], span["byte_start"], span["byte_end"]) for span in message["message"]["spans"]]
        if message.get("executable") and message["target"]["name"] in PROGRAMS:
            programs[message["target"]["name"]] = message["executable"]
    if done.returncode and not messages:
        raise SystemExit(done.stderr)
    return messages, {name: programs[name] for name in PROGRAMS if name in programs}


def trial(program, number, patience, folder):
    """What a test program makes of a change: its fate, and the test that fails or the seconds that it took."""
    begin = time.monotonic()
    child = subprocess.Popen([program, "--test-threads", "1"], cwd=folder / "source", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                             text=True, env={**os.environ, "MUTANT": str(number), "RUST_BACKTRACE": "0"})
    alarm = threading.Timer(patience, child.kill) if patience else None
    if alarm:
        alarm.start()
    failed = None
    for line in child.stdout:
        if line.startswith("test ") and line.rstrip().endswith("FAILED"):
            failed = line.split()[1]
            child.kill()
            break
    status = child.wait()
    if alarm:
        late = not alarm.is_alive()
        alarm.cancel()
        if late:
            return "no end", None
    if failed or status:
        return "noticed", failed or f"ended by {status}"
    return "survived", time.monotonic() - begin


def known(folder):
    """Outcomes of a run that was stopped."""
    file = folder / "outcomes.jsonl"
    lines = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
    return {entry.pop("key"): entry for entry in map(json.loads, lines)}


def report(changes, fates, seed, repository):
    """Counts by room, and the survivors with what docs/mutants.toml says about them."""
    said = tomllib.loads((repository / "docs" / "mutants.toml").read_text(encoding="utf-8")).get("survivor", [])
    rows = []
    for room in [*dict.fromkeys(change.room for change in changes), "all"]:
        own = [fate["fate"] for change, fate in zip(changes, fates) if room in (change.room, "all")]
        rows.append(f"| {room if room == 'all' else f'`{room}`'} | {len(own)} | {own.count('noticed')} | {own.count('no end')} | "
                    f"{own.count('survived')} |")
    lines = [f"{len(changes)} changes, drawn by seed {seed}:", "", "| room | changes | noticed | without end | survived |",
             "|---|---:|---:|---:|---:|", *rows]
    survivors = [change for change, fate in zip(changes, fates) if fate["fate"] == "survived"]
    if survivors:
        lines += ["", "| survivor | explanation |", "|---|---|"]
    for change in survivors:
        why = next((each["why"] for each in said if (each["file"], each["change"]) == (change.file, change.name)), "**not explained**")
        lines.append(f"| `{change.file}`: `{change.name}`".replace("||", "\\|\\|") + f" | {why} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
