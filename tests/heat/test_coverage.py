"""Which faces count as examined."""

from __future__ import annotations

import math

import numpy as np
import pytest
from looks import look
from mapped_rooms import map_of
from warm_room import Room, box

from rover_common.geometry import Pose
from rover_heat.config import HeatConfig
from rover_heat.planning.faces import find_faces
from rover_heat.planning.site import make_site
from rover_heat.planning.types import HeatPlanRequest
from rover_heat.thermal.coverage import Coverage

CONFIG = HeatConfig()
ROOM = Room(box(3.0, 2.0))
CENTER = (1.5, 1.0)


def examined(coverage: Coverage, room: Room = ROOM, at=CENTER):
    """Faces of the room's map, and which of them are examined."""
    grid = map_of(room, [at])
    site = make_site(HeatPlanRequest(0, grid, Pose(*at, 0.0)), 0)
    return find_faces(site, coverage.snapshot())


def span(faces, axis: int = 0) -> tuple[float, float]:
    """[m] from where to where examined faces reach."""
    values = faces.points[faces.examined][:, axis]
    return float(values.min()), float(values.max())


def test_normals_point_off_the_walls():
    faces = examined(Coverage(CONFIG))
    north = np.abs(faces.points[:, 1] - 1.975) < 0.03
    middle = north & (np.abs(faces.points[:, 0] - 1.5) < 1.0)
    assert middle.sum() > 30
    assert np.abs(np.angle(np.exp(1j * (faces.normals[middle] + math.pi / 2)))).max() < 0.05
    assert not faces.examined.any()


def test_two_frames_in_a_row_examine_what_lies_in_the_field():
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 1.0, math.pi / 2), ROOM)
    low, high = span(examined(coverage))
    assert low == pytest.approx(1.5 - math.tan(math.radians(22.5)), abs=0.1)
    assert high == pytest.approx(1.5 + math.tan(math.radians(22.5)), abs=0.1)


@pytest.mark.parametrize("numbers", [(1,), (1, 3), (2, 1)])
def test_one_frame_alone_examines_nothing(numbers):
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 1.0, math.pi / 2), ROOM, numbers)
    assert not examined(coverage).examined.any()


def test_frames_of_two_sensors_are_not_in_a_row():
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 1.0, math.pi / 2), ROOM, (1,), sensor=2)
    look(coverage, Pose(1.5, 1.0, math.pi / 2 - CONFIG.thermal_yaw_1), ROOM, (2,), sensor=1)
    assert not examined(coverage).examined.any()


def test_the_left_sensor_examines_the_left_wall():
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 1.0, 0.0), ROOM, sensor=1)
    faces = examined(coverage)
    assert faces.examined.any()
    assert span(faces, axis=1)[0] > 1.9


def test_a_wall_beyond_the_reach_or_too_oblique_is_not_examined():
    long = Room(box(6.0, 2.0))
    coverage = Coverage(CONFIG)
    look(coverage, Pose(4.0, 1.0, 0.0), long)  # 2 m before the east wall
    look(coverage, Pose(1.0, 1.0, math.radians(20.0)), long)  # along the walls
    assert not examined(coverage, long, (3.0, 1.0)).examined.any()


def test_a_face_seen_from_its_other_side_only_is_not_examined():
    room = Room(np.vstack([box(3.0, 2.0), [[0.5, 1.0, 2.5, 1.0]]]))
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 0.3, math.pi / 2), room)
    grid = map_of(room, [(1.5, 0.3), (1.5, 1.7), (0.2, 1.0), (2.8, 1.0)])
    site = make_site(HeatPlanRequest(0, grid, Pose(1.5, 0.3, 0.0)), 0)
    faces = find_faces(site, coverage.snapshot())
    assert faces.points[faces.examined][:, 1].max() < 1.0
    above = (faces.points[:, 1] > 1.0) & (faces.points[:, 1] < 1.2)
    assert above.sum() > 20


def test_what_is_given_up_is_no_longer_open():
    coverage = Coverage(CONFIG)
    before = examined(coverage)
    coverage.give_up(before.points[:40])
    assert examined(coverage).examined[:40].all()


def test_what_was_examined_from_a_place_is_known():
    coverage = Coverage(CONFIG)
    look(coverage, Pose(1.5, 1.0, math.pi / 2), ROOM)
    ahead = np.array([[1.4, 1.97], [1.5, 1.97], [1.6, 1.97]])
    assert coverage.examined_from(1.5, 1.0, ahead) == 1.0
    assert coverage.examined_from(0.2, 1.9, ahead) == 0.0
    both = np.vstack([ahead, [[0.3, 1.97]]])
    assert coverage.examined_from(1.5, 1.0, both) == 0.75


def test_a_snapshot_stays_as_it_is():
    coverage = Coverage(CONFIG)
    snapshot = coverage.snapshot()
    look(coverage, Pose(1.5, 1.0, math.pi / 2), ROOM)
    assert len(snapshot.keys) == 0 < len(coverage.snapshot().keys)
