"""Names of the coordinate frames (REP-105)."""

from __future__ import annotations

from dataclasses import dataclass, fields

from rover_common.config import parameter
from rover_common.errors import RoverError

MAP = "map"
ODOM = "odom"  # the simulator's pose is exact, so map -> odom is the identity
BASE = "base_link"
BASE_FOOTPRINT = "base_footprint"  # of the second robot: on the ground below base_link
BASE_SCAN = "base_scan"
IMU = "imu_link"
THERMAL = ("thermal_1_link", "thermal_2_link")  # x where the sensor looks
CAMERA = "camera_link"  # x forward, y left, z up
CAMERA_OPTICAL = "camera_optical_frame"  # x right, y down, z forward


class FrameIdError(RoverError, ValueError):
    """A frame id that tf2 does not take."""


@dataclass(frozen=True)
class Frames:
    """The frames of one robot by the names that its messages give them; raises FrameIdError."""

    map: str = MAP
    odom: str = ODOM
    base: str = BASE
    footprint: str = BASE_FOOTPRINT
    camera: str = CAMERA
    camera_optical: str = CAMERA_OPTICAL
    scan: str = BASE_SCAN
    imu: str = IMU
    thermal_1: str = THERMAL[0]
    thermal_2: str = THERMAL[1]

    def __post_init__(self) -> None:
        for name in self.names():
            if not name or name.startswith("/") or name != "".join(name.split()):
                raise FrameIdError(
                    f"'{name}' is no frame id: empty, with a blank, or begins with /"
                )

    def names(self) -> list[str]:
        return [getattr(self, field.name) for field in fields(self)]

    def prefixed(self, prefix: str) -> Frames:
        """All of them below a prefix, as robot_state_publisher has it: rover1/ for rover1/map."""
        return Frames(*(prefix + name for name in self.names()))


FRAMES = Frames()


@dataclass(frozen=True)
class FrameConfig:
    """Parameters of every node that names frames: of the first robot."""

    frame_prefix: str = parameter("", "put before every frame id, such as rover1/; empty for none")
    map_frame: str = parameter(MAP, "frame of the maps, the goals and the markers")
    odom_frame: str = parameter(ODOM, "frame of the odometry")
    base_frame: str = parameter(BASE, "frame of the robot's body, whose pose the odometry tells")

    def frames(self) -> Frames:
        """Raises FrameIdError."""
        own = Frames(map=self.map_frame, odom=self.odom_frame, base=self.base_frame)
        return own.prefixed(self.frame_prefix)


@dataclass(frozen=True)
class BurgerFrameConfig(FrameConfig):
    """The same of the second robot, whose odometry tells where its footprint is."""

    base_frame: str = parameter(
        BASE_FOOTPRINT, "frame of the robot's footprint, whose pose the odometry tells"
    )

    def frames(self) -> Frames:
        """Raises FrameIdError."""
        own = Frames(map=self.map_frame, odom=self.odom_frame, footprint=self.base_frame)
        return own.prefixed(self.frame_prefix)


def bare(name: str) -> str:
    """A frame id without its robot's prefix."""
    return name.rsplit("/", 1)[-1]
