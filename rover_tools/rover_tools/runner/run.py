"""One run of the graph: a domain, a port, a result folder, the processes, and the watch."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from rover_common.ros.shared_memory import remove_stale_memory
from rover_tools.output import note
from rover_tools.runner.domain import reserved_domain
from rover_tools.runner.graph import HOST, NODES, default_parameters, free_port, start_graph
from rover_tools.runner.node_diagnostics import DiagnosticsWatch
from rover_tools.runner.node_watch import GraphWatch
from rover_tools.runner.processes import Processes

READY_SECONDS = 30.0  # [s] for all nodes to find each other


W = TypeVar("W", bound=DiagnosticsWatch)


@dataclass(frozen=True)
class ProcessRun(Generic[W]):
    """Processes in a domain of their own, and who watches them."""

    folder: Path  # where results go
    domain_id: int
    processes: Processes
    watch: W

    def wait_ready(self, nodes: Collection[str] = NODES) -> None:
        """Until all these nodes are connected; raises GraphNotReadyError or ProcessDiedError."""
        self.watch.wait_ready(list(nodes), self.processes.check, READY_SECONDS)


@dataclass(frozen=True)
class Run(ProcessRun[GraphWatch]):
    """The rover's running graph, ready to be connected to."""

    host: str
    port: int


@contextmanager
def reserved_run(folder: Path, watch: Callable[[int], W]) -> Iterator[ProcessRun[W]]:
    """No process yet; everything ends with the block.

    watch: makes the watch of a domain. Raises DomainError.
    """
    remove_stale_memory()
    with reserved_domain() as domain_id:
        environment = {"ROS_DOMAIN_ID": str(domain_id)}
        with Processes(folder / "log", environment) as processes, watch(domain_id) as watching:
            yield ProcessRun(folder, domain_id, processes, watching)


@contextmanager
def running_graph(
    folder: Path,
    overrides: Mapping[str, Mapping[str, object]] | None = None,
    parameters_file: Path | None = None,
    watch: Callable[[int], GraphWatch] = GraphWatch,
) -> Iterator[Run]:
    """Start the graph and wait until its nodes are connected; everything ends with the block.

    watch: makes the watch of a domain. Raises DomainError, GraphNotReadyError or ProcessDiedError.
    """
    with started_graph(folder, overrides, parameters_file, NODES, watch) as run:
        run.wait_ready()
        yield run


@contextmanager
def started_graph(
    folder: Path,
    overrides: Mapping[str, Mapping[str, object]] | None = None,
    parameters_file: Path | None = None,
    nodes: Collection[str] = NODES,
    watch: Callable[[int], GraphWatch] = GraphWatch,
) -> Iterator[Run]:
    """Start these nodes, which may lack a peer; everything ends with the block.

    Raises DomainError.
    """
    port = free_port()
    with reserved_run(folder, watch) as begun:
        parameters = parameters_file or default_parameters()
        start_graph(begun.processes, port, parameters, overrides or {}, nodes)
        note(f"starting the graph; watch it with ROS_DOMAIN_ID={begun.domain_id}")
        yield Run(folder, begun.domain_id, begun.processes, begun.watch, HOST, port)
