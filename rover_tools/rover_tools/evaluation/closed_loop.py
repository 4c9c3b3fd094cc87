"""The closed loop in one process, without ROS: simulator, perception and decision in turn.

It uses the same cores as the graph, the same values on the wire and the same rounding between the
nodes; a test compares it with the graph frame by frame.
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
from rover_common.types import (
    FIRST_RUN,
    CameraFrame,
    FreeScan,
    GridMap,
    RockTrack,
    Run,
    Telemetry,
    VehicleState,
)
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return import make_core
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Decision, Frame
from rover_perception.baseline.top_view import FIRST_ROW
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import ABOVE_HORIZON, NEAREST_ROWS
from rover_perception.config import PerceptionConfig
from rover_perception.factory import make_perception
from rover_simulator.simulation import Simulation

# [px] The telemetry's pose is rounded, so perception may find the horizon one row higher.
POSE_ROUNDING = 1


@dataclass(frozen=True)
class LoopResult:
    """How a mission ended."""

    done: bool  # as the mission itself reports
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
        core: DecisionCore | None = None,
    ) -> None:
        """`core` takes the place of the one that `decision` describes."""
        self.simulation = simulation
        config = perception or PerceptionConfig()
        simulation.crop_images(FIRST_ROWS[config.recipe])
        self.perception = make_perception(config)
        self.core = core or make_core(decision or DecisionConfig(), lockstep=True)
        self.frame: Frame | None = None  # the newest that was decided on
        self._run = FIRST_RUN
        self._stamp = -1
        self._rocks: tuple[RockTrack, ...] = ()

    def close(self) -> None:
        self.core.close()

    def run(
        self, time_limit: float, watch: Callable[[Decision], object] | None = None
    ) -> LoopResult:
        """Run until the mission is over or the simulated time reaches `time_limit` [s]."""
        # The simulator sends two telemetries when it connects, and advances when both are answered.
        answers = [self.decide(), self.decide()]
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
            answers = [self.decide()]
            if watch is not None:
                watch(answers[-1])
        track.append(self._position())
        done = decision.state is State.DONE
        return LoopResult(done, decision, self.perception.world_map(), self._rocks, np.array(track))

    def decide(self) -> Decision:
        """Process one telemetry of the simulator's present frame."""
        telemetry = decode_telemetry(self.simulation.telemetry())
        assert telemetry.sim_time is not None
        self._stamp = max(self._stamp + 1, round(telemetry.sim_time * 1e9))
        stamp, pose = self._stamp, _through_message(telemetry.pose)
        seen = self.perception.process(CameraFrame(stamp, pose, telemetry.image, self._run))
        self._rocks = seen.rocks
        self.frame = Frame(
            vehicle=self._vehicle_of(stamp, pose, telemetry),
            nav=seen.nav,
            scan=_scan_through_message(seen.scan),
            rocks=seen.rocks,
            map_stamp=seen.map_stamp,
            rock=seen.rock,
        )
        decision = self.core.step(self.frame)
        if seen.map_stamp == stamp:
            self.core.give_map(stamp, self.perception.navigation_map())
        if decision.command.new_run:
            self._run = Run(self._run.number + 1, stamp + 1)
        return decision

    def answer(self, decision: Decision) -> None:
        """Send the decision's command to the simulator."""
        if decision.command.pickup:
            self.simulation.handle("pickup", {})
        else:
            self.simulation.handle("data", encode_drive(decision.command))

    def _vehicle_of(self, stamp: int, pose: Pose, telemetry: Telemetry) -> VehicleState:
        return VehicleState(
            stamp,
            pose,
            telemetry.speed,
            telemetry.near_sample,
            telemetry.picking_up,
            telemetry.sample_count,
            self._run,
        )

    def _position(self) -> tuple[float, float]:
        return self.simulation.pose.x, self.simulation.pose.y


def first_row_read(pose: Pose) -> int:
    """The first row that perception reads of an image taken at this pose; 0 for one it refuses."""
    projection = GroundProjection.of(ROVER_CAMERA, pose)
    if not projection.usable:
        return 0
    row = math.floor(projection.highest_horizon) - ABOVE_HORIZON - POSE_ROUNDING
    return min(max(row, 0), ROVER_CAMERA.height - NEAREST_ROWS)


# By perception's recipe; the baseline reads the same rows at every pose.
FIRST_ROWS: dict[str, Callable[[Pose], int]] = {
    "exact": first_row_read,
    "baseline": lambda pose: FIRST_ROW,
}


def _through_message(pose: Pose) -> Pose:
    """As it comes out of an Odometry message, whose rotation is a quaternion."""
    roll, pitch, yaw = angles_from_quaternion(*quaternion_from_pose(pose))
    return Pose(pose.x, pose.y, yaw, pitch, roll)


def _scan_through_message(scan: FreeScan) -> FreeScan:
    """As it comes out of a LaserScan message, whose numbers are of single precision."""
    return FreeScan(
        float(np.float32(scan.angle_min)),
        float(np.float32(scan.angle_increment)),
        float(np.float32(scan.range_min)),
        float(np.float32(scan.range_max)),
        scan.ranges,
    )
