"""Ordinary drives on the packaged FMU, checked against the requirements of tests/python/drive_requirements.py.

usage: drives.py FMU FOLDER SEED COUNT COMMAND            COUNT drives, alternating between three seeds; COMMAND: how users call the program
       drives.py FMU FOLDER SEED COUNT COMMAND INDEX      one drive, in detail

Prints tables of the most expensive drives and of violated requirements. Fails if a requirement is violated. FOLDER contains the data of
each drive that violates a requirement as JSON, for players in other languages."""

import json
import os
import queue
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path

from bevel_differential import DifferentialWarning, Fmu
from bevel_differential.text import aligned
from effects_list import effects
from tools import WORKSPACE, Finding, lines, say, significant

sys.path.append(str(WORKSPACE / "tests" / "python"))
import drive_requirements  # noqa: E402
import ordinary_drives  # noqa: E402
from drive_player import play  # noqa: E402

SEEDS, WORKERS = 3, 2
# number of drives in the table of cost, and of characters of a message in the table of violations
SHOWN, LETTERS = 12, 150
# Time after which a drive counts as hanging [s]; the requirement on processor time is far below.
PATIENCE = 120.0
HEAD = ["seed", "index", "drive", "processor, s", "simulated, s", "steps", "granted", "impacts", "swings", "energy residual"]


def drawn(fmu, seed, number):
    """Drive `number` of a run, from alternating seeds."""
    levels = {effect.name: effect.contact for effect in effects(fmu)}
    return ordinary_drives.drive(seed + number % SEEDS, number // SEEDS, levels)


def judged(fmu, drive):
    """Verdict on a drive, as a dictionary."""
    begin = time.process_time()
    played = play(fmu, drive)
    return vars(drive_requirements.judge(fmu, drive, time.process_time() - begin, played))


def work(file, seed, first, count):
    """Work of a process: prints verdicts on every `WORKERS`-th drive, starting with `first`."""
    fmu = Fmu.of(file)
    for number in range(first, count, WORKERS):
        print(json.dumps({"number": number, **judged(fmu, drawn(file, seed, number))}), flush=True)


class Worker:
    """A process that executes a share of the drives. It is replaced if it crashes or hangs.

    `next`: number of the next drive; `count`: number of all drives."""

    def __init__(self, file, seed, share, count):
        self.file, self.seed, self.next, self.count = file, seed, share, count

    def verdicts(self, found):
        """Puts all verdicts of the share into the queue `found`, followed by None."""
        while self.next < self.count:
            numbers = map(str, (self.seed, self.next, self.count))
            command = [sys.executable, os.path.abspath(__file__), "work", self.file, *numbers]
            process = subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            end = self._follow(process, found)
            if self.next < self.count:
                found.put({"number": self.next, **vars(drive_requirements.Verdict([end]))})
                self.next += WORKERS
        found.put(None)

    def _follow(self, process, found):
        """Passes verdicts on until the process ends. Returns the reason for its end."""
        try:
            for line in lines(process, PATIENCE):
                record = json.loads(line)
                found.put(record)
                self.next = record["number"] + WORKERS
        except TimeoutError as error:
            return str(error)
        said = process.stderr.read().strip().splitlines()[-1:]
        return f"the process ended with {process.wait()}: {' '.join(said)}"


def run(file, seed, count):
    """Verdicts on all drives, in their order."""
    found, records, ended = queue.Queue(), [], 0
    for share in range(WORKERS):
        threading.Thread(target=Worker(file, seed, share, count).verdicts, args=[found], daemon=True).start()
    while ended < WORKERS:
        record = found.get()
        if record is None:
            ended += 1
            continue
        records.append(record)
        violated = sum(bool(record["problems"]) for record in records)
        say(len(records) / max(count, 1), f"{len(records)} of {count} drives, {violated} violate a requirement")
    return sorted(records, key=lambda record: record["number"])


def described(drive):
    """Short description of a drive."""
    start = drive["start"]
    words = [drive["manoeuvre"], start["scene.gear_contact"], start.get("contact.law"), start.get("solver.method"),
             f"{1e3 * drive['step']:g} ms", "FMI 3.0" if drive["fmi"] == "3.0" else None,
             "by speed" if start["scene.carrier_drive"] == "speed" else None, "mirrored" if drive["mirrored"] else None]
    return " ".join(filter(None, words))


def report(file, folder, seed, records):
    """Returns tables of cost and of violations; writes the drives that violate a requirement."""
    drives = {record["number"]: drawn(file, seed, record["number"]) for record in records}
    rows = [HEAD]
    for record in sorted(records, key=lambda record: -(record["seconds"] or 0.0))[:SHOWN]:
        drive = drives[record["number"]]
        counted = ["–" if record[name] is None else str(record[name]) for name in ("impacts", "swings")]
        rows.append([str(drive["seed"]), str(drive["index"]), described(drive), significant(record["seconds"] or 0.0, 2),
                     significant(drive["stop"], 3), str(record["steps"]), str(record["granted"] or "–"), *counted,
                     significant(record["residual"], 2)])
    lines = ["The drives that take most time:", "", *aligned(rows, left=3)]
    violated = [record for record in records if record["problems"]]
    rows = [["seed", "index", "drive", "requirement"]]
    for record in violated:
        drive = drives[record["number"]]
        name = folder / f"{drive['seed']}-{drive['index']}.json"
        name.write_text(json.dumps(drive, indent=1), encoding="utf-8")
        rows += [[str(drive["seed"]), str(drive["index"]), described(drive), " ".join(problem.split())[:LETTERS]]
                 for problem in record["problems"]]
    if violated:
        lines += ["", "Violated requirements:", "", *aligned(rows, left=4)]
    return "\n".join(lines), len(violated)


def main():
    if sys.argv[1] == "work":
        file, seed, first, count = sys.argv[2], *map(int, sys.argv[3:])
        warnings.simplefilter("ignore", DifferentialWarning)
        work(file, seed, first, count)
        return
    file, folder, seed, count, command = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), sys.argv[5]
    if len(sys.argv) > 6:
        one(file, seed, int(sys.argv[6]))
        return
    for old in folder.glob("*.json"):
        old.unlink()
    begin, records = time.monotonic(), run(file, seed, count)
    text, violated = report(file, folder, seed, records)
    seconds = sum(record["seconds"] or 0.0 for record in records)
    end = f"{len(records)} drives, {seconds:.0f} s of processor time, {time.monotonic() - begin:.0f} s"
    if violated:
        raise Finding(f"\n{text}\n\n{violated} of {end}; again: {command} --seed SEED --index INDEX")
    print(f"{text}\n\nevery requirement is met in {end}")


def one(file, seed, index):
    """Prints one drive with its data and measurements."""
    drive = drawn(file, seed, SEEDS * index)
    verdict = judged(Fmu.of(file), drive)
    text = f"{json.dumps(drive, indent=1)}\n{json.dumps(verdict, indent=1)}"
    if verdict["problems"]:
        raise Finding(f"\n{text}")
    print(text)


if __name__ == "__main__":
    main()
