"""Watches a mission for what it knows, and for whether all its nodes are at work."""

from __future__ import annotations

import math

import numpy as np
from nav_msgs.msg import Odometry
from rover_interfaces.msg import MissionState, RockTrackArray

from rover_common import topics
from rover_common.map_encoding import UNKNOWN
from rover_common.ros import conversions, qos
from rover_tools.chaos.losses import Knowledge, Ledger, Loss, Rock
from rover_tools.runner.node_watch import GraphWatch

KEPT = 500  # poses, by their stamps: more than come between two reports
LATER = 1_000_000_000  # [ns] of frames that nobody can have had in work before


class MissionWatch(GraphWatch):
    """The mission of `executor.Executor`, and the graph's watch of a run."""

    def __init__(self, domain_id: int, home: tuple[float, float]) -> None:
        """home: where the rover begins [m]."""
        self._home = home
        self._ledger = Ledger()
        self._poses: dict[int, tuple[float, float]] = {}  # [m] by stamp [ns]
        self._newest = 0  # [ns]
        self._home_error = 0.0  # [m]
        self._mark = 0  # [ns]
        super().__init__(domain_id)

    def start(self) -> None:
        self.node.create_subscription(Odometry, topics.ODOMETRY, self._on_odometry, qos.FRAME)
        super().start()

    def newest(self) -> int:
        """The stamp [ns] of the newest frame that was heard of."""
        return self._newest

    def mark(self) -> None:
        self._mark = self._newest

    def recovered(self) -> bool:
        """Bridge, perception and decision have a part in each report of the mission, and the first
        two in each map.
        """
        if self.mission is None or self.grid is None:
            return False
        reported, mapped = (
            conversions.stamp_of(message.header.stamp) for message in (self.mission, self.grid)
        )
        return reported >= self._mark + LATER and mapped >= self._mark

    def losses(self) -> list[Loss]:
        known = self._knowledge()
        return [] if known is None else self._ledger.losses(known)

    def _knowledge(self) -> Knowledge | None:
        mission, grid = self.mission, self.grid
        if mission is None:
            return None
        cells = 0 if grid is None else int(np.sum(np.frombuffer(grid.data, np.int8) != UNKNOWN))
        return Knowledge(
            run=mission.run,
            elapsed=mission.elapsed,
            samples_total=mission.samples_total,
            samples_collected=mission.samples_collected,
            home_error=self._home_error,
            cells=cells,
            rocks=tuple(Rock(rock.id, rock.x, rock.y) for rock in self.rocks()),
        )

    def _on_odometry(self, message: Odometry) -> None:
        q, position = message.pose.pose.orientation, message.pose.pose.position
        if (q.x, q.y, q.z, q.w) == (0.0, 0.0, 0.0, 0.0):
            return  # a fault
        self._newest = conversions.stamp_of(message.header.stamp)
        self._poses[self._newest] = (position.x, position.y)
        while len(self._poses) > KEPT:
            del self._poses[next(iter(self._poses))]

    def _on_mission(self, message: MissionState) -> None:
        pose = self._poses.get(conversions.stamp_of(message.header.stamp))
        if pose is not None:
            self._home_error = abs(math.dist(pose, self._home) - message.home_distance)
        super()._on_mission(message)

    def _on_rocks(self, message: RockTrackArray) -> None:
        if message.run > 0:  # otherwise it is a fault
            super()._on_rocks(message)
