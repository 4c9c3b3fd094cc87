"""Rendered pictures beside recorded ones of the original, at the recorded poses.

Recorded images and poses match exactly. The rendered world is built from the original's map of
navigable cells and the median wall profile, and for its skyline also from a relief measured on
other recordings than the one that is scored.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose, rotation_matrix
from rover_common.grid import WORLD
from rover_common.whole_file import write_whole
from rover_simulator.recordings.recording import RecordedFrame, read_recording
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.world.terrain import COUNT, Terrain
from rover_simulator.world.world import World
from rover_tools.benchmarks.skyline_relief import carve, read_skyline
from rover_tools.evaluation.results import Result

RUNS = ("udacity/test_dataset", "recordings/long", "recordings/medium", "recordings/arm")
HELD_OUT = RUNS[0]  # the others pass the same places and show its skylines from elsewhere
COLLISION_TILT = math.radians(3.0)  # more than driving alone can tilt the body
EVERY = 10  # frames between two that are compared, or that a relief is measured on
PICTURED = ((RUNS[0], 2), (RUNS[2], 16), (RUNS[3], 60))  # recordings, and which compared frame

GROUND_RED = 150  # brighter is sand
WALL_RED = 90  # darker is wall or rock
YELLOW = 70  # [levels] red above blue: a sample
# The sky is a smooth, slightly warm grey; bright sand lies above, walls in the haze below.
SKY_RED = (96, 190)
SKY_WARMTH = (-2, 30)  # [levels] red above blue
SKY_LOWEST = math.radians(1.0)  # elevation: walls stand all around
SKY_VARIANCE = 16.0  # [levels^2] among 3 x 3 pixels
SKY_AREA = 30  # [px] the least that counts
SKY_EDGE = 4  # [px] at its border, where JPEG blurs the skyline into it

Image = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Render = Callable[[Pose], Image]


@dataclass(frozen=True)
class Shot:
    """A recorded picture."""

    pose: Pose
    image: Image  # (160, 320, 3) RGB
    sky: Mask


def level_frames(frames: tuple[RecordedFrame, ...], every: int) -> Iterator[RecordedFrame]:
    """One of every so many frames, without those that a collision tilts."""
    for frame in frames[::every]:
        if max(abs(frame.pose.pitch), abs(frame.pose.roll)) <= COLLISION_TILT:
            yield frame


def picture_agreement(data: Path, navigable: Mask, picture: Path | None) -> Result:
    """How rendered pictures agree with recorded ones, on every tenth level frame of four runs.

    From the map and the median profile alone, over all four: `ground_iou`, bright ground as
    intersection over union of pixels, and per class `*_rgb_error`, the largest difference among the
    three channels' means [levels], over the pixels that are of this class in both pictures: `sand`
    bright ground, lit and shaded; `wall` dark; `sky` as in `sky_mask`.

    `sky_iou` is of one recording, with the relief that the skylines of the other three give; none
    of its own frames is used. `sky_iou_map_only` is of the same frames without a relief. `skylines`
    has both for each recording left out in its turn, `sky_iou_all` is over all of them: two of
    these drive far into arms that no other recording shows, where a relief cannot be known.
    """
    world = World("original", navigable, np.empty((0, 2)), Pose(WORLD.start_x, WORLD.start_y, 0.0))
    median = Terrain.of(navigable, relief=np.ones((COUNT, COUNT)))
    flat = _renderer(world, median)
    shots = {
        run: [_shot(frame) for frame in level_frames(read_recording(data / run).frames, EVERY)]
        for run in RUNS
    }
    plain = {run: [flat(shot.pose) for shot in shots[run]] for run in RUNS}
    carved = {run: _renderer(world, _carved(median, navigable, shots, run)) for run in RUNS}
    if picture is not None:
        chosen = [(shots[run][index], carved[run]) for run, index in PICTURED]
        draw_pairs(picture, [(shot.image, render(shot.pose)) for shot, render in chosen])
    colors = _map_agreement(
        [shot for run in RUNS for shot in shots[run]],
        [image for run in RUNS for image in plain[run]],
    )
    return colors | _sky_agreement(shots, plain, carved)


def _carved(
    median: Terrain, navigable: Mask, shots: Mapping[str, list[Shot]], left_out: str
) -> Terrain:
    """The terrain with the relief that the skylines of all other recordings give."""
    others = [shot for run in RUNS if run != left_out for shot in shots[run]]
    relief = carve(median, read_skyline((shot.pose, shot.sky) for shot in others))
    return Terrain.of(navigable, relief=relief)


def _sky_agreement(
    shots: Mapping[str, list[Shot]],
    plain: Mapping[str, list[Image]],
    carved: Mapping[str, Render],
) -> Result:
    """Sky of recorded pictures and of images rendered without a relief and with one, by run."""
    rows, totals = [], np.zeros(2)
    for run in RUNS:
        counts = _sky_counts(shots[run], [carved[run](shot.pose) for shot in shots[run]])
        totals += counts
        rows.append(
            {
                "recording": run,
                "frames": len(shots[run]),
                "sky_iou": _ratio(counts),
                "sky_iou_map_only": _ratio(_sky_counts(shots[run], plain[run])),
            }
        )
    held_out = rows[RUNS.index(HELD_OUT)]
    return {
        "sky_iou": held_out["sky_iou"],
        "sky_iou_map_only": held_out["sky_iou_map_only"],
        "sky_iou_all": _ratio(totals),
        "skylines": rows,
    }


def ground_mask(image: Image) -> Mask:
    """Bright pixels below the horizon and a little above it."""
    bright = (image[..., 0] > GROUND_RED) & ~_yellow(image)
    bright[: ROVER_CAMERA.height // 2 - 8] = False
    return np.asarray(bright)


def wall_mask(image: Image) -> Mask:
    return np.asarray((image[..., 0] < WALL_RED) & ~_yellow(image))


def sky_mask(image: Image, pose: Pose) -> Mask:
    """Grey above the horizon, connected with a smooth patch of it."""
    warmth = image[..., 0].astype(int) - image[..., 2]
    candidate = (image[..., 0] > SKY_RED[0]) & (image[..., 0] < SKY_RED[1])
    candidate &= (warmth > SKY_WARMTH[0]) & (warmth < SKY_WARMTH[1])
    candidate &= _elevation(pose) > SKY_LOWEST
    grey = image.mean(axis=2, dtype=np.float32)
    variance = np.asarray(cv2.blur(grey * grey, (3, 3)) - cv2.blur(grey, (3, 3)) ** 2)
    smooth = (candidate & (variance < SKY_VARIANCE)).astype(np.uint8)
    square = np.ones((3, 3), np.uint8)
    smooth = np.asarray(cv2.morphologyEx(smooth, cv2.MORPH_OPEN, square), np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(smooth, connectivity=4)
    large = stats[:, cv2.CC_STAT_AREA] >= SKY_AREA
    large[0] = False  # what is not smooth
    patch = large[labels].astype(np.uint8)
    for _ in range(SKY_EDGE):
        patch = np.asarray(cv2.dilate(patch, square), np.uint8) * candidate
    return np.asarray(patch > 0)


def draw_pairs(path: Path, pairs: list[tuple[Image, Image]]) -> None:
    """A PNG of rows: the recorded picture, and the rendered one beside it."""
    gap = np.full((ROVER_CAMERA.height, 4, 3), 255, np.uint8)
    rows = [np.hstack([recorded, gap, rendered]) for recorded, rendered in pairs]
    sheet = np.vstack(rows) & 0xFC  # the last bits are noise, and most of the file
    path.parent.mkdir(parents=True, exist_ok=True)
    options = [cv2.IMWRITE_PNG_COMPRESSION, 9]
    _, picture = cv2.imencode(".png", cv2.cvtColor(sheet, cv2.COLOR_RGB2BGR), options)
    write_whole(path, picture.tobytes())


def _shot(frame: RecordedFrame) -> Shot:
    picture = cv2.imread(str(frame.image_path))
    if picture is None:
        raise OSError(f"{frame.image_path}: not an image")
    image = np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)
    return Shot(frame.pose, image, sky_mask(image, frame.pose))


def _renderer(world: World, terrain: Terrain) -> Render:
    renderer = Renderer(world, terrain)
    return lambda pose: renderer.render(pose).image


def _map_agreement(shots: list[Shot], images: list[Image]) -> Result:
    """Ground and colours of recorded pictures and of the rendered images."""
    ground = np.zeros(2)
    sums = {name: np.zeros((2, 3)) for name in ("sand", "wall", "sky")}
    counts = dict.fromkeys(sums, 0)
    for shot, rendered in zip(shots, images, strict=True):
        recorded = shot.image
        sands = ground_mask(recorded), ground_mask(rendered)
        ground += _overlap(*sands)
        classes = {
            "sand": sands[0] & sands[1],
            "wall": wall_mask(recorded) & wall_mask(rendered),
            "sky": shot.sky & sky_mask(rendered, shot.pose),
        }
        for name, both in classes.items():
            sums[name] += [recorded[both].sum(axis=0), rendered[both].sum(axis=0)]
            counts[name] += int(np.count_nonzero(both))
    means = {name: total / max(1, counts[name]) for name, total in sums.items()}
    errors = {
        f"{name}_rgb_error": round(float(np.abs(recorded - rendered).max()), 2)
        for name, (recorded, rendered) in means.items()
    }
    colors = {
        name: {"recorded": recorded.round(1).tolist(), "rendered": rendered.round(1).tolist()}
        for name, (recorded, rendered) in means.items()
    }
    return {"ground_iou": _ratio(ground), **errors, "colors": colors}


def _sky_counts(shots: list[Shot], images: list[Image]) -> NDArray[np.int64]:
    """Sky pixels of the intersection and of the union, over all shots."""
    pairs = zip(shots, images, strict=True)
    counts = [_overlap(shot.sky, sky_mask(image, shot.pose)) for shot, image in pairs]
    return np.asarray(np.sum(counts, axis=0))


def _overlap(a: Mask, b: Mask) -> NDArray[np.int64]:
    return np.array([np.count_nonzero(a & b), np.count_nonzero(a | b)])


def _ratio(counts: NDArray) -> float:
    return round(float(counts[0] / max(1, counts[1])), 4)


def _yellow(image: Image) -> Mask:
    return np.asarray(image[..., 0].astype(int) - image[..., 2] > YELLOW)


def _elevation(pose: Pose) -> NDArray[np.float32]:
    """Of each pixel's ray [rad] above the horizon, (160, 320)."""
    rays = ROVER_CAMERA.rays() @ rotation_matrix(pose).T.astype(np.float32)
    return np.arctan2(rays[..., 2], np.hypot(rays[..., 0], rays[..., 1]))
