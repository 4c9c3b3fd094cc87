"""What flows between the nodes' cores: telemetry -> perception result -> decision -> command.

Every type is frozen. Stamps are integers [ns] of the ROS clock; all that came in one telemetry, and
all that was derived from it, carries the stamp of that telemetry.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose


@dataclass(frozen=True)
class Run:
    """One run of the simulator: from its first telemetry to the next reset, reload or restart.

    The bridge alone decides when a run begins. Every core starts anew, wholly, on a frame with
    another number.
    """

    number: int  # counts from 1
    start: int  # [ns] stamp of the run's first telemetry

    def holds(self, stamp: int) -> bool:
        """Whether a message of this stamp [ns] belongs to this run and not to one before."""
        return stamp >= self.start


FIRST_RUN = Run(1, 0)


@dataclass(frozen=True)
class Telemetry:
    """One message of the simulator, decoded to SI and REP-103."""

    pose: Pose
    speed: float  # [m/s] forward positive
    throttle: float  # as the simulator holds it
    brake: float
    steering_angle: float  # [rad] left positive
    near_sample: bool
    picking_up: bool
    sample_count: int  # not yet collected
    samples: NDArray[np.float64]  # (n, 2) [m] map frame, not yet collected
    image: NDArray[np.uint8]  # (height, width, 3) RGB
    jpeg: bytes  # the file that the image was decoded from
    sim_time: float | None  # [s], None when the simulator does not send it


@dataclass(frozen=True)
class CameraFrame:
    """What perception works on."""

    stamp: int  # [ns]
    pose: Pose
    image: NDArray[np.uint8]  # (height, width, 3) RGB
    run: Run = FIRST_RUN


@dataclass(frozen=True)
class PolarArray:
    """Ground points around base_link."""

    ranges: NDArray[np.float32]  # (n,) [m]
    bearings: NDArray[np.float32]  # (n,) [rad] left positive

    @classmethod
    def empty(cls) -> PolarArray:
        """No point."""
        return cls(np.empty(0, np.float32), np.empty(0, np.float32))


@dataclass(frozen=True)
class FreeScan:
    """Free distance per bearing, as sensor_msgs/LaserScan has it, in base_link."""

    angle_min: float  # [rad] of the first bearing; the fan turns left
    angle_increment: float  # [rad]
    range_min: float  # [m] nothing nearer is seen
    range_max: float  # [m]
    ranges: NDArray[np.float32]  # (n,) [m] to the first obstacle, inf when none within range_max


@dataclass(frozen=True)
class RockTrack:
    """One rock sample, tracked over all camera frames that saw it."""

    id: int
    x: float  # [m] map frame, centre of the rock on the ground
    y: float  # [m]
    covariance: tuple[float, float, float, float]  # [m^2] xx, xy, yx, yy
    observations: int  # frames that saw it
    last_seen: int  # [ns]


@dataclass(frozen=True)
class PerceptionResult:
    """What one camera frame says about the surroundings."""

    stamp: int  # [ns]
    nav: PolarArray  # navigable ground cells
    rock: PolarArray  # rock cells
    scan: FreeScan
    rocks: tuple[RockTrack, ...]  # all rocks known after this frame
    map_stamp: int  # [ns] of the newest maps that were due, this frame's or an older one's
    run: Run = FIRST_RUN


@dataclass(frozen=True)
class VehicleState:
    """What decision knows of the rover itself."""

    stamp: int  # [ns]
    pose: Pose
    speed: float  # [m/s] forward positive
    near_sample: bool
    picking_up: bool
    sample_count: int  # not yet collected
    run: Run = FIRST_RUN


@dataclass(frozen=True)
class GridMap:
    """The world map as decision sees it: an OccupancyGrid's cells."""

    resolution: float  # [m]
    origin_x: float  # [m] map frame, outer corner of cell (0, 0)
    origin_y: float  # [m]
    cells: NDArray[np.int8]  # (rows, cols): -1 unknown, 0..100 probability of an obstacle [%]


@dataclass(frozen=True)
class Command:
    """What the rover is to do until the next command."""

    throttle: float = 0.0  # 1 = 4 x 25 N m at the wheels, negative = reverse, -3..3
    brake: float = 0.0  # >= 0, 1 stops with about 2.5 m/s^2
    steering_angle: float = 0.0  # [rad] left positive
    pickup: bool = False  # pick up instead of driving
    new_run: bool = False  # begin a new run with the next telemetry


SAFE_COMMAND = Command(brake=1.0)
