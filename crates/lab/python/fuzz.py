"""Random calls in several processes of the laboratory's program, so that a crash or a hang is reported with its seed.

usage: fuzz.py PROGRAM ROUNDS CALLS SEED COMMAND [FMI]    CALLS: per round; COMMAND: how users call the program"""

import json
import os
import subprocess
import sys
import textwrap
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed

from bevel_differential.text import markdown
from tools import Finding, lines, say

# a round takes several seconds, at most half a minute, and several times longer on a busy machine; a longer one hangs
PATIENCE = 600.0
HEAD = ["function", "calls", "OK", "warning", "discard", "error", "mean, µs", "longest, ms"]


class Broken(Exception):
    """A broken promise, a crash or a hang."""


class Workers:
    """Processes that execute `rounds` rounds of calls.

    `again`: command that repeats a round, without its seed; `begun`: seeds of all begun rounds."""

    def __init__(self, program, rounds, calls, again, version):
        self.command, self.again = [program, "fuzz", "--calls", str(calls), *version], again
        self.rounds, self.calls, self.begun, self.processes = rounds, calls, [], []

    def tallies(self, seed):
        """Counts of all processes. If one fails, the others are stopped."""
        crew = min(os.cpu_count() or 1, max(self.rounds, 1))
        ends = [seed + self.rounds * number // crew for number in range(crew + 1)]
        with ThreadPoolExecutor(crew) as pool:
            try:
                return [done.result() for done in as_completed([pool.submit(self.tally, *ends[k:k + 2]) for k in range(crew)])]
            except Broken as broken:
                raise Finding(str(broken)) from None
            finally:
                for process in self.processes:
                    process.kill()

    def tally(self, seed, end):
        """Counts of a process that executes the rounds with these seeds."""
        process = subprocess.Popen([*self.command, "--seed", str(seed), "--rounds", str(end - seed)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.processes.append(process)
        counts = None
        try:
            for line in lines(process, PATIENCE):
                if line.startswith("round "):
                    seed = line.split()[1]
                    done = len(self.begun)
                    self.begun.append(seed)
                    say(done / self.rounds, f"{done * self.calls} calls")
                else:
                    counts = json.loads(line)
        except TimeoutError:
            raise Broken(f"a round took more than {PATIENCE:g} s\nagain: {self.again} --seed {seed}") from None
        said, status = process.stderr.read().rstrip().removeprefix("error: "), process.wait()
        if counts is None:
            why = f"crashed (signal {-status})" if status < 0 else said or "a worker reported no counts"
            raise Broken("\n".join([why, f"again: {self.again} --seed {seed}", *([said] if status < 0 and said else [])]))
        return counts


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
    version, begin = ["--fmi", *sys.argv[6:]] if len(sys.argv) > 6 else [], time.monotonic()
    workers = Workers(program, rounds, calls, " ".join([command, *version, "--calls", str(calls)]), version)
    print(page(workers.tallies(seed)))
    print(f"every promise kept in {rounds} rounds, {time.monotonic() - begin:.0f} s")


if __name__ == "__main__":
    main()
