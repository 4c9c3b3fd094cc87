"""The second robot's messages: to dataclasses and back, and collected to batches."""

from __future__ import annotations

import math
from array import array

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from std_msgs.msg import Float32MultiArray

from rover_common.geometry import Pose
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import MessageError
from rover_common.sensor_batches import BatchCollector, Tick
from rover_common.sensor_types import (
    Imu,
    LaserScan,
    SensorBatch,
    ThermalFrame,
    Twist,
    WheelOdometry,
)

NUMBERS = st.floats(-1e6, 1e6)
STAMPS = st.integers(0, 2**31 * 10**9 - 1)


def scan(stamp: int = 5) -> LaserScan:
    ranges = np.array([1.0, 0.0, math.inf, 2.5], np.float32)
    return LaserScan(stamp, 0.0, 0.5, 0.25, 0.125, 8.0, ranges)


def imu(stamp: int = 5) -> Imu:
    return Imu(stamp, (0.0, 0.0, 0.0, 1.0), (0.1, 0.2, 0.3), (0.0, 0.0, 9.8))


def odometry(stamp: int = 5) -> WheelOdometry:
    return WheelOdometry(stamp, Pose(1.0, 2.0, 0.5), Twist(0.1, 0.2))


def thermal(sensor: int, stamp: int = 5) -> ThermalFrame:
    return ThermalFrame(stamp, sensor, np.arange(64, dtype=np.float32).reshape(8, 8))


def test_a_scan_comes_back_as_it_was():
    message = sensors.laser_scan_message_of(scan())
    assert message.header.frame_id == "base_scan"
    assert message.angle_max == pytest.approx(1.5)
    assert message.scan_time == pytest.approx(1.0)
    back = sensors.laser_scan_of(message)
    assert back.ranges.tobytes() == scan().ranges.tobytes()
    assert repr(back) == repr(scan())


@given(STAMPS, st.tuples(NUMBERS, NUMBERS, NUMBERS), st.tuples(NUMBERS, NUMBERS, NUMBERS))
def test_an_inertial_sample_comes_back_as_it_was(stamp, rate, acceleration):
    sample = Imu(stamp, (0.5, -0.5, 0.5, 0.5), rate, acceleration)
    assert sensors.imu_of(sensors.imu_message_of(sample)) == sample


def test_an_orientation_that_is_not_measured_is_none():
    sample = Imu(5, None, (0.0, 0.0, 0.0), (0.0, 0.0, 9.8))
    message = sensors.imu_message_of(sample)
    assert message.orientation_covariance[0] == -1.0
    assert sensors.imu_of(message) == sample
    message.orientation_covariance[0] = 0.0
    message.orientation.w = 0.0
    assert sensors.imu_of(message).orientation is None


@given(STAMPS, NUMBERS, NUMBERS, st.floats(-3.14, 3.14), NUMBERS)
def test_odometry_comes_back_as_it_was_with_a_heading_of_nine_decimals(stamp, x, y, yaw, speed):
    sample = WheelOdometry(stamp, Pose(x, y, round(yaw, 9)), Twist(speed, -speed))
    message = sensors.wheel_odometry_message_of(sample)
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    assert sensors.wheel_odometry_of(message) == sample


def test_a_thermal_frame_goes_row_by_row():
    message = sensors.thermal_message_of(thermal(2))
    assert [(d.label, d.size, d.stride) for d in message.layout.dim] == [
        ("rows", 8, 64),
        ("columns", 8, 8),
    ]
    back = sensors.thermal_of(Float32MultiArray(data=message.data), 7, 2)
    assert (back.stamp, back.sensor) == (7, 2)
    assert (back.celsius == thermal(2).celsius).all()


@pytest.mark.parametrize("count", [0, 63, 65])
def test_a_thermal_frame_of_another_size_is_refused(count):
    message = Float32MultiArray(data=array("f", [20.0] * count))
    with pytest.raises(MessageError, match=f"{count} values"):
        sensors.thermal_of(message, 7, 1)


def test_a_velocity_and_a_tick_come_back_as_they_were():
    twist = Twist(0.123456789, -1.5)
    message = sensors.stamped_twist_message_of(1_500_000_000, twist)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (1, 500_000_000)
    assert sensors.twist_of(message.twist) == twist
    tick = Tick(9, 1, 5, 2, (1, 0), 1)
    assert sensors.tick_of(sensors.tick_message_of(tick)) == tick


def test_a_batch_is_complete_when_its_tick_says_so():
    parts = [scan(), imu(1), imu(2), odometry(), thermal(2), thermal(1)]
    batch = SensorBatch(50, (parts[0],), (parts[1], parts[2]), (parts[3],), tuple(parts[4:]), 1)
    tick = Tick.of(batch)
    assert tick == Tick(50, 1, 2, 1, (1, 1), 1)
    for missing in range(len(parts)):
        collector = BatchCollector()
        collector.add_tick(tick)  # also when it comes first
        collector.add_launch()
        for part in parts[:missing] + parts[missing + 1 :]:
            collector.add(part)
        assert collector.take_complete() is None
        collector.add(parts[missing])
        taken = collector.take_complete()
        assert taken is not None
        assert (taken.stamp, taken.launches_done) == (50, 1)
        assert [imu.stamp for imu in taken.imus] in ([1, 2], [2, 1])
        assert [(frame.sensor, frame.stamp) for frame in taken.thermal] == [(1, 50), (2, 50)]
        assert collector.take_complete() is None


def test_a_launch_that_is_counted_is_waited_for():
    collector = BatchCollector()
    collector.add_tick(Tick(50, launches=1))
    assert collector.take_complete() is None
    collector.add_launch()
    assert collector.take_complete() == SensorBatch(50, launches_done=1)
    collector.add_tick(Tick(51))
    assert collector.take_complete() == SensorBatch(51)
    assert collector.take_complete() is None


def test_a_tick_of_which_something_was_lost_does_not_delay_the_next():
    collector = BatchCollector()
    collector.add_tick(Tick(50, imus=1, odometry=1))
    collector.add(imu(45))  # the odometry never comes
    collector.add(odometry(95))
    assert collector.take_complete() is None  # which belongs to the next tick
    collector.add_tick(Tick(100, imus=1, odometry=1))
    assert collector.take_complete() is None  # the sample of the tick before does not count
    collector.add(imu(95))
    assert collector.take_complete() == SensorBatch(100, (), (imu(45), imu(95)), (odometry(95),))
    collector.add_tick(Tick(150, imus=1))
    assert collector.take_complete() is None
    collector.add(imu(145))
    assert collector.take_complete() == SensorBatch(150, (), (imu(145),))


def test_a_clock_that_begins_anew_leaves_nothing_of_the_time_before():
    collector = BatchCollector()
    collector.add_tick(Tick(1000, imus=1))
    collector.add(imu(1000))
    assert collector.take_complete() is not None
    collector.add(imu(1050))
    collector.add(scan(1050))
    collector.add(odometry(45))
    collector.add_tick(Tick(50, odometry=1))
    assert collector.take_complete() == SensorBatch(50, (), (), (odometry(45),))


def test_without_ticks_a_batch_is_what_came():
    collector = BatchCollector()
    collector.add(imu(3))
    collector.add(thermal(1, 4))
    taken = collector.take(60)
    assert (taken.stamp, taken.imus) == (60, (imu(3),))
    assert [frame.stamp for frame in taken.thermal] == [4]
    assert collector.take(61) == SensorBatch(61)
