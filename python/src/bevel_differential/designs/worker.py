"""What happens on a worker of dask: a task comes packed with each chunk of designs, and is kept for the next ones."""

import pickle
import threading
from collections.abc import Mapping, Sequence

from ..values import Number
from .task import Row

# of this thread, as an instance belongs to one: the last task, and how it was packed
_own = threading.local()


def evaluated(packed: bytes, chunk: Sequence[tuple[int, Mapping[str, Number]]]) -> list[Row]:
    """Rows of a chunk. The task is kept, and with it the FMU's instance."""
    if getattr(_own, "packed", None) != packed:
        if hasattr(_own, "task"):
            _own.task.close()
        _own.task, _own.packed = pickle.loads(packed), packed
    return [_own.task.evaluate(run, values) for run, values in chunk]
