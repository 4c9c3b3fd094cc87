"""A Dask cluster that runs the missions, here or on many machines."""

from __future__ import annotations

import logging
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import TypeVar

import dask
from distributed import Client, Future, LocalCluster, wait

from rover_tools.scoreboard.errors import ScoreboardError
from rover_tools.scoreboard.missions import CompletedMission

CONNECT_SECONDS = 10.0  # [s] for the scheduler to answer
TICK_SECONDS = 1.0  # [s] between two calls while all missions go on
HOST = "127.0.0.1"
# Dask has each worker's memory trimmed all the time, for tasks on data frames. A rendered frame's
# arrays would be asked from the system anew each time, which costs a tenth of a mission's time.
ENVIRONMENT = "distributed.nanny.pre-spawn-environ"
MEMORY = {"MALLOC_TRIM_THRESHOLD_": 1 << 30, "MALLOC_MMAP_THRESHOLD_": 1 << 25}  # [bytes]

Outcome = CompletedMission | BaseException
J = TypeVar("J")  # a kind of MissionJob


@contextmanager
def local_cluster(workers: int) -> Iterator[Client]:
    """Workers on this machine: a process each, with one thread."""
    environment = {f"{ENVIRONMENT}.{name}": value for name, value in MEMORY.items()}
    with _workers_ignore_ctrl_c(), dask.config.set(environment):
        cluster = LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            host=HOST,
            memory_limit=0,  # a mission's memory does not grow; a limit would kill it
            dashboard_address=f"{HOST}:0",  # any free port; None would take a fixed one
            silence_logs=logging.CRITICAL,
        )
    with cluster, Client(cluster, timeout=CONNECT_SECONDS) as client:
        yield client


@contextmanager
def remote_cluster(address: str) -> Iterator[Client]:
    """The workers of a scheduler that runs already; raises ScoreboardError."""
    try:
        client = Client(address, timeout=CONNECT_SECONDS)
    except (OSError, ValueError) as error:
        raise ScoreboardError(f"no Dask scheduler at {address}: {error}") from error
    with client:
        yield client


def cluster(
    scheduler: str | None, workers: int | None, jobs: int
) -> AbstractContextManager[Client]:
    """The scheduler's cluster, or a local one with no more workers than jobs."""
    if scheduler is not None:
        return remote_cluster(scheduler)
    return local_cluster(max(1, min(workers or os.cpu_count() or 1, jobs)))


def run_all(
    client: Client,
    jobs: Sequence[J],
    run: Callable[[J], CompletedMission],
    on_start: Callable[[str], object] = lambda _: None,
    while_waiting: Callable[[], object] = lambda: None,
) -> Iterator[tuple[J, Outcome]]:
    """Run all jobs; each is yielded as soon as it is over, with the error if it raised one.

    `on_start` is called with a sentence when the first job runs, `while_waiting` every second.
    """
    # Not pure: the result of an earlier job of the same name must not be taken for it.
    futures = {client.submit(run, job, pure=False): job for job in jobs}
    client.wait_for_workers(1)
    on_start(f"the first missions have started; workers: {len(client.nthreads())}")
    while futures:
        for future in _completed(list(futures)):
            error = future.exception()
            yield futures.pop(future), future.result() if error is None else error
        while_waiting()


def _completed(futures: Sequence[Future]) -> set[Future]:
    """Those that are over, once there is one; none of them after a while."""
    try:
        return wait(futures, TICK_SECONDS, "FIRST_COMPLETED").done
    except TimeoutError:
        return set()


@contextmanager
def _workers_ignore_ctrl_c() -> Iterator[None]:
    """What is started in here inherits that Ctrl-C is ignored, so that it can be ended in order."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
