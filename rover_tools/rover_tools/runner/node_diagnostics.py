"""Observes the running graph from outside; what it holds may be read from any thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from rover_common.errors import RoverError
from rover_common.ros import qos
from rover_common.ros.diagnostics import TEAM_STATUS
from rover_tools.runner.node_in_domain import NodeInDomain

PART = ": "  # between a node's name and that of one of its inputs or troubles


class GraphNotReadyError(RoverError):
    """The nodes did not all connect in time."""


class DiagnosticsWatch(NodeInDomain):
    """A node in a thread of its own, which hears of all nodes' readiness and counters."""

    def __init__(self, domain_id: int) -> None:
        super().__init__("watch", domain_id)
        self.diagnostics: dict[str, DiagnosticStatus] = {}
        self.node.create_subscription(
            DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS
        )
        self._stop = False
        self._thread = threading.Thread(target=self._spin, name="graph-watch")

    def start(self) -> None:
        """To be called once all subscriptions have been made."""
        self._thread.start()

    def ready(self, nodes: list[str]) -> bool:
        """Whether each of these nodes says that all its peers are connected."""
        found = {name.rsplit("/", 1)[-1]: status for name, status in self.diagnostics.items()}
        return all(node in found and found[node].level == DiagnosticStatus.OK for node in nodes)

    def wait_ready(self, nodes: list[str], check: Callable[[], None], timeout: float) -> None:
        """Wait until the nodes are ready, calling `check` meanwhile; raises GraphNotReadyError."""
        end = time.monotonic() + timeout
        while not self.ready(nodes):
            check()
            if time.monotonic() > end:
                states = [f"{s.name}: {s.message}" for s in self.diagnostics.values()]
                raise GraphNotReadyError(
                    f"the graph did not connect within {timeout:.0f} s: "
                    + ("; ".join(states) or "no node reported")
                )
            time.sleep(0.05)

    def counts(self) -> dict[str, dict[str, int]]:
        """The nodes' counters by node name."""
        return {
            name.rsplit("/", 1)[-1]: {
                v.key: int(v.value) for v in status.values if v.value.isdecimal()
            }
            for name, status in self.diagnostics.items()
            if PART not in name
        }

    @property
    def failure(self) -> str:
        """Why the graph does not work, as its nodes tell it; empty while it does."""
        team = [s for name, s in self.diagnostics.items() if name.endswith(f"/{TEAM_STATUS}")]
        return next((s.message for s in team if s.level == DiagnosticStatus.ERROR), "")

    def close(self) -> None:
        self._stop = True
        if self._thread.is_alive():
            self._thread.join()
        super().close()

    def _spin(self) -> None:
        while not self._stop:
            self.executor.spin_once(timeout_sec=0.05)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            self.diagnostics[status.name] = status
