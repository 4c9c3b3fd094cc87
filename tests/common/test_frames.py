"""Frame ids: their parameters, their prefix, and what tf2 does not take."""

from __future__ import annotations

import pytest
from rclpy.node import Node

from rover_common.frames import (
    FRAMES,
    BurgerFrameConfig,
    FrameConfig,
    FrameIdError,
    Frames,
    bare,
)
from rover_common.ros.parameters import declare_parameters


def test_a_prefix_is_before_every_frame_and_comes_off_again():
    frames = FRAMES.prefixed("rover1/")
    assert (frames.map, frames.camera_optical) == ("rover1/map", "rover1/camera_optical_frame")
    assert [bare(name) for name in frames.names()] == FRAMES.names()


def test_the_frames_are_parameters_of_a_node(ros):
    node = ros.add(lambda **k: Node("n", **k), frame_prefix="a/", map_frame="world")
    frames = declare_parameters(node, FrameConfig).frames()
    assert (frames.map, frames.odom, frames.base) == ("a/world", "a/odom", "a/base_link")
    assert BurgerFrameConfig(base_frame="feet").frames().footprint == "feet"


@pytest.mark.parametrize("name", ["", "/map", "the map", "map\n"])
def test_what_tf2_does_not_take_is_refused(name):
    with pytest.raises(FrameIdError):
        Frames(map=name)
    with pytest.raises(FrameIdError):
        FrameConfig(odom_frame=name).frames()
