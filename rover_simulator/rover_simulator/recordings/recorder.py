"""Record a drive through a generated canyon, in the form of the simulator's own recordings."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.interpolate import interp1d
from skimage.graph import MCP_Geometric

from rover_common.geometry import Pose
from rover_simulator.recordings.recording import LOG_NAME
from rover_simulator.sensors.jpeg import encode_jpeg
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.world.generator import generate_world
from rover_simulator.world.terrain import terrain_of
from rover_simulator.world.world import World

FRAME_PERIOD = 0.04  # [s]
SPEED = 2.5  # [m/s]
TILT = math.radians(1.0)  # amplitude of the body's rocking
ROCKING_PERIOD = 1.9  # [s], as measured
VISIBLE_PIXELS = 25  # a sample that once covers this many pixels can be located

HEADER = (
    "Path", "SteerAngle", "Throttle", "Brake", "Speed",
    "X_Position", "Y_Position", "Pitch", "Yaw", "Roll",
)  # fmt: skip


@dataclass(frozen=True)
class RecordedDrive:
    """Where a drive was written."""

    folder: Path
    truth: Path  # map.png
    samples: Path  # samples.csv: the samples that came into view


def record_drive(folder: Path, seed: int = 1, frames: int = 300) -> RecordedDrive:
    """Render a drive from the start into the longest arm, and write it as a recorded run."""
    world = generate_world(seed, size=0.6)
    world.save(folder / "world")
    renderer = Renderer(world, terrain_of(world, seed))
    (folder / "IMG").mkdir(parents=True, exist_ok=True)
    shown = np.zeros(len(world.samples), np.intp)
    with (folder / LOG_NAME).open("w", newline="") as log:
        writer = csv.writer(log, delimiter=";")
        writer.writerow(HEADER)
        for index, pose in enumerate(_poses(world, frames)):
            rendering = renderer.render(pose)
            shown = np.maximum(shown, rendering.sample_pixels)
            name = f"IMG/frame_{index:05d}.jpg"
            (folder / name).write_bytes(encode_jpeg(rendering.image))
            writer.writerow(_row(name, pose))
    samples = folder / "samples.csv"
    visible = world.samples[shown >= VISIBLE_PIXELS]
    np.savetxt(samples, visible, delimiter=",", header="x,y", comments="", fmt="%.3f")
    return RecordedDrive(folder, folder / "world" / "map.png", samples)


def _row(name: str, pose: Pose) -> tuple[object, ...]:
    """A row of the log, in the simulator's degrees."""
    pitch_deg, yaw_deg = math.degrees(pose.pitch) % 360, math.degrees(pose.yaw) % 360
    roll_deg = -math.degrees(pose.roll) % 360
    angles = (f"{pitch_deg:.6f}", f"{yaw_deg:.6f}", f"{roll_deg:.6f}")
    return (name, 0, 0, 0, SPEED, f"{pose.x:.5f}", f"{pose.y:.5f}", *angles)


def _poses(world: World, frames: int) -> list[Pose]:
    """Poses along the path, the body rocking as it does in turns and under throttle."""
    path = _path_into_longest_arm(world)
    length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    at = np.minimum(np.arange(frames) * FRAME_PERIOD * SPEED, length[-1] - 0.5)
    along = interp1d(length, path, axis=0)
    points, ahead = along(at), along(at + 0.5)
    yaw = np.arctan2(*(ahead - points).T[::-1])
    phase = 2 * math.pi * np.arange(frames) * FRAME_PERIOD / ROCKING_PERIOD
    pitch, roll = TILT * np.sin(phase), TILT * np.cos(0.7 * phase)
    columns = (*points.T, yaw, pitch, roll)
    return [Pose(*(float(value) for value in row)) for row in zip(*columns, strict=True)]


def _path_into_longest_arm(world: World) -> NDArray[np.float64]:
    """Points (n, 2) [m] from the start to the cell with the longest path, away from walls."""
    clearance = ndimage.distance_transform_edt(world.navigable)
    cost = np.where(world.navigable, 1.0 + 4.0 / np.maximum(clearance, 0.5) ** 2, np.inf)
    search = MCP_Geometric(cost)
    costs, _ = search.find_costs([(int(world.start.y), int(world.start.x))])
    costs[~np.isfinite(costs)] = -1
    end = np.unravel_index(np.argmax(costs), costs.shape)
    cells = np.array(search.traceback(end), float)
    smooth = ndimage.gaussian_filter1d(cells, 2.0, axis=0, mode="nearest")
    return smooth[:, ::-1] + 0.5
