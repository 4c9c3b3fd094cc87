"""The free distance per bearing."""

import math

import numpy as np
import pytest
from scene import EXACT, draw

from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception


def test_the_scan_is_the_distance_to_a_wall():
    pose = Pose(90, 100, 0)
    core = Perception(EXACT)
    result = core.process(CameraFrame(1, pose, draw(pose, lambda x, y: x < 94)))
    scan = result.scan
    middle = round(-scan.angle_min / scan.angle_increment)
    assert scan.ranges[middle] == pytest.approx(4.0, abs=0.3)
    assert len(result.nav.ranges) == len(result.nav.bearings) > 50
    assert (result.nav.ranges <= EXACT.max_range + 0.5).all()


def test_the_scan_follows_the_conventions_of_a_laser_scan():
    """Counter-clockwise from angle_min at even steps; inf where nothing is in range."""
    pose = Pose(90, 100, 0)
    image = draw(pose, lambda x, y: (y < 102) & (x < 106))  # walls at the left and far ahead
    config = PerceptionConfig(image_lag=0, max_range=8.0)
    scan = Perception(config).process(CameraFrame(1, pose, image)).scan
    bearing = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    assert scan.angle_increment > 0
    assert bearing[-1] == pytest.approx(-scan.angle_min)
    left = (bearing > math.radians(20)) & (bearing < math.radians(45))
    assert np.allclose(scan.ranges[left] * np.sin(bearing[left]), 2.0, atol=0.3)
    assert np.isinf(scan.ranges[np.abs(bearing) < math.radians(3)]).all()
    finite = scan.ranges[np.isfinite(scan.ranges)]
    assert ((finite >= scan.range_min) & (finite <= scan.range_max)).all()


def test_a_rover_on_its_back_has_no_free_distance_in_any_direction():
    core = Perception(EXACT)
    pose = Pose(90, 100, 0, roll=math.pi)
    result = core.process(CameraFrame(1, pose, draw(Pose(90, 100, 0), lambda x, y: x < 94)))
    assert (result.scan.ranges == np.float32(result.scan.range_min)).all()
    assert len(result.nav.ranges) == len(result.rock.ranges) == 0
    assert (core.world_map().cells == -1).all()
    assert core.segmentation is None
