"""One run of the graph: a domain, a port, a result folder, the processes, and the watch."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rover_tools.output import note
from rover_tools.runner.domain import reserved_domain
from rover_tools.runner.graph import HOST, NODES, default_parameters, free_port, start_graph
from rover_tools.runner.node_watch import GraphWatch
from rover_tools.runner.processes import Processes

READY_SECONDS = 30.0  # [s] for all nodes to find each other


@dataclass(frozen=True)
class Run:
    """A running graph, ready to be connected to."""

    folder: Path  # where results go
    host: str
    port: int
    domain_id: int
    processes: Processes
    watch: GraphWatch

    def wait_ready(self, nodes: Collection[str] = NODES) -> None:
        """Until all these nodes are connected; raises GraphNotReadyError or ProcessDiedError."""
        self.watch.wait_ready(list(nodes), self.processes.check, READY_SECONDS)


@contextmanager
def running_graph(
    folder: Path,
    overrides: Mapping[str, Mapping[str, object]] | None = None,
    parameters_file: Path | None = None,
) -> Iterator[Run]:
    """Start the graph and wait until its nodes are connected; everything ends with the block.

    Raises DomainError, GraphNotReadyError or ProcessDiedError.
    """
    with started_graph(folder, overrides, parameters_file) as run:
        run.wait_ready()
        yield run


@contextmanager
def started_graph(
    folder: Path,
    overrides: Mapping[str, Mapping[str, object]] | None = None,
    parameters_file: Path | None = None,
    nodes: Collection[str] = NODES,
) -> Iterator[Run]:
    """Start these nodes, which may lack a peer; everything ends with the block.

    Raises DomainError.
    """
    with reserved_domain() as domain_id:
        environment = {"ROS_DOMAIN_ID": str(domain_id)}
        port = free_port()
        with (
            Processes(folder / "log", environment) as processes,
            GraphWatch(domain_id) as watch,
        ):
            parameters = parameters_file or default_parameters()
            start_graph(processes, port, parameters, overrides or {}, nodes)
            note(f"starting the graph; watch it with ROS_DOMAIN_ID={domain_id}")
            yield Run(folder, HOST, port, domain_id, processes, watch)
