"""Observes the rover's running graph from outside: its map, its rocks, its mission's state."""

from __future__ import annotations

import time

from nav_msgs.msg import OccupancyGrid
from rover_interfaces.msg import MissionState, RockTrackArray

from rover_common import topics
from rover_common.ros import conversions, qos
from rover_common.types import GridMap, RockTrack
from rover_tools.runner.node_diagnostics import DiagnosticsWatch


class GraphWatch(DiagnosticsWatch):
    """What it holds may be read from any thread."""

    def __init__(self, domain_id: int) -> None:
        super().__init__(domain_id)
        self.grid: OccupancyGrid | None = None
        self._rocks: RockTrackArray | None = None
        self.mission: MissionState | None = None
        subscribe = self.node.create_subscription
        subscribe(OccupancyGrid, topics.WORLDMAP, self._on_grid, qos.LATCHED)
        subscribe(RockTrackArray, topics.ROCKS, self._on_rocks, qos.LATCHED)
        subscribe(MissionState, topics.MISSION_STATE, self._on_mission, qos.LATCHED)
        self.start()

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

    def _on_grid(self, message: OccupancyGrid) -> None:
        self.grid = message

    def _on_rocks(self, message: RockTrackArray) -> None:
        self._rocks = message

    def _on_mission(self, message: MissionState) -> None:
        self.mission = message
