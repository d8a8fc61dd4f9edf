"""Evaluates designs on many cores or machines."""

import hashlib
import pickle
import queue
import sys
import threading
import time
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import CancelledError

from ..values import DifferentialError
from . import cluster
from .task import Row, Task

# time that a chunk takes, s: handing it out costs some ms; a worker that dies loses one or two
SHORTEST, LONGEST = 0.1, 1.0
# chunks that each worker still gets towards the end, so that all end at about the same time
LAST_CHUNKS = 4
# chunks that a worker has at hand, so that it never waits
AT_HAND = 2
# time without any worker after which none will come any more, s
DESERTED = 60.0


class Farm:
    """Workers that evaluate designs; a context manager, kept for as many tasks as one likes.

    `workers`: how many (None: one per core; 0: none, the designs run in this thread, without dask). `processes`: each worker is
    a process; otherwise threads of this one. `scheduler`: address of a dask scheduler whose workers are used instead.
    `progress`: shows a bar on a terminal. Results are the same for all of these."""

    def __init__(self, workers: int | None = None, processes: bool = True, scheduler: str | None = None, progress: bool = False):
        if workers is not None and workers < 0:
            raise DifferentialError(f"workers = {workers}: it is 0 or more")
        self.workers, self.processes, self.scheduler, self.progress = workers, processes, scheduler, progress
        self._client = self._opened = None

    def __enter__(self):
        if self.workers != 0 or self.scheduler:
            self._opened = cluster.client(self.workers, self.processes, self.scheduler)
            self._client = self._opened.__enter__()
        return self

    def __exit__(self, *_):
        if self._client is not None:
            self._client = None
            self._opened.__exit__(None, None, None)

    def evaluate(self, task: Task, designs: Iterable) -> list[Row]:
        """Rows of all designs [(run, values)], in order of run."""
        return sorted(self.rows(task, designs), key=lambda row: row.run)

    def rows(self, task: Task, designs: Iterable) -> Iterator[Row]:
        """Rows as they complete. `task`: a `Task`, or what has its `evaluate` and `close` and can be pickled."""
        designs = list(designs)
        rows = self._here(task, designs) if self._client is None else _Run(self._client, task, designs).rows()
        return _with_bar(rows, len(designs)) if self.progress and sys.stderr.isatty() else rows

    @staticmethod
    def _here(task, designs):
        for run, values in designs:
            yield task.evaluate(run, values)


class _Run:
    """Designs of one task on their way through the workers."""

    def __init__(self, client, task, designs):
        self.client, self.left = client, deque(designs)
        packed = pickle.dumps(task)
        self.key = hashlib.sha256(packed).hexdigest()
        # a result that dask makes again where the worker that held it has died
        self.task = client.submit(_kept, packed, key=f"task-{self.key}", pure=True)
        self.under_way, self.suspects, self.seconds, self.ended = {}, [], None, queue.SimpleQueue()

    def rows(self):
        try:
            self._fill()
            while self.under_way:
                future = self._next()
                yield from self._taken(self.under_way.pop(future), future)
                self._fill()
        except (CancelledError, OSError):
            raise DifferentialError("the scheduler is gone; start it again and go on") from None
        finally:
            self.client.cancel(list(self.under_way))

    def _next(self):
        """A future that has ended."""
        seen = time.monotonic()
        while True:
            try:
                return self.ended.get(timeout=1.0)
            except queue.Empty:
                now = time.monotonic()
                seen = now if self.client.nthreads() else seen
                if now - seen > DESERTED:
                    raise DifferentialError(f"all workers have been gone for {DESERTED:g} s; start some and go on") from None

    def _fill(self):
        """Hands out chunks until all workers have enough."""
        workers = max(1, sum(self.client.nthreads().values()))
        while self.left and len(self.under_way) < AT_HAND * workers:
            size = self._size(workers)
            self._submit([self.left.popleft() for _ in range(min(size, len(self.left)))])
        if self.suspects and not self.left and not self.under_way:
            # alone, so that no other design can be what the worker dies of
            self._submit([self.suspects.pop()], alone=True)

    def _submit(self, chunk, alone=False):
        future = self.client.submit(_evaluated, self.key, self.task, chunk, pure=False)
        self.under_way[future] = chunk, alone
        future.add_done_callback(self.ended.put)

    def _size(self, workers):
        """Designs in the next chunk."""
        if self.seconds is None:
            return 1
        share = len(self.left) * self.seconds / (LAST_CHUNKS * workers)
        return max(1, round(min(max(share, SHORTEST), LONGEST) / self.seconds))

    def _taken(self, submitted, future):
        """Rows of a chunk that has ended."""
        from distributed import KilledWorker
        chunk, alone = submitted
        try:
            rows = future.result()
        except KilledWorker:
            if alone:
                return [Row(run, dict(values), message="its worker process died each time") for run, values in chunk]
            if len(chunk) == 1:
                self.suspects += chunk
            # one by one, to find the design that does it
            for design in chunk if len(chunk) > 1 else []:
                self.left.appendleft(design)
            self.seconds = None
            return []
        recent = sum(row.seconds for row in rows) / len(rows)
        self.seconds = max(1e-6, recent if self.seconds is None else 0.5 * (self.seconds + recent))
        return rows


# of this thread, as an instance belongs to one: the last task and its key
_own = threading.local()


def _kept(packed: bytes) -> bytes:
    return packed


def _evaluated(key: str, packed: bytes, chunk: Sequence) -> list[Row]:
    """Rows of a chunk, on a worker. The task is kept, and with it the FMU's instance."""
    if getattr(_own, "key", None) != key:
        if hasattr(_own, "task"):
            _own.task.close()
        _own.task, _own.key = pickle.loads(packed), key
    return [_own.task.evaluate(run, values) for run, values in chunk]


def _with_bar(rows, total):
    from tqdm import tqdm
    return tqdm(rows, total=total, unit=" designs", dynamic_ncols=True)
