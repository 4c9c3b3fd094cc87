"""What a new run changes, and what only a new run changes."""

from dataclasses import replace

import numpy as np
import pytest
from scene import EXACT, PERIOD, corridor, draw, drive, frames, hall, mapped

from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.types import CameraFrame, PerceptionResult, Run
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameError
from rover_perception.perception import Perception

LIVE = PerceptionConfig(image_lag=1)


def with_rock(sequence: list[CameraFrame]) -> list[CameraFrame]:
    """The same frames with the yellow of a rock sample in each image."""
    for index, frame in enumerate(sequence):
        frame.image[96:100, 150 + 2 * index : 156 + 2 * index] = (170, 143, 15)
    return sequence


def first_run() -> list[CameraFrame]:
    return with_rock(frames(drive(), corridor))


def second_run() -> list[CameraFrame]:
    """A drive in another place; it begins before the next map of the first run is due."""
    poses = [Pose(90 + 0.2 * index, 98.0, 0.1) for index in range(12)]
    run = Run(2, first_run()[-1].stamp + PERIOD)
    sequence = [
        replace(frame, stamp=run.start + index * PERIOD, run=run)
        for index, frame in enumerate(frames(poses, hall))
    ]
    return with_rock(sequence)


def parts(result: PerceptionResult) -> tuple:
    arrays = (result.nav, result.rock)
    return (
        *(values.tobytes() for polar in arrays for values in (polar.ranges, polar.bearings)),
        result.scan.ranges.tobytes(), result.rocks, result.stamp, result.map_stamp, result.run,
    )  # fmt: skip


@pytest.mark.parametrize("config", [EXACT, LIVE], ids=["lag 0", "lag 1"])
def test_a_new_run_gives_exactly_the_results_of_a_fresh_perception(config):
    used, fresh = Perception(config), Perception(config)
    for frame in first_run():
        last = used.process(frame)
        used.world_map()
    assert last.rocks
    assert last.map_stamp < last.stamp
    for frame in second_run():
        assert parts(used.process(frame)) == parts(fresh.process(frame))
        assert (used.world_map().cells == fresh.world_map().cells).all()
        assert (used.navigation_map().cells == fresh.navigation_map().cells).all()
    assert len(fresh.process(second_run()[-1]).rocks) == 1  # there is one to compare


def test_a_new_run_has_no_segmentation_before_its_first_valid_frame():
    core = Perception(EXACT)
    core.process(frames(drive(), corridor)[0])
    assert core.segmentation is not None
    first = second_run()[0]
    with pytest.raises(FrameError):
        core.process(replace(first, pose=Pose(-1.0, 0.0, 0.0)))
    assert core.segmentation is None
    assert (core.world_map().cells == -1).all()


def test_a_jump_within_a_run_keeps_the_map():
    core = Perception(EXACT)
    for frame in frames(drive(), corridor):
        core.process(frame)
    before = core.world_map().cells
    far = Pose(20.0, 20.0, 0.0)
    core.process(CameraFrame(100 * PERIOD, far, draw(far, lambda x, y: y < 30)))
    after = core.world_map().cells
    assert (after[80:120] == before[80:120]).all()
    assert navigable_cells(after)[19:22, 22:24].all()


def test_the_stamps_of_a_run_do_not_change_its_map():
    sequence = frames(drive(count=10), corridor)
    backwards = [replace(frame, stamp=100 * PERIOD - frame.stamp) for frame in sequence]
    assert (mapped(backwards) == mapped(sequence)).all()


@pytest.mark.parametrize(
    ("pose", "shape"), [(Pose(-50.0, 300.0, 0), (160, 320, 3)), (Pose(90, 100, 0), (100, 320, 3))]
)
def test_a_refused_frame_leaves_the_map_unchanged(pose, shape):
    core = Perception(EXACT)
    for frame in frames(drive(count=5), corridor):
        core.process(frame)
    before = core.world_map().cells
    with pytest.raises(FrameError):
        core.process(CameraFrame(100 * PERIOD, pose, np.zeros(shape, np.uint8)))
    assert (core.world_map().cells == before).all()
    core.process(frames(drive(count=6), corridor)[-1])
    assert navigable_cells(core.world_map().cells)[navigable_cells(before)].all()
