"""Maps that are updated only where evidence has changed equal those derived from all of it."""

import math

import numpy as np
import pytest
from scene import draw

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import ground_columns
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.field_of_view import FieldOfView
from rover_perception.mapping.occupancy import OccupancyMaps

FIELD_OF_VIEW = FieldOfView(GridGeometry.of_world(0.25), 16.0)


def pillars(x, y):
    return (np.floor(x / 3) + np.floor(y / 5)) % 3 > 0


def add(evidence: EvidenceGrid, pose: Pose) -> None:
    projection = GroundProjection.of(ROVER_CAMERA, pose)
    evidence.add(projection, ground_columns(draw(pose, pillars), None, projection), pose)


def poses_of(seed: int) -> list[Pose]:
    """Near each other, and some of them near the corner of the grid."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, 30, (2, 5))
    yaw, (pitch, roll) = random.uniform(-math.pi, math.pi, 5), random.uniform(-0.1, 0.1, (2, 5))
    return [Pose(*map(float, values)) for values in zip(x, y, yaw, pitch, roll, strict=True)]


@pytest.mark.parametrize("resolution", [1.0, 0.75])
@pytest.mark.parametrize("seed", range(4))
def test_maps_updated_after_each_frame_equal_maps_derived_once(seed, resolution):
    evidence, again = EvidenceGrid(FIELD_OF_VIEW), EvidenceGrid(FIELD_OF_VIEW)
    maps, at_once = OccupancyMaps(evidence, resolution), OccupancyMaps(again, resolution)
    for pose in poses_of(seed):
        add(evidence, pose)
        maps.world_map()
        add(again, pose)
    assert (maps.world_map().cells == at_once.world_map().cells).all()
    assert (maps.navigation_map().cells == at_once.navigation_map().cells).all()


def test_a_map_that_was_handed_out_does_not_change():
    evidence = EvidenceGrid(FIELD_OF_VIEW)
    maps = OccupancyMaps(evidence, 1.0)
    add(evidence, Pose(100, 100, 0))
    world, navigation = maps.world_map().cells, maps.navigation_map().cells
    before = world.copy(), navigation.copy()
    add(evidence, Pose(100, 100, 2.0))
    assert (maps.world_map().cells != before[0]).any()
    assert (maps.navigation_map().cells != before[1]).any()
    assert (world == before[0]).all()
    assert (navigation == before[1]).all()


@pytest.mark.parametrize("pose", [Pose(0.1, 0.1, -2.4), Pose(199.9, 0.1, 0.8), Pose(100, 199.9, 2)])
def test_evidence_changes_only_inside_of_the_region_that_it_reports(pose):
    evidence = EvidenceGrid(FIELD_OF_VIEW)
    add(evidence, pose)
    region = evidence.take_changed()
    assert region is not None
    sums = evidence.free + evidence.blocked + evidence.base_observations
    sums += evidence.edge_observations + evidence.free_observations
    sums[region.slices] = 0
    assert not sums.any()
    assert evidence.take_changed() is None
