"""The mission of a heat_node, which goes on where one that was killed left off.

A robot here has no runs: that it is the same one is told by its odometry, and that places are where
they were by the map's beginning, or by the pose in a map that does not tell it.
"""

from __future__ import annotations

from typing import Any

from rclpy.node import Node

from rover_common.geometry import Pose
from rover_common.ros.state import NodeState
from rover_common.same_robot import check_goes_on, check_within_reach, memory_of, odometry_of
from rover_common.saved_state import Memory, SavedState, StateError, joined, part_of
from rover_common.sensor_types import SensorBatch, WheelOdometry
from rover_common.state_keeper import MakeState
from rover_common.types import FIRST_RUN, Run
from rover_heat import mission
from rover_heat.frames import FrameAssembler
from rover_heat.node_config import HeatNodeConfig
from rover_heat.node_sensors import HeatSensors
from rover_heat.types import HeatDecision
from rover_navigation.navigator import Navigator

VERSION = 1  # of what is saved
VOID = "this is another map: what was known of places is void, payloads and time go on"


class KeptMission:
    """`follow` before each tick of the mission, `keep` after it."""

    def __init__(
        self,
        node: Node,
        config: HeatNodeConfig,
        core: mission.HeatCore,
        navigator: Navigator,
        sensors: HeatSensors,
        frames: FrameAssembler,
    ) -> None:
        self._log = node.get_logger()
        self._config, self._core, self._navigator = config, core, navigator
        self._sensors, self._frames = sensors, frames
        self._state = NodeState(node, config.state_dir, "heat", VERSION)
        self._odometry: WheelOdometry | None = None  # the newest
        self._pose: Pose | None = None  # in the map, the newest since there is a map
        self._map_begun = 0  # [ns] of the mission's map; 0 for unknown
        self._progress: Any = None  # at the newest tick

    def follow(self, batch: SensorBatch) -> None:
        """With the first odometry, map and pose: go on with what was saved, if it fits to them.

        Later, a map that is another one makes all places void.
        """
        if batch.odometry:
            self._odometry = batch.odometry[-1]
        newest = self._sensors.poses.latest()
        if self._odometry is None or newest is None or self._sensors.grid is None:
            return
        self._pose = newest[1]
        self._state.resume(FIRST_RUN, batch.stamp, self._adopt)
        begun = self._sensors.map_begun
        if begun and self._map_begun not in (0, begun) and not self._core.mission.idle:
            self._go_on(self._frames.run, mission.memory_of(self._core), False)
        self._map_begun = begun or self._map_begun

    def keep(self, decision: HeatDecision) -> None:
        """Save the state now and then; its milestones at once, a launch before it is signalled."""
        if not self._has_state:
            return
        progress = self._frames.run, decision.progress.payloads, decision.state
        if decision.launch:
            self._state.keep_first(self._snapshot)
        else:
            self._state.keep(self._snapshot, at_once=progress != self._progress)
        self._progress = progress

    def close(self) -> None:
        """Save the last state, and end the thread that does."""
        self._state.close(self._snapshot if self._has_state else None)

    @property
    def _has_state(self) -> bool:
        """Once what was saved has been offered, and the mission has begun."""
        return self._pose is not None and not self._core.mission.idle

    def _adopt(self, saved: SavedState) -> None:
        assert self._odometry is not None
        memory = saved.values, saved.arrays
        heard, _ = part_of(memory, "heard")
        before = odometry_of(heard["odometry"])
        seconds = check_goes_on(before, self._odometry)
        same = self._is_same_map(int(heard["map"]), Pose(*map(float, heard["pose"])), seconds)
        number, start = heard["run"]
        self._go_on(Run(int(number), int(start)), part_of(memory, "mission"), same)

    def _is_same_map(self, begun: int, pose: Pose, seconds: float) -> bool:
        assert self._pose is not None
        if begun and self._sensors.map_begun:
            return begun == self._sensors.map_begun
        try:
            check_within_reach("pose", pose, self._pose, seconds)
        except StateError:
            return False
        return True

    def _go_on(self, run: Run, memory: Memory, places: bool) -> None:
        mission.resume(self._core, self._config, self._navigator, run, memory, places)
        self._frames.run = run
        if not places:
            self._log.warning(VOID)

    def _snapshot(self) -> MakeState:
        assert self._odometry is not None
        assert self._pose is not None
        run, pose = self._frames.run, self._pose
        heard = {
            "odometry": memory_of(self._odometry),
            "pose": [pose.x, pose.y, pose.yaw],
            "map": self._map_begun,
            "run": [run.number, run.start],
        }
        memory = joined(heard=(heard, {}), mission=mission.memory_of(self._core))
        state = SavedState(FIRST_RUN, self._odometry.stamp, *memory)
        return lambda: state
