"""Workers: dask.distributed, quiet, without a dashboard."""

import asyncio
import logging
import multiprocessing
import os
from contextlib import contextmanager

from ..extras import needed
from ..values import DifferentialError

# a scheduler or its workers that do not answer so soon are not there, s
PATIENCE = 10.0
# a chunk whose worker died comes back at once: the farm tries its designs one by one, as one of them may be the cause
ALLOWED_FAILURES = 0
# a worker that takes longer to start again is given up for good
RESTART = 300.0
SETTINGS = {"distributed.scheduler.allowed-failures": ALLOWED_FAILURES, "distributed.deploy.lost-worker-timeout": f"{RESTART:g}s",
            "distributed.worker.multiprocessing-method": "spawn",
            "distributed.comm.timeouts.connect": f"{PATIENCE:g}s", "distributed.admin.log-length": 0}


@contextmanager
def client(workers: int | None, processes: bool, scheduler: str | None):
    """A dask client: of the scheduler at an address, or of an own cluster with one thread per worker."""
    dask, distributed = needed("dask", "sweep"), needed("distributed", "sweep")
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise DifferentialError("a worker process has run the script that started it; put what the script does below "
                                "if __name__ == \"__main__\":")
    log = logging.getLogger("distributed")
    level = log.level
    log.setLevel(logging.CRITICAL + 1)
    try:
        with dask.config.set(SETTINGS):
            opened = _connected(distributed, scheduler) if scheduler else _started(distributed, workers, processes)
            try:
                yield opened
            finally:
                _closed(opened, own=not scheduler)
    finally:
        log.setLevel(level)


def usual_workers() -> int:
    """As many as there are cores for this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _started(distributed, workers, processes):
    count = workers or usual_workers()
    sizes = {"n_workers": count, "threads_per_worker": 1} if processes else {"n_workers": 1, "threads_per_worker": count}
    cluster = distributed.LocalCluster(**sizes, processes=processes, dashboard_address=None, silence_logs=logging.CRITICAL + 1,
                                       memory_limit=0, host="127.0.0.1" if processes else None)
    # it listens for browsers even so
    cluster.loop.add_callback(cluster.scheduler.http_server.stop)
    return distributed.Client(cluster, set_as_default=False)


def _connected(distributed, scheduler):
    try:
        client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, asyncio.TimeoutError):
        raise DifferentialError(f"scheduler {scheduler}: nothing answers there; start one by dask scheduler, or leave it out to use "
                                "the cores of this machine") from None
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except asyncio.TimeoutError:
        client.close()
        raise DifferentialError(f"scheduler {scheduler}: it has no workers; start some by dask worker {scheduler}") from None
    return client


def _closed(client, own):
    cluster = client.cluster
    client.close()
    if own:
        cluster.close()
