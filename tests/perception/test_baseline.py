"""The baseline's recipe, stage by stage, and the pipeline that is made of the stages."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scene import PERIOD, SAND, WALL, draw

from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.types import CameraFrame, Run
from rover_perception.baseline.perception import BaselinePerception
from rover_perception.baseline.thresholds import ground_mask, rock_mask
from rover_perception.baseline.top_view import (
    FIRST_ROW,
    HEIGHT,
    SQUARE,
    WIDTH,
    field_of_view,
    rover_points,
    top_view,
)
from rover_perception.config import PerceptionConfig
from rover_perception.factory import make_perception
from rover_perception.frame_validation import PoseError
from rover_perception.perception import Perception

POSE = Pose(90.0, 100.5, 0.0)
BASELINE = PerceptionConfig(recipe="baseline")
YELLOW = (194, 160, 12)


def strip(x, y):
    return (y > 98) & (y < 103)


def with_rock(pose: Pose, ahead: float, left: float) -> CameraFrame:
    """A frame with a yellow patch 0.3 m wide on the ground, some way [m] from the rover."""
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    x, y = pose.x + c * ahead - s * left, pose.y + s * ahead + c * left
    on_rock = draw(pose, lambda east, north: np.hypot(east - x, north - y) < 0.3, YELLOW)
    image = draw(pose, strip)
    yellow = (on_rock == YELLOW).all(axis=2)
    image[yellow] = YELLOW
    return CameraFrame(1, pose, image)


def mapped(pose: Pose, config: PerceptionConfig = BASELINE) -> np.ndarray:
    core = BaselinePerception(config)
    core.process(CameraFrame(1, pose, draw(pose, strip)))
    return core.navigable()


class TestTopView:
    def test_the_square_of_the_image_becomes_a_metre_of_the_top_view(self):
        image = np.zeros((HEIGHT, WIDTH), np.uint8)
        for u, v in SQUARE.astype(int):
            image[v - 1 : v + 2, u - 1 : u + 2] = 255
        x, y = rover_points(top_view(image) > 60)
        assert np.ptp(x) == pytest.approx(1.0, abs=0.11)
        assert np.ptp(y) == pytest.approx(1.0, abs=0.11)
        assert x.min() == pytest.approx(0.6, abs=0.11)

    def test_nothing_above_the_first_row_is_read(self):
        image = np.zeros((HEIGHT, WIDTH), np.uint8)
        image[:FIRST_ROW] = 255
        assert not top_view(image).any()

    def test_the_field_of_view_widens_from_the_rover_on(self):
        width = field_of_view().sum(axis=1)
        assert width[-1] < width[-20] < width[-60]
        assert not field_of_view()[-1, 0]

    def test_points_are_ahead_and_to_the_left(self):
        mask = np.zeros((HEIGHT, WIDTH), bool)
        mask[HEIGHT - 20, WIDTH // 2 - 10] = True
        assert [float(axis[0]) for axis in rover_points(mask)] == [2.0, 1.0]


class TestThresholds:
    @pytest.mark.parametrize(
        ("color", "ground"),
        [(SAND, True), ((161, 161, 161), True), ((255, 255, 160), False), (WALL, False)],
    )
    def test_ground_is_above_160_in_every_channel(self, color, ground):
        assert ground_mask(np.full((1, 1, 3), color, np.uint8))[0, 0] == ground

    @pytest.mark.parametrize(
        ("color", "rock"),
        [((110, 110, 0), True), ((255, 255, 70), True), ((255, 255, 71), False), (SAND, False)],
    )
    def test_rocks_are_yellow_within_inclusive_bounds(self, color, rock):
        assert rock_mask(np.full((1, 1, 3), color, np.uint8))[0, 0] == rock


class TestMap:
    def test_a_level_rover_maps_the_ground_ahead(self):
        rows, cols = np.nonzero(mapped(POSE))
        assert {92, 93} <= set(cols.tolist())
        assert rows.min() >= 97
        assert rows.max() <= 103
        assert (cols >= 90).all()
        assert (cols <= 95).all()

    def test_a_rover_that_looks_north_maps_to_the_north(self):
        north = Pose(100.5, 90.0, math.pi / 2)
        core = BaselinePerception(BASELINE)
        core.process(CameraFrame(1, north, draw(north, lambda x, y: (x > 98) & (x < 103))))
        rows, _ = np.nonzero(core.navigable())
        assert rows.max() in (94, 95)

    @pytest.mark.parametrize("axis", ["pitch", "roll"])
    def test_a_tilted_rover_maps_nothing(self, axis):
        assert not mapped(replace(POSE, **{axis: 0.013})).any()
        assert mapped(replace(POSE, **{axis: 0.012})).any()

    def test_the_range_limits_what_is_mapped_and_not_what_is_seen(self):
        far = replace(BASELINE, baseline_range=10.0)
        assert np.count_nonzero(mapped(POSE, far)) > 1.5 * np.count_nonzero(mapped(POSE))
        result = BaselinePerception(BASELINE).process(CameraFrame(1, POSE, draw(POSE, strip)))
        assert result.nav.ranges.max() > 8.0

    def test_ground_once_is_ground_for_ever(self):
        core = BaselinePerception(BASELINE)
        core.process(CameraFrame(1, POSE, draw(POSE, strip)))
        before = core.navigable().copy()
        wall = draw(POSE, lambda x, y: x > 1000)
        for index in range(2, 5):
            core.process(CameraFrame(index * PERIOD, POSE, wall))
        cells = core.world_map().cells
        assert (navigable_cells(cells) == before).all()
        assert (cells == 100).any()
        assert (cells == -1).any()

    def test_both_maps_say_the_same(self):
        core = BaselinePerception(BASELINE)
        core.process(CameraFrame(1, POSE, draw(POSE, strip)))
        world, fine = core.world_map(), core.navigation_map()
        assert fine.resolution == BASELINE.evidence_resolution
        assert fine.cells.shape == (800, 800)
        assert (fine.cells[2::4, 2::4] == world.cells).all()


class TestResult:
    def test_polar_arrays_and_scan_are_of_the_same_view(self):
        result = BaselinePerception(BASELINE).process(with_rock(POSE, 2.0, 0.5))
        assert len(result.nav.ranges) > 100
        assert float(result.rock.bearings.mean()) == pytest.approx(math.atan2(0.5, 2.0), abs=0.1)
        beside = result.scan.ranges[20]  # at -34 degrees: the strip's edge, or what the warp makes
        assert 1.5 < beside < 6.0

    def test_a_rock_is_listed_once_where_it_was_seen(self):
        core = BaselinePerception(BASELINE)
        for stamp, x in enumerate((90.0, 90.3, 90.6), start=1):
            pose = replace(POSE, x=x)
            frame = replace(with_rock(pose, 92.5 - x, 0.5), stamp=stamp * PERIOD)
            (rock,) = core.process(frame).rocks
        assert rock.observations == 3
        assert math.hypot(rock.x - 92.5, rock.y - 101.0) < 1.0

    def test_maps_are_due_by_the_period(self):
        core = BaselinePerception(replace(BASELINE, map_period=0.1))
        image = draw(POSE, strip)
        stamps = [
            core.process(CameraFrame(index * PERIOD, POSE, image)).map_stamp // PERIOD
            for index in range(1, 7)
        ]
        assert stamps == [1, 1, 1, 4, 4, 4]

    def test_the_vision_image_shows_ground_rocks_and_obstacles(self):
        core = BaselinePerception(BASELINE)
        assert core.vision_image() is None
        frame = with_rock(POSE, 2.0, 0.0)
        core.process(frame)
        picture = core.vision_image()
        assert (picture[:FIRST_ROW] == frame.image[:FIRST_ROW]).all()
        assert len(np.unique(picture[HEIGHT // 2 + 1 :].reshape(-1, 3), axis=0)) == 3


class TestPipeline:
    def test_the_recipe_names_the_pipeline(self):
        assert isinstance(make_perception(BASELINE), BaselinePerception)
        assert isinstance(make_perception(PerceptionConfig()), Perception)

    def test_another_run_starts_anew(self):
        core = make_perception(BASELINE)
        core.process(with_rock(POSE, 2.0, 0.0))
        later = replace(with_rock(POSE, 2.0, 0.0), stamp=PERIOD, run=Run(2, PERIOD))
        assert [rock.observations for rock in core.process(later).rocks] == [1]

    def test_a_frame_that_cannot_be_used_changes_nothing(self):
        core = BaselinePerception(BASELINE)
        core.process(CameraFrame(1, POSE, draw(POSE, strip)))
        before = core.counts.copy()
        with pytest.raises(PoseError):
            core.process(CameraFrame(2, replace(POSE, x=math.nan), draw(POSE, strip)))
        assert (core.counts == before).all()
