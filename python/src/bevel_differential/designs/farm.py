"""Evaluates designs on many cores or machines."""

import pickle
import queue
import sys
import threading
import time
from collections import deque
from collections.abc import Generator, Iterable, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import closing
from typing import Any, Self

from ..extras import require
from ..interrupts import held_back
from ..values import DifferentialError, Number
from ..warned import warn
from . import cluster
from .task import Row, Task

# shortest and longest duration of a chunk, s: submitting it costs some ms; a worker that dies loses one or two chunks
SHORTEST, LONGEST = 0.1, 1.0
# number of chunks per worker into which the remaining designs are divided, so that all workers finish at about the same time
LAST_CHUNKS = 4
# chunks of each worker that run or wait, so that no worker is idle
AT_HAND = 2
# interval at which interrupts are checked, s
LOOK = 0.2
# time without any worker after which the farm gives up, s
NO_WORKER_TIMEOUT = 60.0


class Farm:
    """Workers that evaluate designs; a context manager, usable for any number of tasks.

    `workers`: their number (None: one per core; 0: none, the designs run in this thread, without dask). `processes`: true if each
    worker is a process; otherwise, workers are threads of this process. `scheduler`: address of a dask scheduler whose workers are
    used instead. `progress`: shows a bar on a terminal. The first run passes on its warnings of the FMU, and other runs the first warning of each further variable, as
    there may be thousands.
    Results do not depend on these options."""

    def __init__(self, workers: int | None = None, processes: bool = True, scheduler: str | None = None, progress: bool = False):
        if workers is not None and workers < 0:
            raise DifferentialError(f"workers = {workers}: it is 0 or more")
        self.workers, self.processes, self.scheduler, self.progress = workers, processes, scheduler, progress
        self._client: Any = None
        self._opened: Any = None
        self._warned = False
        self._variables: set[str] = set()

    def __enter__(self) -> Self:
        if self.workers != 0 or self.scheduler:
            self._opened = cluster.client(self.workers, self.processes, self.scheduler)
            self._client = self._opened.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        if self._client is not None:
            self._client = None
            self._opened.__exit__(None, None, None)

    def evaluate(self, task: Task, designs: Iterable[tuple[int, Mapping[str, Number]]]) -> list[Row]:
        """Rows of all designs [(run, values)], in order of run."""
        return sorted(self.rows(task, designs), key=lambda row: row.run)

    def rows(self, task: Task, designs: Iterable[tuple[int, Mapping[str, Number]]]) -> Generator[Row, None, None]:
        """Rows in the order of completion. `task`: a `Task`, or an object that has its `evaluate` and `close` and can be pickled."""
        designs = list(designs)
        rows = self._here(task, designs) if self._client is None else _TaskRun(self._client, task, designs).rows()
        rows = self._passing_on(rows, [run for run, _ in designs])
        return _with_bar(rows, len(designs)) if self.progress and sys.stderr.isatty() else rows

    def _passing_on(self, rows, order):
        """Yields the rows. Passes on the warnings of the first run in `order` that did not fail, and the first warning of each other
        variable with the number of its run, once for this farm."""
        index, waiting, later = 0, {}, []
        with closing(rows):
            for row in rows:
                if not self._warned:
                    waiting[row.run] = row.warnings
                    while not self._warned and index < len(order) and order[index] in waiting:
                        found, index = waiting[order[index]], index + 1
                        if found is not None:
                            self._warned = True
                            self._variables.update(map(_variable, found))
                            warn(found)
                later += [(row.run, text) for text in row.warnings or ()]
                if self._warned:
                    self._pass_on_others(later)
                    later = []
                yield row

    def _pass_on_others(self, warnings):
        for run, text in warnings:
            if _variable(text) not in self._variables:
                self._variables.add(_variable(text))
                warn([f"design {run}: {text}"])

    @staticmethod
    def _here(task, designs):
        for run, values in designs:
            yield task.evaluate(run, values)


def _variable(warning):
    """Variable of a warning, or its beginning."""
    return warning.partition(":")[0]


class _TaskRun:
    """Evaluation of the designs of one task by the workers."""

    def __init__(self, client, task, designs):
        self.client, self.left, self.packed = client, deque(designs), pickle.dumps(task)
        self.under_way, self.ended, self.seconds = {}, queue.SimpleQueue(), None
        # designs of chunks whose worker died, which are retried individually; designs whose worker died again, which are retried alone
        self.retry_individually, self.retry_alone = deque(), []

    def rows(self):
        try:
            # an interrupt inside dask may be lost, so it is held back until dask returns
            with held_back():
                self._fill()
            while self.under_way:
                with held_back() as interrupts:
                    rows = self._ended(interrupts)
                yield from rows
        except (CancelledError, OSError):
            raise DifferentialError("the scheduler is gone; start it again and resume", kind="failed") from None
        finally:
            self.client.cancel(list(self.under_way))

    def _ended(self, interrupts):
        """Rows of a chunk that has ended; empty at an interrupt."""
        future = self._next(interrupts)
        if future is None:
            return []
        rows = self._taken(self.under_way.pop(future), future)
        self._fill()
        return rows

    def _next(self, interrupts):
        """Future that has ended, or None at an interrupt."""
        seen = time.monotonic()
        while not interrupts:
            try:
                return self.ended.get(timeout=LOOK)
            except queue.Empty:
                now = time.monotonic()
                seen = now if self.client.nthreads() else seen
                if now - seen > NO_WORKER_TIMEOUT:
                    raise DifferentialError(f"all workers have been gone for {NO_WORKER_TIMEOUT:g} s; start some and resume",
                                            kind="failed") from None

    def _fill(self):
        """Hands out chunks until all workers have enough."""
        workers = max(1, sum(self.client.nthreads().values()))
        while (self.left or self.retry_individually) and len(self.under_way) < AT_HAND * workers:
            size = 1 if self.retry_individually else min(self._size(workers), len(self.left))
            source = self.retry_individually or self.left
            self._submit([source.popleft() for _ in range(size)])
        if self.retry_alone and not self.under_way:
            # without other designs under way, so that none of them can be the cause if the worker dies
            self._submit([self.retry_alone.pop()], alone=True)

    def _submit(self, chunk, alone=False):
        future = self.client.submit(evaluated, self.packed, chunk, pure=False)
        self.under_way[future] = chunk, alone
        future.add_done_callback(self.ended.put)

    def _size(self, workers):
        """Number of designs in the next chunk."""
        if self.seconds is None:
            return 1
        share = len(self.left) * self.seconds / (LAST_CHUNKS * workers)
        return max(1, round(min(max(share, SHORTEST), LONGEST) / self.seconds))

    def _taken(self, submitted, future):
        """Rows of a chunk that has ended; empty if its worker died and the designs are retried."""
        from distributed import KilledWorker
        chunk, alone = submitted
        try:
            rows = future.result()
        except KilledWorker:
            if alone:
                return [Row(run, dict(values), message="its worker process died each time") for run, values in chunk]
            # one by one, to find the design that ends the worker
            (self.retry_alone if len(chunk) == 1 else self.retry_individually).extend(chunk)
            return []
        recent = sum(row.seconds for row in rows) / len(rows)
        self.seconds = max(1e-6, recent if self.seconds is None else 0.5 * (self.seconds + recent))
        return rows


def _with_bar(rows, total):
    # closing this generator early also closes `rows`, which cancels the designs under way
    with closing(rows):
        yield from require("tqdm", "sweep").tqdm(rows, total=total, unit=" designs", dynamic_ncols=True)


# on a worker: the last task and its pickled form, per thread, because an instance belongs to one thread
_of_thread = threading.local()


def evaluated(packed: bytes, chunk: Sequence[tuple[int, Mapping[str, Number]]]) -> list[Row]:
    """Evaluates a chunk on a worker. Each chunk brings the pickled task. The worker caches the task, with the FMU's instance, for the
    next chunks."""
    if getattr(_of_thread, "packed", None) != packed:
        if hasattr(_of_thread, "task"):
            _of_thread.task.close()
        _of_thread.task, _of_thread.packed = pickle.loads(packed), packed
    return [_of_thread.task.evaluate(run, values) for run, values in chunk]
