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

from rover_common import frames
from rover_common.burger import BURGER
from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose
from rover_common.ros.conversions import header_of, stamp_of
from rover_common.ros.message_checks import MessageError, check_fan, check_finite, check_unit
from rover_common.sensor_batches import Tick
from rover_common.sensor_types import Imu, LaserScan, ThermalFrame, Twist, WheelOdometry

# Decimals of a heading [rad] that a quaternion of 64-bit numbers keeps for certain.
HEADING_DECIMALS = 9


def laser_scan_message_of(scan: LaserScan) -> LaserScanMsg:
    """In base_scan."""
    count = len(scan.ranges)
    return LaserScanMsg(
        header=header_of(scan.stamp, frames.BASE_SCAN),
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
    """A read-only view of the message's ranges; raises MessageError."""
    ranges = np.frombuffer(message.ranges, np.float32)
    check_fan(message, ranges)
    check_finite("time between two rays", message.time_increment)
    return LaserScan(
        stamp=stamp_of(message.header.stamp),
        angle_min=message.angle_min,
        angle_increment=message.angle_increment,
        time_increment=message.time_increment,
        range_min=message.range_min,
        range_max=message.range_max,
        ranges=ranges,
    )


def imu_message_of(imu: Imu) -> ImuMsg:
    """In imu_link; covariances are not known, but for an orientation that is not measured."""
    message = ImuMsg(header=header_of(imu.stamp, frames.IMU))
    if imu.orientation is None:
        message.orientation_covariance[0] = -1.0
    else:
        x, y, z, w = imu.orientation
        message.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.angular_velocity = _vector(imu.angular_velocity)
    message.linear_acceleration = _vector(imu.linear_acceleration)
    return message


def imu_of(message: ImuMsg) -> Imu:
    """Without orientation where its covariance begins with -1, or where it is all zero.

    Raises MessageError.
    """
    q = message.orientation
    orientation = (q.x, q.y, q.z, q.w)
    measured = message.orientation_covariance[0] != -1.0 and any(orientation)
    if measured:
        check_finite("orientation", *orientation)
        check_unit(q)
    rate, acceleration = message.angular_velocity, message.linear_acceleration
    check_finite("rotation", rate.x, rate.y, rate.z)
    check_finite("acceleration", acceleration.x, acceleration.y, acceleration.z)
    return Imu(
        stamp=stamp_of(message.header.stamp),
        orientation=orientation if measured else None,
        angular_velocity=(rate.x, rate.y, rate.z),
        linear_acceleration=(acceleration.x, acceleration.y, acceleration.z),
    )


def wheel_odometry_message_of(odometry: WheelOdometry) -> Odometry:
    """base_footprint in odom."""
    message = Odometry(
        header=header_of(odometry.stamp, frames.ODOM), child_frame_id=frames.BASE_FOOTPRINT
    )
    message.pose.pose.position = Point(x=odometry.pose.x, y=odometry.pose.y, z=0.0)
    x, y, z, w = quaternion_from_pose(odometry.pose)
    message.pose.pose.orientation = Quaternion(x=x, y=y, z=z, w=w)
    message.twist.twist = twist_message_of(odometry.twist)
    return message


def wheel_odometry_of(message: Odometry) -> WheelOdometry:
    """The heading to HEADING_DECIMALS; pitch and roll are none of it. Raises MessageError."""
    twist = message.twist.twist
    check_unit(message.pose.pose.orientation)
    check_finite("velocity", twist.linear.x, twist.angular.z)
    position, q = message.pose.pose.position, message.pose.pose.orientation
    _, _, yaw = angles_from_quaternion(q.x, q.y, q.z, q.w)
    check_finite("pose", position.x, position.y, yaw)
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
    """Arrived at `stamp`; its layout does not matter. Raises MessageError for another size."""
    pixels = BURGER.thermal_pixels
    if len(message.data) != pixels * pixels:
        raise MessageError(f"thermal frame of {len(message.data)} values, expected {pixels**2}")
    celsius = np.array(message.data, np.float32).reshape(pixels, pixels)
    return ThermalFrame(stamp, sensor, celsius)


def twist_message_of(twist: Twist) -> TwistMsg:
    return TwistMsg(linear=Vector3(x=twist.linear), angular=Vector3(z=twist.angular))


def stamped_twist_message_of(stamp: int, twist: Twist) -> TwistStamped:
    """In lockstep the stamp is that of the tick that it answers."""
    header = header_of(stamp, frames.BASE_FOOTPRINT)
    return TwistStamped(header=header, twist=twist_message_of(twist))


def twist_of(message: TwistMsg) -> Twist:
    return Twist(message.linear.x, message.angular.z)


def tick_message_of(tick: Tick) -> SensorTick:
    return SensorTick(
        header=header_of(tick.stamp, frames.BASE_FOOTPRINT),
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
