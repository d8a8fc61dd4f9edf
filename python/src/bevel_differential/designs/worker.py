"""What happens on a worker of dask: a task is delivered once, kept, and evaluates chunks of designs."""

import pickle
import threading
from collections.abc import Mapping, Sequence

from distributed import Worker, WorkerPlugin

from ..values import Number
from .task import Row

# tasks as they were delivered to this process, by key
_delivered: dict[str, bytes] = {}
# of this thread, as an instance belongs to one: the last task and its key
_own = threading.local()


class Delivery(WorkerPlugin):
    """Brings a pickled task to all workers, also to those that start later."""

    def __init__(self, key: str, packed: bytes):
        self.name, self.key, self.packed = f"task-{key}", key, packed

    def setup(self, worker: Worker) -> None:
        _delivered[self.key] = self.packed

    def teardown(self, worker: Worker) -> None:
        _delivered.pop(self.key, None)


def evaluated(key: str, chunk: Sequence[tuple[int, Mapping[str, Number]]]) -> list[Row]:
    """Rows of a chunk. The task is kept, and with it the FMU's instance."""
    if getattr(_own, "key", None) != key:
        if hasattr(_own, "task"):
            _own.task.close()
        _own.task, _own.key = pickle.loads(_delivered[key]), key
    return [_own.task.evaluate(run, values) for run, values in chunk]
