"""What the rover knows at each frame of a simulation: simulator and perception, without ROS.

It uses the same cores as the graph, the same values on the wire and the same rounding between the
nodes.
"""

from __future__ import annotations

import numpy as np

from rover_bridge.codec import decode_telemetry
from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose
from rover_common.types import (
    FIRST_RUN,
    CameraFrame,
    FreeScan,
    RockTrack,
    Run,
    Telemetry,
    VehicleState,
)
from rover_decision.types import Frame
from rover_perception.config import PerceptionConfig
from rover_perception.factory import make_perception, recipe_of
from rover_simulator.simulation import Simulation


class Observer:
    """Decodes the telemetry of a simulation's present frame, and perceives it."""

    def __init__(
        self, simulation: Simulation, config: PerceptionConfig | None = None, *, crop: bool = True
    ) -> None:
        """crop: whether rows of the image that perception does not read may stay black."""
        self._simulation = simulation
        config = config or PerceptionConfig()
        if crop:
            simulation.crop_images(recipe_of(config.recipe).first_row)
        self.perception = make_perception(config)
        self.telemetry: Telemetry | None = None  # the newest
        self.rocks: tuple[RockTrack, ...] = ()  # all that are confirmed
        self._run = FIRST_RUN
        self._stamp = -1

    def observe(self) -> Frame:
        """Process one telemetry of the simulator's present frame."""
        self.telemetry = telemetry = decode_telemetry(self._simulation.telemetry())
        assert telemetry.sim_time is not None
        self._stamp = max(self._stamp + 1, round(telemetry.sim_time * 1e9))
        stamp, pose = self._stamp, _through_message(telemetry.pose)
        seen = self.perception.process(CameraFrame(stamp, pose, telemetry.image, self._run))
        self.rocks = seen.rocks
        return Frame(
            vehicle=self._vehicle_of(stamp, pose, telemetry),
            nav=seen.nav,
            scan=_scan_through_message(seen.scan),
            rocks=seen.rocks,
            map_stamp=seen.map_stamp,
            rock=seen.rock,
        )

    def begin_run(self) -> None:
        """The next frame belongs to another run."""
        self._run = Run(self._run.number + 1, self._stamp + 1)

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
