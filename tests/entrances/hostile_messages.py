"""Good messages of every type that a node hears, and what becomes of them on the way."""

from __future__ import annotations

import copy
import math
from array import array
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from action_msgs.msg import GoalStatus, GoalStatusArray
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point, PoseStamped, TransformStamped, Twist, TwistStamped
from hypothesis import strategies as st
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import (
    DriveCommand,
    HeatSource,
    HeatSourceArray,
    HeatState,
    MissionState,
    NavigationTick,
    PolarArray,
    RockTrackArray,
    RoverStatus,
    SensorTick,
)
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan
from std_msgs.msg import Float32MultiArray, Header, Int32, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import frames, types
from rover_common import sensor_types as sensed
from rover_common.geometry import Pose
from rover_common.ros import conversions, scan_conversions, transforms
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.sensor_checks import JPEG_BEGIN

STAMP = 5_000_000_000  # [ns]
BEGIN = 10_000_000_000  # [ns] of a clock, after it
HERE = Pose(100.0, 85.0, 0.7)
FLOATS = (
    math.nan, math.inf, -math.inf, 0.0, -0.0, 1e-30, 0.5, -0.5, 1.0, -1.0, 3.0, 7.5, 100.0,
    -1e5, 1e6, 3e6, 3e38, -3e38,
)  # fmt: skip
INTS = (0, 1, 2, 3, 7, 100, 127, 255, 256, 65535, 2**31 - 1, 2**32 - 1, 2**63 - 1, -1, -2, -128)
INTS = (*INTS, -(2**31), -(2**63))
TEXTS = ("", "map", "odom", "/map", "a b", "\n", "rgb8", "bgr8", "mono8", "16UC1", "ä" * 300)
LENGTHS = (0, 1, 2, 3, 63, 65, 640)
ROW = st.integers(0, 10**6)


def _scan(frame: str) -> LaserScan:
    scan = scan_conversions.scan_message_of(
        STAMP, types.FreeScan(-1.0, 0.1, 0.2, 6.0, np.linspace(0.5, 5.0, 21, dtype=np.float32))
    )
    scan.header.frame_id, scan.time_increment = frame, 0.001
    return scan


def _links() -> TFMessage:
    body = transforms.transform_message_of(STAMP, frames.ODOM, frames.BASE_FOOTPRINT, HERE)
    origin = transforms.transform_message_of(STAMP, frames.MAP, frames.ODOM, Pose(0.0, 0.0, 0.0))
    return TFMessage(transforms=[body, origin])


def _path() -> Path:
    header = conversions.header_of(STAMP, frames.MAP)
    return Path(header=header, poses=[PoseStamped(header=header) for _ in range(3)])


def _markers() -> MarkerArray:
    points = [Point(x=1.0, y=2.0), Point(x=3.0, y=2.0)]
    kinds = [("blocked", Marker.CUBE, Marker.ADD), ("goal", Marker.SPHERE, Marker.DELETE)]
    markers = [Marker(ns=ns, type=kind, action=action) for ns, kind, action in kinds]
    return MarkerArray(markers=[*markers, Marker(ns="path", points=points)])


def _status() -> RoverStatus:
    return RoverStatus(
        header=conversions.header_of(STAMP, frames.BASE),
        run=1,
        sample_count=1,
        sample_x=array("d", [50.0]),
        sample_y=array("d", [60.0]),
        sim_time=math.nan,
    )


def _image(height: int = 160, width: int = 320) -> Image:
    picture = np.full((height, width, 3), 120, np.uint8)
    return conversions.image_message_of(STAMP, frames.CAMERA_OPTICAL, picture)


def _rocks() -> RockTrackArray:
    rock = types.RockTrack(1, 90.0, 80.0, (0.1, 0.0, 0.0, 0.1), 3, STAMP)
    return conversions.rocks_message_of(STAMP, types.FIRST_RUN, (rock,), STAMP)


def _diagnostics() -> DiagnosticArray:
    values = [KeyValue(key="frames", value="3")]
    return DiagnosticArray(status=[DiagnosticStatus(name="/bridge_node", values=values)])


_cells = np.where(np.arange(400).reshape(20, 20) % 7 == 0, 100, 0).astype(np.int8)
_polar = types.PolarArray(np.float32([1.0, 2.0]), np.float32([0.0, 0.5]))
_imu = sensed.Imu(STAMP, (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.1), (0.0, 0.0, 9.8))
_warm = sensed.ThermalFrame(STAMP, 1, np.full((8, 8), 20.0, np.float32))
_header = conversions.header_of(STAMP, frames.MAP)

GOOD: Mapping[type, Any] = {
    Clock: Clock(clock=conversions.time_of(STAMP)),
    CompressedImage: conversions.jpeg_message_of(_header, JPEG_BEGIN + b"more"),
    DiagnosticArray: _diagnostics(),
    DriveCommand: conversions.command_message_of(
        STAMP, STAMP, types.FIRST_RUN, types.Command(0.5, 0.0, 0.1)
    ),
    Float32MultiArray: sensors.thermal_message_of(_warm),
    GoalStatusArray: GoalStatusArray(status_list=[GoalStatus(status=2)]),
    Header: _header,
    HeatSourceArray: HeatSourceArray(header=_header, sources=[HeatSource(id=1)]),
    HeatState: HeatState(header=_header, state_name="EXPLORING"),
    Image: _image(),
    Imu: sensors.imu_message_of(_imu),
    Int32: Int32(data=50),
    LaserScan: _scan(frames.BASE),
    MarkerArray: _markers(),
    MissionState: MissionState(header=_header, state_name="STOP"),
    NavigationTick: NavigationTick(header=_header),
    OccupancyGrid: conversions.grid_message_of(STAMP, types.GridMap(0.5, 95.0, 80.0, _cells)),
    Odometry: conversions.odometry_of(STAMP, HERE, 1.0),
    Path: _path(),
    PolarArray: scan_conversions.polar_message_of(STAMP, types.FIRST_RUN, _polar),
    PoseStamped: transforms.pose_message_of(STAMP, frames.MAP, HERE),
    RockTrackArray: _rocks(),
    RoverStatus: _status(),
    SensorTick: SensorTick(header=_header, scans=1),
    String: String(data="done"),
    TFMessage: _links(),
    TransformStamped: _links().transforms[0],
    Twist: sensors.twist_message_of(sensed.Twist(0.1, 0.2)),
    TwistStamped: sensors.stamped_twist_message_of(STAMP, sensed.Twist(0.1, 0.2)),
}


def leaves(message: Any) -> Iterator[tuple[Any, Any, str]]:
    """Each value of a message: what holds it, its name or index, its type."""
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if hasattr(value, "get_fields_and_field_types"):
            yield from leaves(value)
            continue
        yield message, name, kind
        if isinstance(value, list):
            for part in value:
                if hasattr(part, "get_fields_and_field_types"):
                    yield from leaves(part)


@st.composite
def changed(draw: Any, kind: type, most: int = 3, stamp: int | None = None) -> Any:
    """A good message of a type with up to `most` values changed; stamp: [ns] of its header."""
    message = copy.deepcopy(GOOD[kind])
    if stamp is not None and hasattr(message, "header"):
        message.header.stamp = conversions.time_of(stamp)
    for _ in range(draw(st.integers(0, most))):
        places = list(leaves(message))
        holder, name, what = places[draw(ROW) % len(places)]
        _change(draw, holder, name, what)
    return message


def _change(draw: Any, holder: Any, name: str, what: str) -> None:
    value = getattr(holder, name)
    if isinstance(value, array):
        setattr(holder, name, _other_array(draw, value))
    elif isinstance(value, np.ndarray):
        value = value.copy()
        pool = FLOATS if value.dtype.kind == "f" else (0, 1, 255)
        value[draw(ROW) % len(value)] = draw(st.sampled_from(pool))
        setattr(holder, name, value)
    elif isinstance(value, list):
        setattr(holder, name, draw(st.sampled_from([[], value[:1], value * 2])))
    elif isinstance(value, bool):
        setattr(holder, name, not value)
    elif isinstance(value, str):
        setattr(holder, name, draw(st.sampled_from(TEXTS)))
    elif isinstance(value, float):
        limit = 1e38 if what == "float" else math.inf
        either = st.one_of(st.sampled_from(FLOATS), st.floats(-10.0, 10.0, width=32))
        drawn = draw(either)
        setattr(holder, name, drawn if not math.isfinite(drawn) or abs(drawn) < limit else limit)
    elif isinstance(value, int):
        setattr(holder, name, draw(st.sampled_from([i for i in INTS if _fits(i, what)])))


def _fits(value: int, what: str) -> bool:
    """Whether an integer is one of a type such as uint32."""
    bits = int("".join(filter(str.isdigit, what)) or 8)
    if what.startswith(("uint", "octet", "byte")):
        return 0 <= value < 2**bits
    return -(2 ** (bits - 1)) <= value < 2 ** (bits - 1)


def _other_array(draw: Any, value: array) -> array:
    """Of another length, or with another value in it."""
    code, count = value.typecode, len(value)
    if count == 0 or draw(st.booleans()):
        lengths = (*LENGTHS, max(0, count - 1), count + 1)
        length = draw(st.sampled_from(lengths))
        return array(code, (value * (length // max(1, count) + 1))[:length] if count else [])
    other = array(code, value)
    pool = FLOATS if code in "fd" else [i for i in INTS if _holds(code, i)]
    other[draw(ROW) % count] = draw(st.sampled_from(pool))
    return other


def _holds(code: str, value: int) -> bool:
    try:
        array(code, [value])
    except OverflowError:
        return False
    return True
