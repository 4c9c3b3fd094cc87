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
from rover_interfaces.msg import PolarArray as PolarArrayMsg
from rover_interfaces.msg import RockTrack as RockTrackMsg
from sensor_msgs.msg import CompressedImage, Image, LaserScan
from std_msgs.msg import Header

from rover_common import frames
from rover_common.camera import ORIGIN_HEIGHT
from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose
from rover_common.ros import message_checks as checks
from rover_common.types import (
    CameraFrame,
    Command,
    FreeScan,
    GridMap,
    PolarArray,
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
    """`frame`: one of rover_common.frames."""
    return Header(stamp=time_of(stamp), frame_id=frame)


def pose_of(odometry: Odometry) -> Pose:
    """base_link in the odom frame, which is the map frame; raises MessageError."""
    checks.check_frame(odometry.header, frames.ODOM, frames.MAP)
    checks.check_unit(odometry.pose.pose.orientation)
    position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
    roll, pitch, yaw = angles_from_quaternion(q.x, q.y, q.z, q.w)
    return Pose(position.x, position.y, yaw, pitch, roll)


def odometry_of(stamp: int, pose: Pose, speed: float) -> Odometry:
    """`speed` [m/s]: along the body, forward positive."""
    message = Odometry(header=header_of(stamp, frames.ODOM), child_frame_id=frames.BASE)
    message.pose.pose.position = Point(x=pose.x, y=pose.y, z=ORIGIN_HEIGHT)
    x, y, z, w = quaternion_from_pose(pose)
    message.pose.pose.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.twist.twist.linear.x = speed
    return message


def run_of(status: RoverStatus) -> Run:
    """The run that a telemetry belongs to."""
    return Run(status.run, stamp_of(status.run_start))


def vehicle_state_of(odometry: Odometry, status: RoverStatus) -> VehicleState:
    """Of the two messages of one telemetry; raises MessageError."""
    pose, speed = pose_of(odometry), odometry.twist.twist.linear.x
    checks.check_finite("pose or speed", pose.x, pose.y, pose.yaw, pose.pitch, pose.roll, speed)
    return VehicleState(
        stamp=stamp_of(odometry.header.stamp),
        pose=pose,
        speed=speed,
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


def image_of(message: Image) -> np.ndarray:
    """A read-only view (height, width, 3) uint8 of an rgb8 Image; raises MessageError."""
    checks.check_image(message)
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    pixels = np.ascontiguousarray(rows[:, : 3 * message.width])  # rows may be longer than these
    return pixels.reshape(message.height, message.width, 3)


def jpeg_message_of(header: Header, jpeg: bytes) -> CompressedImage:
    """Of a JPEG file's bytes."""
    return CompressedImage(header=header, format=JPEG_FORMAT, data=array("B", jpeg))


def camera_frame_of(image: Image, odometry: Odometry, status: RoverStatus) -> CameraFrame:
    """Of the three messages of one telemetry; raises MessageError."""
    stamp = stamp_of(image.header.stamp)
    return CameraFrame(stamp, pose_of(odometry), image_of(image), run_of(status))


def polar_message_of(stamp: int, run: Run, polar: PolarArray) -> PolarArrayMsg:
    """In base_link."""
    arrays = {"ranges": _float32(polar.ranges), "bearings": _float32(polar.bearings)}
    return PolarArrayMsg(header=header_of(stamp, frames.BASE), run=run.number, **arrays)


def polar_of(message: PolarArrayMsg) -> PolarArray:
    """A read-only view of the message's arrays; raises MessageError."""
    checks.check_frame(message.header, frames.BASE)
    ranges = np.frombuffer(message.ranges, np.float32)
    bearings = np.frombuffer(message.bearings, np.float32)
    checks.check_points(ranges, bearings)
    return PolarArray(ranges, bearings)


def scan_message_of(stamp: int, scan: FreeScan) -> LaserScan:
    """In base_link."""
    return LaserScan(
        header=header_of(stamp, frames.BASE),
        angle_min=scan.angle_min,
        angle_max=scan.angle_min + scan.angle_increment * (len(scan.ranges) - 1),
        angle_increment=scan.angle_increment,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=_float32(scan.ranges),
    )


def scan_of(message: LaserScan) -> FreeScan:
    """A read-only view of the message's ranges; raises MessageError."""
    checks.check_frame(message.header, frames.BASE)
    ranges = np.frombuffer(message.ranges, np.float32)
    checks.check_fan(message, ranges)
    checks.check_distances(ranges)
    limits = message.range_min, message.range_max
    return FreeScan(message.angle_min, message.angle_increment, *limits, ranges)


def rocks_message_of(
    stamp: int, run: Run, rocks: tuple[RockTrack, ...], map_stamp: int
) -> RockTrackArray:
    """In the map frame. `map_stamp` [ns]: of the newest maps at that frame."""
    return RockTrackArray(
        header=header_of(stamp, frames.MAP),
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
    """All confirmed rock tracks, in the map frame; raises MessageError."""
    checks.check_frame(message.header, frames.MAP)
    for rock in message.rocks:
        at = rock.position
        checks.check_finite("a rock", at.x, at.y, *map(float, rock.covariance))
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


def grid_message_of(stamp: int, grid: GridMap) -> OccupancyGrid:
    """In the map frame."""
    message = OccupancyGrid(header=header_of(stamp, frames.MAP))
    message.info.map_load_time = message.header.stamp
    message.info.resolution = grid.resolution
    message.info.height, message.info.width = grid.cells.shape
    message.info.origin.position = Point(x=grid.origin_x, y=grid.origin_y, z=0.0)
    message.data = array("b", grid.cells.tobytes())
    return message


def grid_of(message: OccupancyGrid) -> GridMap:
    """A read-only view of the message's cells; raises MessageError."""
    info = message.info
    checks.check_frame(message.header, frames.MAP)
    checks.check_grid(message)
    cells = np.frombuffer(message.data, np.int8).reshape(info.height, info.width)
    # The size of a cell has 32 bits: to the micrometre.
    resolution, origin = round(info.resolution, 6), info.origin.position
    return GridMap(resolution, origin.x, origin.y, cells)


def command_message_of(now: int, frame_stamp: int, run: Run, command: Command) -> DriveCommand:
    """`now` [ns]: when it was decided; `frame_stamp` [ns] and `run`: of the frame it answers."""
    return DriveCommand(
        header=header_of(now, frames.BASE),
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
    m = message
    command = Command(m.throttle, m.brake, m.steering_angle, m.pickup, m.new_run)
    return stamp_of(m.frame_stamp), command


def _float32(values: np.ndarray) -> array:
    return array("f", np.ascontiguousarray(values, np.float32).tobytes())
