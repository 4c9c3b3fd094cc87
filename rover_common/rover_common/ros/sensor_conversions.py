"""Messages of the second robot to dataclasses and back; stamps are [ns]."""

from __future__ import annotations

from array import array

import numpy as np
from geometry_msgs.msg import Point, Quaternion, TwistStamped, Vector3
from geometry_msgs.msg import Twist as TwistMsg
from nav_msgs.msg import Odometry
from rover_interfaces.msg import SensorTick
from sensor_msgs.msg import Imu as ImuMsg
from sensor_msgs.msg import LaserScan as LaserScanMsg
from std_msgs.msg import Float32MultiArray, MultiArrayDimension, MultiArrayLayout

from rover_common.burger import BURGER
from rover_common.covariance import ImuCovariance, OdometryCovariance
from rover_common.frames import FRAMES, Frames
from rover_common.geometry import Pose, angles_from_rotation, quaternion_from_pose
from rover_common.ros.conversions import header_of, stamp_of
from rover_common.ros.sensor_checks import check_thermal
from rover_common.sensor_batches import Tick
from rover_common.sensor_types import Imu, LaserScan, ThermalFrame, Twist, WheelOdometry

# Decimals of a heading [rad] that a quaternion of 64-bit numbers keeps for certain.
HEADING_DECIMALS = 9


def laser_scan_message_of(scan: LaserScan, frames: Frames = FRAMES) -> LaserScanMsg:
    """In base_scan."""
    count = len(scan.ranges)
    return LaserScanMsg(
        header=header_of(scan.stamp, frames.scan),
        angle_min=scan.angle_min,
        angle_max=scan.angle_min + scan.angle_increment * (count - 1),
        angle_increment=scan.angle_increment,
        time_increment=scan.time_increment,
        scan_time=scan.time_increment * count,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=array("f", np.ascontiguousarray(scan.ranges, np.float32).tobytes()),
    )


def laser_scan_of(message: LaserScanMsg) -> LaserScan:
    """A read-only view of the message's ranges."""
    return LaserScan(
        stamp=stamp_of(message.header.stamp),
        angle_min=message.angle_min,
        angle_increment=message.angle_increment,
        time_increment=message.time_increment,
        range_min=message.range_min,
        range_max=message.range_max,
        ranges=np.frombuffer(message.ranges, np.float32),
    )


def imu_message_of(
    imu: Imu, covariance: ImuCovariance | None = None, frames: Frames = FRAMES
) -> ImuMsg:
    """In imu_link. Without a covariance all zero, which ROS takes for unknown."""
    message = ImuMsg(header=header_of(imu.stamp, frames.imu))
    if covariance is not None:
        message.orientation_covariance = covariance.orientation.ravel()
        message.angular_velocity_covariance = covariance.angular_velocity.ravel()
        message.linear_acceleration_covariance = covariance.linear_acceleration.ravel()
    if imu.orientation is None:
        message.orientation_covariance[0] = -1.0
    else:
        x, y, z, w = imu.orientation
        message.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.angular_velocity = _vector(imu.angular_velocity)
    message.linear_acceleration = _vector(imu.linear_acceleration)
    return message


def imu_of(message: ImuMsg) -> Imu:
    """Without orientation where its covariance begins with -1, or where it is all zero."""
    q = message.orientation
    orientation = (q.x, q.y, q.z, q.w)
    measured = message.orientation_covariance[0] != -1.0 and any(orientation)
    rate, acceleration = message.angular_velocity, message.linear_acceleration
    return Imu(
        stamp=stamp_of(message.header.stamp),
        orientation=orientation if measured else None,
        angular_velocity=(rate.x, rate.y, rate.z),
        linear_acceleration=(acceleration.x, acceleration.y, acceleration.z),
    )


def wheel_odometry_message_of(
    odometry: WheelOdometry,
    covariance: OdometryCovariance | None = None,
    frames: Frames = FRAMES,
) -> Odometry:
    """base_footprint in odom. Without a covariance all zero."""
    message = Odometry(
        header=header_of(odometry.stamp, frames.odom), child_frame_id=frames.footprint
    )
    message.pose.pose.position = Point(x=odometry.pose.x, y=odometry.pose.y, z=0.0)
    x, y, z, w = quaternion_from_pose(odometry.pose)
    message.pose.pose.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.twist.twist = twist_message_of(odometry.twist)
    if covariance is not None:
        message.pose.covariance = covariance.pose.ravel()
        message.twist.covariance = covariance.twist.ravel()
    return message


def wheel_odometry_of(message: Odometry) -> WheelOdometry:
    """The heading to HEADING_DECIMALS; pitch and roll are none of it."""
    position, q = message.pose.pose.position, message.pose.pose.orientation
    _, _, yaw = angles_from_rotation(q.x, q.y, q.z, q.w)
    return WheelOdometry(
        stamp=stamp_of(message.header.stamp),
        pose=Pose(position.x, position.y, round(yaw, HEADING_DECIMALS)),
        twist=twist_of(message.twist.twist),
    )


def thermal_message_of(frame: ThermalFrame) -> Float32MultiArray:
    """Row by row; the message has no stamp."""
    pixels = BURGER.thermal_pixels
    dimensions = [
        MultiArrayDimension(label="rows", size=pixels, stride=pixels * pixels),
        MultiArrayDimension(label="columns", size=pixels, stride=pixels),
    ]
    values = array("f", np.ascontiguousarray(frame.celsius, np.float32).tobytes())
    return Float32MultiArray(layout=MultiArrayLayout(dim=dimensions), data=values)


def thermal_of(message: Float32MultiArray, stamp: int, sensor: int) -> ThermalFrame:
    """Arrived at `stamp`; its layout does not matter. Raises MessageError."""
    check_thermal(message)
    pixels = BURGER.thermal_pixels
    celsius = np.array(message.data, np.float32).reshape(pixels, pixels)
    return ThermalFrame(stamp, sensor, celsius)


def twist_message_of(twist: Twist) -> TwistMsg:
    return TwistMsg(linear=Vector3(x=twist.linear), angular=Vector3(z=twist.angular))


def stamped_twist_message_of(stamp: int, twist: Twist, frames: Frames = FRAMES) -> TwistStamped:
    """In lockstep the stamp is that of the tick that it answers."""
    header = header_of(stamp, frames.footprint)
    return TwistStamped(header=header, twist=twist_message_of(twist))


def twist_of(message: TwistMsg) -> Twist:
    return Twist(message.linear.x, message.angular.z)


def tick_message_of(tick: Tick, frames: Frames = FRAMES) -> SensorTick:
    return SensorTick(
        header=header_of(tick.stamp, frames.footprint),
        scans=tick.scans,
        imus=tick.imus,
        odometry=tick.odometry,
        thermal_1=tick.thermal[0],
        thermal_2=tick.thermal[1],
        launches=tick.launches,
    )


def tick_of(message: SensorTick) -> Tick:
    return Tick(
        stamp=stamp_of(message.header.stamp),
        scans=message.scans,
        imus=message.imus,
        odometry=message.odometry,
        thermal=(message.thermal_1, message.thermal_2),
        launches=message.launches,
    )


def _vector(values: tuple[float, float, float]) -> Vector3:
    x, y, z = values
    return Vector3(x=x, y=y, z=z)
