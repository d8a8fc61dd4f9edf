"""Builds all changes into one copy of the source. Each is inactive until it is selected."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
from io import BytesIO

from changes import build_in, drawn

# special number instead of that of a change: changes that a run reaches are written to a file
WATCH = 4096
SWITCH = f'''//! Which change acts, and which ones a test reaches.
use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{{AtomicBool, Ordering}};
static CHOSEN: OnceLock<u32> = OnceLock::new();
static REACHED: [AtomicBool; {WATCH}] = [const {{ AtomicBool::new(false) }}; {WATCH}];
/// True if change `k` is active.
#[inline]
pub fn on(k: u32) -> bool {{
    let chosen = *CHOSEN.get_or_init(|| std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0));
    if chosen == {WATCH} {{
        reach(k);
    }}
    k == chosen
}}
#[cold]
fn reach(k: u32) {{
    if !REACHED[k as usize].swap(true, Ordering::Relaxed) {{
        let file = std::env::var("MUTANTS_REACHED").expect("a file");
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(file).expect("can be written");
        writeln!(file, "{{k}}").expect("can be written");
    }}
}}
'''


def say(fraction, what):
    """Moves the bar of the command that runs the campaign."""
    print(f"progress {fraction:.4f} {what}", file=sys.stderr, flush=True)


def built(repository, folder, judge, count, seed):
    """Returns `count` changes drawn by a seed, and cargo's messages about the judge's command with all of them. Changes that do not compile
    are replaced by others."""
    source, refused = folder / "source", set()
    for _ in range(20):
        shutil.rmtree(source, ignore_errors=True)
        archive = subprocess.run(["git", "archive", "HEAD"], cwd=repository, check=True, capture_output=True).stdout
        tarfile.open(fileobj=BytesIO(archive)).extractall(source, filter="data")
        judge.prepare(source)
        changes = drawn(source, judge, count, seed, refused)
        places = build_in(source, changes)
        (source / "src" / "mutants.rs").write_text(SWITCH, encoding="utf-8")
        with (source / "src" / "lib.rs").open("a", encoding="utf-8") as library:
            library.write("\npub mod mutants;\n")
        say(0.0, f"compiling {len(changes)} changes, {len(refused)} refused so far")
        errors, messages = compiled(source, folder, judge.build)
        if not errors:
            return changes, messages
        wrong = {change for file, begin, end in errors for first, last, change in places.get(file, []) if begin < last and first < end}
        if not wrong:
            raise SystemExit(f"the source does not compile: {errors[:3]}")
        refused |= wrong
    raise SystemExit("too many changes do not compile")


def compiled(source, folder, command):
    """Positions of errors (file, begin, end), and all messages."""
    settings = {"CARGO_PROFILE_RELEASE_CODEGEN_UNITS": "16", "RUSTFLAGS": "-Aunused -Anonstandard_style"}
    words = [*command, "--release", "-p", "bevel-differential", "--message-format", "json", "--target-dir", folder.resolve() / "build"]
    done = subprocess.run(words, cwd=source, env=os.environ | settings, capture_output=True, text=True)
    messages = [json.loads(line) for line in done.stdout.splitlines()]
    errors = [(span["file_name"], span["byte_start"], span["byte_end"]) for message in messages
              if message.get("reason") == "compiler-message" and message["message"]["level"] == "error" for span in message["message"]["spans"]]
    if done.returncode and not errors:
        raise SystemExit(done.stderr)
    return errors, messages


def active(number, **more):
    """Environment of a process in which a change is active."""
    return os.environ | {"MUTANT": str(number), **more}
