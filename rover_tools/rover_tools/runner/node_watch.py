"""Observes the running graph from outside: its readiness, its map, its rocks, its state."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from nav_msgs.msg import OccupancyGrid
from rover_interfaces.msg import MissionState, RockTrackArray

from rover_common import topics
from rover_common.errors import RoverError
from rover_common.ros import conversions, qos
from rover_common.types import GridMap, RockTrack
from rover_tools.runner.node_in_domain import NodeInDomain


class GraphNotReadyError(RoverError):
    """The nodes did not all connect in time."""


class GraphWatch(NodeInDomain):
    """A node in a thread of its own; what it holds may be read from any thread."""

    def __init__(self, domain_id: int) -> None:
        super().__init__("watch", domain_id)
        self.diagnostics: dict[str, DiagnosticStatus] = {}
        self.grid: OccupancyGrid | None = None
        self._rocks: RockTrackArray | None = None
        self.mission: MissionState | None = None
        subscribe = self.node.create_subscription
        subscribe(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.DIAGNOSTICS)
        subscribe(OccupancyGrid, topics.WORLDMAP, self._on_grid, qos.LATCHED)
        subscribe(RockTrackArray, topics.ROCKS, self._on_rocks, qos.LATCHED)
        subscribe(MissionState, topics.MISSION_STATE, self._on_mission, qos.LATCHED)
        self._stop = False
        self._thread = threading.Thread(target=self._spin, name="graph-watch")
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

    def wait_map(self, stamp: int, timeout: float) -> GridMap | None:
        """The world map once it holds the frame of this stamp [ns]; else the newest one, if any."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            grid = self.grid
            if grid is not None and conversions.stamp_of(grid.header.stamp) >= stamp:
                break
            time.sleep(0.02)
        return None if self.grid is None else conversions.grid_of(self.grid)

    def wait_rocks(self, timeout: float) -> tuple[RockTrack, ...]:
        """The rocks once any message of them has come; none where none does."""
        end = time.monotonic() + timeout
        while self._rocks is None and time.monotonic() < end:
            time.sleep(0.02)
        return self.rocks()

    def rocks(self) -> tuple[RockTrack, ...]:
        return () if self._rocks is None else conversions.rocks_of(self._rocks)

    def counts(self) -> dict[str, dict[str, int]]:
        """The nodes' counters by node name."""
        return {
            name.rsplit("/", 1)[-1]: {v.key: int(v.value) for v in status.values}
            for name, status in self.diagnostics.items()
        }

    def close(self) -> None:
        self._stop = True
        self._thread.join()
        super().close()

    def _spin(self) -> None:
        while not self._stop:
            self.executor.spin_once(timeout_sec=0.05)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            self.diagnostics[status.name] = status

    def _on_grid(self, message: OccupancyGrid) -> None:
        self.grid = message

    def _on_rocks(self, message: RockTrackArray) -> None:
        self._rocks = message

    def _on_mission(self, message: MissionState) -> None:
        self.mission = message
