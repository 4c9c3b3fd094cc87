"""The closed loop in one process, without ROS: simulator, perception and decision in turn.

The same cores as in the graph, the same texts on the wire, the same rounding between the nodes; a
test holds it against the graph frame for frame.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_bridge.codec import decode_telemetry, encode_drive
from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose
from rover_common.types import CameraFrame, FreeScan, GridMap, RockTrack, Telemetry, VehicleState
from rover_decision.config import DecisionConfig
from rover_decision.mission import Mission
from rover_decision.states import State
from rover_decision.types import Decision, Snapshot
from rover_navigation.plan_scheduler import PlanDesk
from rover_navigation.planner import Planner
from rover_perception.camera.ground_projection import View
from rover_perception.camera.segmentation import ABOVE_HORIZON, NEAREST_ROWS
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception
from rover_simulator.simulation import Simulation

# [px] The telemetry's pose is rounded, so perception may find the horizon one row higher.
POSE_ROUNDING = 1


@dataclass(frozen=True)
class LoopResult:
    """How a mission ended."""

    done: bool  # by the mission's own word
    decision: Decision
    world_map: GridMap
    rocks: tuple[RockTrack, ...]
    track: NDArray[np.float64]  # (n, 2) [m] true positions, one a second


class Loop:
    """One mission, one frame at a time."""

    def __init__(
        self,
        simulation: Simulation,
        decision: DecisionConfig | None = None,
        perception: PerceptionConfig | None = None,
        *,
        mission: Mission | None = None,
        planner: Planner | None = None,
    ) -> None:
        """`mission` and `planner` take the place of those that `decision` describes."""
        config = decision or DecisionConfig()
        self.simulation = simulation
        simulation.crop_pictures(first_row_read)
        self.perception = Perception(perception or PerceptionConfig())
        self.mission = mission or Mission(config)
        planner = planner or Planner(config.explorer)
        self._desk = PlanDesk(planner.plan, config.plan_delay, lockstep=True)
        self._stamp = -1
        self._rocks: tuple[RockTrack, ...] = ()

    def close(self) -> None:
        self._desk.close()

    def run(
        self, time_limit: float, watch: Callable[[Decision], object] | None = None
    ) -> LoopResult:
        """Until the mission is over or the simulated time [s] is up."""
        # The simulator sends two telemetries when it connects, and moves on when both are answered.
        answers = [self.exchange(), self.exchange()]
        track = [self._position()]
        while True:
            decision = answers[-1]
            for answer in answers:
                self.answer(answer)
            if decision.state is State.DONE or self.simulation.time >= time_limit:
                break
            self.simulation.advance()
            if self.simulation.time >= len(track) + 1.0:
                track.append(self._position())
            answers = [self.exchange()]
            if watch is not None:
                watch(answers[-1])
        track.append(self._position())
        done = decision.state is State.DONE
        return LoopResult(done, decision, self.perception.world_map(), self._rocks, np.array(track))

    def exchange(self) -> Decision:
        """One telemetry, and what was decided on it."""
        telemetry = decode_telemetry(self.simulation.telemetry())
        assert telemetry.sim_time is not None
        self._stamp = max(self._stamp + 1, round(telemetry.sim_time * 1e9))
        stamp, pose = self._stamp, _through_message(telemetry.pose)
        percept = self.perception.process(CameraFrame(stamp, pose, telemetry.image))
        self._rocks = percept.rocks
        snapshot = Snapshot(
            vehicle=_vehicle_of(stamp, pose, telemetry),
            nav=percept.nav,
            scan=_scan_through_message(percept.scan),
            rocks=percept.rocks,
            plan=self._desk.plan_at(stamp),
        )
        decision = self.mission.tick(snapshot)
        if percept.map_stamp == stamp:
            self._desk.ask(stamp, self.mission.plan_request(snapshot))
            self._desk.give_map(stamp, self.perception.navigation_map())
        return decision

    def answer(self, decision: Decision) -> None:
        """Hand the simulator what was decided."""
        if decision.command.pickup:
            self.simulation.handle("pickup", {})
        else:
            self.simulation.handle("data", encode_drive(decision.command))

    def _position(self) -> tuple[float, float]:
        return self.simulation.pose.x, self.simulation.pose.y


def first_row_read(pose: Pose) -> int:
    """The first row that perception reads of an image taken at this pose; 0 for one it refuses."""
    view = View.of(ROVER_CAMERA, pose)
    if not view.usable:
        return 0
    row = math.floor(view.highest_horizon) - ABOVE_HORIZON - POSE_ROUNDING
    return min(max(row, 0), ROVER_CAMERA.height - NEAREST_ROWS)


def _through_message(pose: Pose) -> Pose:
    """As it comes out of an Odometry message, whose rotation is a quaternion."""
    roll, pitch, yaw = angles_from_quaternion(*quaternion_from_pose(pose))
    return Pose(pose.x, pose.y, yaw, pitch, roll)


def _vehicle_of(stamp: int, pose: Pose, telemetry: Telemetry) -> VehicleState:
    return VehicleState(
        stamp,
        pose,
        telemetry.speed,
        telemetry.near_sample,
        telemetry.picking_up,
        telemetry.sample_count,
    )


def _scan_through_message(scan: FreeScan) -> FreeScan:
    """As it comes out of a LaserScan message, whose numbers are of single precision."""
    return FreeScan(
        float(np.float32(scan.angle_min)),
        float(np.float32(scan.angle_increment)),
        float(np.float32(scan.range_min)),
        float(np.float32(scan.range_max)),
        scan.ranges,
    )
