"""Messages to dataclasses and back, for the topics of more than one node.

Stamps are [ns], positions [m] and angles [rad] in the frame of the message's header.
"""

from __future__ import annotations

from array import array

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Quaternion
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import DriveCommand, RockTrackArray, RoverStatus
from rover_interfaces.msg import RockTrack as RockTrackMsg
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

from rover_common.camera import ORIGIN_HEIGHT
from rover_common.covariance import TELEMETRY_COVARIANCE
from rover_common.frames import FRAMES, Frames
from rover_common.geometry import Pose, angles_from_rotation, quaternion_from_pose
from rover_common.ros.images import image_of as image_of
from rover_common.ros.message_checks import check_grid
from rover_common.ros.message_errors import MessageError as MessageError
from rover_common.types import (
    CameraFrame,
    Command,
    GridMap,
    RockTrack,
    Run,
    VehicleState,
)

NANOSECONDS = 1_000_000_000
JPEG_FORMAT = "rgb8; jpeg compressed bgr8"  # as image_transport writes it


def stamp_of(time: Time) -> int:
    """[ns]"""
    return time.sec * NANOSECONDS + time.nanosec


def time_of(stamp: int) -> Time:
    """The inverse of `stamp_of`."""
    sec, nanosec = divmod(stamp, NANOSECONDS)
    return Time(sec=sec, nanosec=nanosec)


def header_of(stamp: int, frame: str) -> Header:
    """`frame`: one of a robot's Frames."""
    return Header(stamp=time_of(stamp), frame_id=frame)


def pose_of(odometry: Odometry) -> Pose:
    """base_link in the odom frame, which is the map frame."""
    position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    roll, pitch, yaw = angles_from_rotation(q.x, q.y, q.z, q.w)
    return Pose(position.x, position.y, yaw, pitch, roll)


def odometry_of(
    stamp: int, pose: Pose, speed: float, yaw_rate: float = 0.0, frames: Frames = FRAMES
) -> Odometry:
    """`speed` [m/s]: along the body, forward positive; `yaw_rate` [rad/s]: left positive."""
    message = Odometry(header=header_of(stamp, frames.odom), child_frame_id=frames.base)
    message.pose.pose.position = Point(x=pose.x, y=pose.y, z=ORIGIN_HEIGHT)
    x, y, z, w = quaternion_from_pose(pose)
    message.pose.pose.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.twist.twist.linear.x = speed
    message.twist.twist.angular.z = yaw_rate
    message.pose.covariance = TELEMETRY_COVARIANCE.pose.ravel()
    message.twist.covariance = TELEMETRY_COVARIANCE.twist.ravel()
    return message


def run_of(status: RoverStatus) -> Run:
    """The run that a telemetry belongs to."""
    return Run(status.run, stamp_of(status.run_start))


def vehicle_state_of(odometry: Odometry, status: RoverStatus) -> VehicleState:
    """Of the two messages of one telemetry."""
    return VehicleState(
        stamp=stamp_of(odometry.header.stamp),
        pose=pose_of(odometry),
        speed=odometry.twist.twist.linear.x,
        near_sample=status.near_sample,
        picking_up=status.picking_up,
        sample_count=status.sample_count,
        run=run_of(status),
    )


def image_message_of(stamp: int, frame: str, image: np.ndarray) -> Image:
    """An rgb8 Image of an array (height, width, 3) uint8."""
    height, width, _ = image.shape
    return Image(
        header=header_of(stamp, frame),
        height=height,
        width=width,
        encoding="rgb8",
        is_bigendian=0,
        step=3 * width,
        data=array("B", image.tobytes()),
    )


def jpeg_message_of(header: Header, jpeg: bytes) -> CompressedImage:
    """Of a JPEG file's bytes."""
    return CompressedImage(header=header, format=JPEG_FORMAT, data=array("B", jpeg))


def camera_frame_of(image: Image, odometry: Odometry, status: RoverStatus) -> CameraFrame:
    """Of the three messages of one telemetry; raises MessageError."""
    stamp = stamp_of(image.header.stamp)
    return CameraFrame(stamp, pose_of(odometry), image_of(image), run_of(status))


def rocks_message_of(
    stamp: int,
    run: Run,
    rocks: tuple[RockTrack, ...],
    map_stamp: int,
    frames: Frames = FRAMES,
) -> RockTrackArray:
    """In the map frame. `map_stamp` [ns]: of the newest maps at that frame."""
    return RockTrackArray(
        header=header_of(stamp, frames.map),
        run=run.number,
        map_stamp=time_of(map_stamp),
        rocks=[
            RockTrackMsg(
                id=rock.id,
                position=Point(x=rock.x, y=rock.y, z=0.0),
                covariance=rock.covariance,
                observations=rock.observations,
                last_seen=time_of(rock.last_seen),
            )
            for rock in rocks
        ],
    )


def rocks_of(message: RockTrackArray) -> tuple[RockTrack, ...]:
    """All confirmed rock tracks, in the map frame."""
    return tuple(
        RockTrack(
            id=rock.id,
            x=rock.position.x,
            y=rock.position.y,
            covariance=tuple(float(c) for c in rock.covariance),  # type: ignore[arg-type]
            observations=rock.observations,
            last_seen=stamp_of(rock.last_seen),
        )
        for rock in message.rocks
    )


def grid_message_of(
    stamp: int, grid: GridMap, frames: Frames = FRAMES, begun: int | None = None
) -> OccupancyGrid:
    """In the map frame; begun: [ns] when this map was begun, where that tells its frame apart."""
    message = OccupancyGrid(header=header_of(stamp, frames.map))
    message.info.map_load_time = message.header.stamp if begun is None else time_of(begun)
    message.info.resolution = grid.resolution
    message.info.height, message.info.width = grid.cells.shape
    message.info.origin.position = Point(x=grid.origin_x, y=grid.origin_y, z=0.0)
    message.data = array("b", grid.cells.tobytes())
    return message


def grid_of(message: OccupancyGrid) -> GridMap:
    """A read-only view of the message's cells; their size to the micrometre, of its 32 bits.

    Raises MessageError.
    """
    check_grid(message)
    info = message.info
    cells = np.frombuffer(message.data, np.int8).reshape(info.height, info.width)
    resolution, origin = round(info.resolution, 6), info.origin.position
    return GridMap(resolution, origin.x, origin.y, cells)


def map_begun_of(message: OccupancyGrid) -> int:
    """[ns] When the map was begun, which tells its frame from that of another map; 0 for unknown.

    Nothing is told by a load time that is the map's own stamp, as of one that is made each time.
    """
    loaded = stamp_of(message.info.map_load_time)
    return 0 if loaded == stamp_of(message.header.stamp) else loaded


def command_message_of(
    now: int, frame_stamp: int, run: Run, command: Command, frames: Frames = FRAMES
) -> DriveCommand:
    """`now` [ns]: when it was decided; `frame_stamp` [ns] and `run`: of the frame it answers."""
    return DriveCommand(
        header=header_of(now, frames.base),
        frame_stamp=time_of(frame_stamp),
        run=run.number,
        throttle=command.throttle,
        brake=command.brake,
        steering_angle=command.steering_angle,
        pickup=command.pickup,
        new_run=command.new_run,
    )


def command_of(message: DriveCommand) -> tuple[int, Command]:
    """The stamp [ns] of the frame that it answers, and the command."""
    command = Command(
        message.throttle, message.brake, message.steering_angle, message.pickup, message.new_run
    )
    return stamp_of(message.frame_stamp), command
