"""Workers of dask.distributed, without log messages and dashboard."""

import logging
import os
import signal
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import TYPE_CHECKING

from ..extras import require
from ..values import DifferentialError
from ..writing import refuse_in_worker

if TYPE_CHECKING:
    from distributed import Client

# no message has this level
SILENT = logging.CRITICAL + 1
# time limit for a scheduler and its workers to answer, s
ANSWER_TIMEOUT = 5.0
# if a worker dies, its chunk is returned immediately: the farm retries the designs one by one, as one of them may be the cause
ALLOWED_FAILURES = 0
# a worker that needs longer to restart is given up
RESTART = 300.0
SETTINGS = {
    "distributed.scheduler.allowed-failures": ALLOWED_FAILURES, "distributed.deploy.lost-worker-timeout": f"{RESTART:g}s",
    "distributed.worker.multiprocessing-method": "spawn", "distributed.comm.timeouts.connect": f"{ANSWER_TIMEOUT:g}s",
    # dask's measurements of itself are not used
    "distributed.worker.profile.enabled": False, "distributed.admin.system-monitor.interval": "10s",
    "distributed.admin.tick.interval": "500ms", "distributed.admin.log-length": 0,
}


@contextmanager
def client(workers: int | None, processes: bool, scheduler: str | None) -> "Iterator[Client]":
    """Dask client of the scheduler at an address, or of a new cluster with one thread per worker."""
    dask, distributed = require("dask", "sweep"), require("distributed", "sweep")
    refuse_in_worker()
    with _quiet(), dask.config.set(SETTINGS):
        opened = _connected(distributed, scheduler) if scheduler else _started(distributed, workers, processes)
        try:
            yield opened
        finally:
            cluster = opened.cluster
            opened.close()
            if not scheduler:
                cluster.close()


def usual_workers() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _started(distributed, workers, processes):
    count = workers or usual_workers()
    sizes = {"n_workers": count, "threads_per_worker": 1} if processes else {"n_workers": 1, "threads_per_worker": count}
    with _interrupts_only_for_this_process(), warnings.catch_warnings():
        # dask warns if another cluster uses the port of its dashboard
        warnings.simplefilter("ignore", UserWarning)
        try:
            cluster = distributed.LocalCluster(**sizes, processes=processes, dashboard_address=None, silence_logs=SILENT,
                                               memory_limit=0, host="127.0.0.1" if processes else None)
        except RuntimeError as error:
            raise DifferentialError(f"the workers do not start ({error}); a script must start them below if __name__ == \"__main__\":, "
                                    "because each worker reads the script", kind="failed") from None
    # the cluster opens a port for browsers even without a dashboard
    cluster.loop.add_callback(cluster.scheduler.http_server.stop)
    return distributed.Client(cluster, set_as_default=False)


@contextmanager
def _quiet():
    """Silences the log of dask, because errors contain the important messages."""
    logs = [logging.getLogger(name) for name in ("distributed", *logging.root.manager.loggerDict)
            if name.partition(".")[0] == "distributed"]
    levels = [log.level for log in logs]
    for log in logs:
        log.setLevel(SILENT)
    try:
        yield
    finally:
        for log, level in zip(logs, levels):
            log.setLevel(level)


@contextmanager
def _interrupts_only_for_this_process():
    """Hides Ctrl-C from threads and processes that start in this context, and from their children. This process receives it at the
    end of the context."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    # multiprocessing starts its resource tracker with the first worker, which would end the blocking: start it before
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _connected(distributed, scheduler):
    try:
        client = distributed.Client(scheduler, timeout=ANSWER_TIMEOUT, set_as_default=False)
    except (OSError, ValueError, TimeoutError):
        raise DifferentialError(f"scheduler {scheduler}: nothing answers there; start one by dask scheduler, or leave it out to "
                                "use the cores of this machine", kind="failed") from None
    try:
        client.wait_for_workers(1, timeout=ANSWER_TIMEOUT)
    except TimeoutError:
        client.close()
        raise DifferentialError(f"scheduler {scheduler}: it has no workers; start some by dask worker {scheduler}", kind="failed") from None
    return client
