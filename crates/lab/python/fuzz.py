"""Random calls in several processes of the laboratory's program, so that a crash or a hang is reported with its seed.

usage: fuzz.py PROGRAM ROUNDS CALLS SEED COMMAND [FMI]    CALLS: per round; COMMAND: how users call the program"""

import json
import os
import queue
import subprocess
import sys
import textwrap
import threading
import time
from collections import Counter

from bevel_differential.text import markdown
from tools import Finding, say

# a round takes several seconds, at most half a minute, and several times longer on a busy machine; a longer one hangs
PATIENCE = 600.0
HEAD = ["function", "calls", "OK", "warning", "discard", "error", "mean, µs", "longest, ms"]


class Worker:
    """A process that executes rounds, starting with a seed.

    `round`: seed of the present round; `rounds`: number of begun rounds; `tally`: its counts; `why`: reason for its failure."""

    def __init__(self, program, seed, rounds, calls, command, version):
        self.again = " ".join([command, *version, "--calls", str(calls), "--seed "])
        self.round, self.rounds, self.tally, self.why, self.since = seed, 0, None, None, time.monotonic()
        self.process = subprocess.Popen([program, "fuzz", "--seed", str(seed), "--rounds", str(rounds), "--calls", str(calls), *version], text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def follow(self, ended):
        """Reads its output until it ends, and puts it into the queue `ended`."""
        for line in self.process.stdout:
            self.since = time.monotonic()
            if line.startswith("round "):
                self.round, self.rounds = int(line.split()[1]), self.rounds + 1
            else:
                self.tally = json.loads(line)
        messages = self.process.stderr.read().rstrip().removeprefix("error: ")
        status = self.process.wait()
        if self.tally is None and self.why is None:
            what = f"crashed (signal {-status})" if status < 0 else messages or "a worker reported no counts"
            self.why = f"{what}\nagain: {self.again}{self.round}" + (f"\n{messages}" if status < 0 else "")
        ended.put(self)

    def stop(self, why):
        """Ends the process unless it has ended; `why` may be empty."""
        if self.process.poll() is None:
            self.why = why
            self.process.kill()


def worked(workers, rounds, calls):
    """Waits for all workers. If one fails, the others are stopped."""
    ended, left = queue.Queue(), set(workers)
    for worker in workers:
        threading.Thread(target=worker.follow, args=[ended], daemon=True).start()
    while left:
        try:
            last = ended.get(timeout=0.2)
            left.discard(last)
            if last.why:
                for worker in left:
                    worker.stop("")
        except queue.Empty:
            for worker in left:
                if time.monotonic() - worker.since > PATIENCE:
                    worker.stop(f"a round took more than {PATIENCE:g} s\nagain: {worker.again}{worker.round}")
        done = sum(worker.rounds - (worker.tally is None) for worker in workers)
        say(max(done, 0) / max(rounds, 1), f"{max(done, 0) * calls} calls")
    failures = [worker.why for worker in workers if worker.why]
    if failures:
        raise Finding("\n\n".join(failures))
    return [worker.tally for worker in workers]


def page(tallies):
    """Table of calls, and other counts."""
    statuses, seconds, longest = {}, Counter(), Counter()
    for row in (row for tally in tallies for row in tally["rows"]):
        name = row["function"]
        statuses[name] = [a + b for a, b in zip(statuses.get(name, [0] * 4), row["statuses"])]
        for place in (name, "all"):
            seconds[place] += row["seconds"]
            longest[place] = max(longest[place], row["longest"])
    statuses["all"] = [sum(column) for column in zip(*statuses.values())]
    rows = [[name, *map(str, (sum(counts), *counts)), f"{1e6 * seconds[name] / max(sum(counts), 1):.1f}", f"{1e3 * longest[name]:.1f}"]
            for name, counts in statuses.items()]
    most = max((tally["longest"] for tally in tallies), key=lambda call: call["seconds"])
    scenes, compared, updates = (sum(tally[name] for tally in tallies) for name in ("scenes", "compared", "updates"))

    def done(name):
        return sum(statuses.get(f"fmi{version}{name}", [0])[0] for version in (2, 3))

    text = (f"longest call: {most['function'] or 'none'}, {most['seconds']:.3f} s of the processor (call {most['at']} of the round "
            f"with seed {most['seed']}); simulations started: {scenes}; communication steps done: {done('DoStep')}; updates within them: "
            f"{updates}; steps completed in model exchange: {done('CompletedIntegratorStep')}; states compared before and after a call: "
            f"{compared}")
    return f"{markdown([HEAD, *rows])}\n{textwrap.fill(text, 118)}"


def main():
    program, rounds, calls, seed, command = sys.argv[1], *map(int, sys.argv[2:5]), sys.argv[5]
    version = ["--fmi", *sys.argv[6:]] if len(sys.argv) > 6 else []
    begin, first, workers = time.monotonic(), seed, []
    crew = min(os.cpu_count() or 1, max(rounds, 1))
    for k in range(crew):
        share = rounds // crew + (k < rounds % crew)
        workers.append(Worker(program, first, share, calls, command, version))
        first += share
    print(page(worked(workers, rounds, calls)))
    print(f"every promise kept in {rounds} rounds, {time.monotonic() - begin:.0f} s")


if __name__ == "__main__":
    main()
