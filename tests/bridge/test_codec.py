"""Telemetry in every number format, and with every defect."""

import base64
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from telemetry import IMAGE, jpeg, telemetry

from rover_bridge import errors
from rover_bridge.codec import decode_telemetry, encode_drive
from rover_common.geometry import Pose, wrap_angle
from rover_common.types import Command

ANGLES = st.floats(-math.pi + 1e-3, math.pi - 1e-3)


def angle_close(a: float, b: float) -> bool:
    return abs(wrap_angle(a - b)) < 2e-6  # four decimals of a degree


@given(
    x=st.floats(0, 200),
    y=st.floats(0, 200),
    yaw=ANGLES,
    pitch=ANGLES,
    roll=ANGLES,
    speed=st.floats(-5, 5),
    number_format=st.sampled_from([(";", "."), (";", ","), (",", "."), (",", ",")]),
)
def test_what_the_simulator_writes_is_read_back(x, y, yaw, pitch, roll, speed, number_format):
    separator, decimal = number_format
    pose = Pose(x, y, yaw, pitch, roll)
    wire = telemetry(pose=pose, speed=speed, separator=separator, decimal=decimal, sim_time=12.34)
    decoded = decode_telemetry(wire)
    assert decoded.pose.x == pytest.approx(x, abs=1e-4)
    assert decoded.pose.y == pytest.approx(y, abs=1e-4)
    assert angle_close(decoded.pose.yaw, yaw)
    assert angle_close(decoded.pose.pitch, pitch)
    assert angle_close(decoded.pose.roll, roll)
    assert decoded.speed == pytest.approx(speed, abs=1e-4)
    assert decoded.samples.tolist() == [[109.78, 89.84], [62.63, 96.25]]
    assert decoded.sim_time == pytest.approx(12.34)


def test_the_simulators_signs():
    wire = telemetry() | {"pitch": "1.0000", "roll": "2.0000", "yaw": "90.0000"}
    pose = decode_telemetry(wire | {"steering_angle": "15.0000"}).pose
    assert pose.pitch == pytest.approx(math.radians(1))  # nose down, as in REP-103
    assert pose.roll == pytest.approx(math.radians(-2))  # right side up there, down in REP-103
    assert pose.yaw == pytest.approx(math.pi / 2)


def test_the_image_is_rgb():
    colored = np.zeros((160, 320, 3), np.uint8)
    colored[..., 2] = 255  # red in OpenCV's order
    import cv2

    image = bytes(cv2.imencode(".jpg", colored)[1].tobytes())
    pixel = decode_telemetry(telemetry(image=image)).image[80, 160]
    assert pixel[0] > 200
    assert pixel[2] < 50


def test_no_samples_left():
    wire = telemetry(samples=(), sample_count=0)
    assert wire["samples_x"] == ""
    assert decode_telemetry(wire).samples.shape == (0, 2)


def test_unknown_keys_are_left_alone():
    assert decode_telemetry(telemetry() | {"battery": "full"}).sample_count == 2


def test_without_sim_time():
    assert decode_telemetry(telemetry()).sim_time is None


@pytest.mark.parametrize("key", sorted(telemetry()))
def test_each_key_is_needed(key):
    wire = telemetry()
    del wire[key]
    with pytest.raises(errors.MissingKeyError, match=key):
        decode_telemetry(wire)


TRUNCATED = base64.b64encode(IMAGE[: len(IMAGE) // 2]).decode()
SMALL = base64.b64encode(jpeg(width=32, height=16)).decode()
NO_PICTURE = base64.b64encode(b"\xff\xd8 nothing \xff\xd9").decode()


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"speed": "fast"}, errors.NumberError),
        ({"speed": ""}, errors.NumberError),
        ({"speed": None}, errors.NumberError),
        ({"speed": True}, errors.NumberError),
        ({"speed": "NaN"}, errors.NotFiniteError),
        ({"pitch": "inf"}, errors.NotFiniteError),
        ({"speed": "400.0"}, errors.OutOfRangeError),
        ({"yaw": "100000.0"}, errors.OutOfRangeError),
        ({"position": "1.0"}, errors.NumberError),
        ({"position": "1.0;2.0;3.0"}, errors.NumberError),
        ({"position": "99999.0;1.0"}, errors.OutOfRangeError),
        ({"position": 5}, errors.NumberError),
        ({"samples_x": "1.00"}, errors.NumberError),
        ({"sample_count": "-1"}, errors.OutOfRangeError),
        ({"near_sample": "7"}, errors.OutOfRangeError),
        ({"sim_time": "-3.0"}, errors.OutOfRangeError),
        ({"image": 7}, errors.Base64Error),
        ({"image": "%%%"}, errors.Base64Error),
        ({"image": ""}, errors.JpegError),
        ({"image": TRUNCATED}, errors.JpegError),
        ({"image": NO_PICTURE}, errors.JpegError),
        ({"image": SMALL}, errors.ImageSizeError),
    ],
)
def test_each_defect_has_its_type(changes, error):
    with pytest.raises(errors.TelemetryError) as caught:
        decode_telemetry(telemetry() | changes)
    assert type(caught.value) is error


@pytest.mark.parametrize("wire", [None, 5, "text", ["list"], ()])
def test_not_an_object(wire):
    with pytest.raises(errors.NotAnObjectError):
        decode_telemetry(wire)


@given(st.dictionaries(st.sampled_from(sorted(telemetry())), st.text(max_size=20), min_size=1))
def test_garbage_never_raises_anything_else(changes):
    try:
        decode_telemetry(telemetry() | changes)
    except errors.TelemetryError as error:
        assert error.counter.startswith("telemetry_")


def test_every_defect_has_a_counter_of_its_own():
    kinds = errors.TelemetryError.__subclasses__()
    assert len({kind.counter for kind in kinds}) == len(kinds) > 5


@given(
    throttle=st.floats(-5, 5),
    brake=st.floats(-1, 20),
    steering=st.floats(-1, 1),
    decimal_comma=st.booleans(),
)
def test_commands_are_strings_that_the_simulator_can_parse(
    throttle, brake, steering, decimal_comma
):
    data = encode_drive(Command(throttle, brake, steering), decimal_comma)
    assert all(isinstance(value, str) for value in data.values())
    mark = "," if decimal_comma else "."
    numbers = {key: float(data[key].replace(mark, ".")) for key in list(data)[:3]}
    assert abs(numbers["steering_angle"]) <= 15.0
    assert numbers["throttle"] == pytest.approx(max(-3.0, min(3.0, throttle)), abs=1e-4)
    assert numbers["brake"] >= 0.0


def test_left_is_positive_and_in_degrees():
    assert encode_drive(Command(steering_angle=math.radians(7.5)))["steering_angle"] == "7.5000"


def test_a_command_that_is_not_finite_becomes_the_brake():
    data = encode_drive(Command(throttle=math.nan))
    assert (data["throttle"], data["brake"]) == ("0.0000", "1.0000")
