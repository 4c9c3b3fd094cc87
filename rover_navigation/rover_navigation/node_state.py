"""The map and the pose of a navigator, which go on where one that was killed left off."""

from __future__ import annotations

from rclpy.node import Node

from rover_common.ros.state import NodeState
from rover_common.same_robot import check_goes_on, memory_of, odometry_of
from rover_common.saved_state import Memory, SavedState, joined, part_of
from rover_common.sensor_types import SensorBatch, WheelOdometry
from rover_common.state_keeper import MakeState
from rover_common.types import FIRST_RUN
from rover_navigation.embedded_navigator import EmbeddedNavigator

VERSION = 1  # of what is saved


class KeptNavigator:
    """A robot here has no runs: that it is the same one is told by its odometry."""

    def __init__(self, node: Node, state_dir: str, navigator: EmbeddedNavigator) -> None:
        self._navigator = navigator
        self._state = NodeState(node, state_dir, "navigator", VERSION)
        self._newest: WheelOdometry | None = None

    def resume(self, batch: SensorBatch) -> None:
        """Before a batch is worked on: the first one with odometry tells what goes on with it."""
        if not batch.odometry:
            return
        first = batch.odometry[0]
        self._state.resume(FIRST_RUN, first.stamp, lambda saved: self._adopt(saved, first))
        self._newest = batch.odometry[-1]

    def keep(self) -> None:
        """After it: save the state now and then, once there is a map."""
        if self._has_state:
            self._state.keep(self._snapshot)

    def close(self) -> None:
        """Save the last state, and end the thread that does."""
        self._state.close(self._snapshot if self._has_state else None)

    @property
    def _has_state(self) -> bool:
        return self._navigator.has_map and self._newest is not None

    def _adopt(self, saved: SavedState, first: WheelOdometry) -> None:
        memory = saved.values, saved.arrays
        check_goes_on(odometry_of(part_of(memory, "odometry")[0]["newest"]), first)
        self._navigator.restore(part_of(memory, "navigator"))

    def _snapshot(self) -> MakeState:
        assert self._newest is not None
        newest, made = self._newest, self._navigator.memory()
        heard: Memory = {"newest": memory_of(newest)}, {}
        return lambda: SavedState(
            FIRST_RUN, newest.stamp, *joined(navigator=made(), odometry=heard)
        )
