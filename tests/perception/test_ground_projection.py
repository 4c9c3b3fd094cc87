"""The projection, its inverse, and its agreement with rays cast pixel by pixel."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scene import ground_points

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_perception.camera.ground_projection import GroundProjection

TILT = st.floats(-0.25, 0.25)


@given(pitch=TILT, roll=TILT, x=st.floats(1.0, 20.0), side=st.floats(-1.2, 1.2))
@settings(deadline=None)
def test_projection_and_inverse_agree(pitch, roll, x, side):
    projection = GroundProjection.of(ROVER_CAMERA, Pose(0, 0, 0, pitch, roll))
    y = side * x
    u, v, depth = projection.pixels(np.array([x]), np.array([y]))
    assume(depth[0] > 0.2 and v[0] > projection.horizon(u)[0] + 0.05)
    back_x, back_y = projection.ground(u, v)
    assert back_x[0] == pytest.approx(x, rel=1e-6)
    assert back_y[0] == pytest.approx(y, rel=1e-6, abs=1e-6)


@given(pitch=TILT, roll=TILT)
@settings(deadline=None)
def test_the_projection_agrees_with_rays(pitch, roll):
    pose = Pose(0, 0, 0, pitch, roll)
    x, y, down = ground_points(pose)
    projection = GroundProjection.of(ROVER_CAMERA, pose)
    u, v = np.meshgrid(np.arange(320) + 0.5, np.arange(160) + 0.5)
    px, py = projection.ground(u, v)
    near = down & (np.hypot(x, y) < 50)
    assert np.allclose(px[near], x[near], rtol=1e-4, atol=1e-4)
    assert np.allclose(py[near], y[near], rtol=1e-4, atol=1e-4)
    horizon = projection.horizon(np.arange(320) + 0.5)
    assert ((v > horizon + 0.01) <= down).all()


def test_ranges_of_the_level_camera_are_those_measured():
    projection = GroundProjection.of(ROVER_CAMERA, Pose(0, 0, 0))
    assert projection.height == pytest.approx(0.2276, abs=1e-4)
    for row, distance in ((159, 0.756), (140, 0.859), (100, 1.697), (90, 2.905)):
        x, _ = projection.ground(np.array([160.0]), np.array([row + 0.5]))
        assert x[0] == pytest.approx(distance, abs=2e-3)


def test_nose_down_lifts_the_horizon_two_pixels_a_degree():
    horizons = [
        GroundProjection.of(ROVER_CAMERA, Pose(0, 0, 0, pitch)).horizon(np.array([160.0]))
        for pitch in (0.0, math.radians(1))
    ]
    assert horizons[0] - horizons[1] == pytest.approx(2.0, abs=0.01)


def test_the_projection_of_a_rover_on_its_back_is_not_usable():
    assert not GroundProjection.of(ROVER_CAMERA, Pose(0, 0, 0, roll=math.pi)).usable
