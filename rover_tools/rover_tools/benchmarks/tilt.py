"""Roll and pitch of the simulated body beside recorded ones, on the floor and near walls.

The body is led along each recorded path under the recorded commands; how it tilts is its own. The
ground is that of the original's map with the median profile at each wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rover_common.ground_truth import load_truth
from rover_simulator.recordings.recording import RecordedFrame, read_recording
from rover_simulator.vehicle.ground import ground_under
from rover_simulator.vehicle.vehicle import Vehicle
from rover_simulator.world.distances import depth_of
from rover_simulator.world.terrain import COUNT, FINE, Terrain
from rover_tools.benchmarks.recorded_commands import commands
from rover_tools.evaluation.results import Result

Array = NDArray[np.float64]

FLOOR = 1.4  # [m] from walls: all wheels are on the flat floor, and have been for a while
# [m] from the nearest cell that is not navigable to the origin, negative within such a cell
BANDS = ((0.2, 0.4), (0.0, 0.2), (-0.25, 0.0), (-0.5, -0.25), (-10.0, -0.5))
# A rock hangs over flat ground here, so that the map has walls where recorded drives are level.
HANGING_ROCK = ((103.0, 98.5), (110.5, 105.0))  # [m] south-west and north-east corner


def tilt_agreement(data: Path, runs: Sequence[str], truth: Path) -> Result:
    """Percentiles [deg] of recorded and simulated tilts, without their signs.

    `tilt_floor`: roll and pitch far from walls; `tilt_walls`: roll by the distance to walls.
    """
    navigable = load_truth(truth)
    terrain = Terrain.of(navigable, relief=np.ones((COUNT, COUNT)))
    recordings = [read_recording(data / run).frames for run in runs]
    places = np.array([(frame.pose.x, frame.pose.y) for run in recordings for frame in run[:-1]])
    recorded = np.concatenate([recorded_tilts(run) for run in recordings])
    simulated = np.concatenate([simulated_tilts(run, terrain) for run in recordings])
    distance = wall_distances(navigable, places)
    distance[np.all((places > HANGING_ROCK[0]) & (places < HANGING_ROCK[1]), axis=1)] = np.nan
    rolls = [np.abs(np.degrees(tilts[:, 1])) for tilts in (recorded, simulated)]
    pitches = [np.abs(np.degrees(tilts[:, 0])) for tilts in (recorded, simulated)]
    floor = distance > FLOOR
    return {
        "tilt_floor": [
            {"tilt": name} | _row(floor, sides, (95, 99))
            for name, sides in (("roll", rolls), ("pitch", pitches))
        ],
        "tilt_walls": [
            {"from": near, "to": far} | _row((distance > near) & (distance <= far), rolls, (90, 95))
            for near, far in BANDS
        ],
    }


def recorded_tilts(frames: Sequence[RecordedFrame]) -> Array:
    """Pitch and roll [rad] of all frames but the last, (n - 1, 2)."""
    return np.array([(frame.pose.pitch, frame.pose.roll) for frame in frames[:-1]])


def simulated_tilts(frames: Sequence[RecordedFrame], terrain: Terrain) -> Array:
    """The same of a body that is led along the recorded path."""
    vehicle = Vehicle(frames[0].pose)
    vehicle.roll_on(frames[0].speed, next(commands(frames))[1])
    tilts = []
    for frame, controls, steps in commands(frames):
        tilts.append((vehicle.pose.pitch, vehicle.pose.roll))
        vehicle.pose = replace(vehicle.pose, x=frame.pose.x, y=frame.pose.y, yaw=frame.pose.yaw)
        vehicle.speed = frame.speed
        for _ in range(steps):
            vehicle.step(controls, ground_under(vehicle.pose, terrain.surface_at))
    return np.array(tilts)


def wall_distances(navigable: NDArray[np.bool_], places: Array) -> Array:
    """Distance [m] of places (n, 2) from the nearest cell that is not navigable.

    Negative within such cells: to the nearest one that is. To a sixteenth of a metre.
    """
    cells = np.kron(navigable, np.ones((FINE, FINE), bool))
    signed = np.where(cells, depth_of(cells) - 0.5, 0.5 - depth_of(~cells)) / FINE
    col, row = np.clip((places * FINE).astype(int), 0, len(cells) - 1).T
    return np.asarray(signed[row, col], np.float64)


def table(result: Result) -> str:
    """The percentiles for people."""
    lines = ["  tilt [deg]                 frames   recorded        simulated"]
    for row in result["tilt_floor"]:
        lines.append(_line(f"{row['tilt']} on the floor, p95, p99", row))
    for row in result["tilt_walls"]:
        lines.append(_line(f"roll {row['from']} to {row['to']} m, p90, p95", row))
    return "\n".join(lines)


def _row(chosen: NDArray[np.bool_], sides: Sequence[Array], at: Sequence[int]) -> Result:
    """Percentiles of the chosen frames, recorded and simulated; None where there are no frames."""
    row: Result = {"frames": int(np.count_nonzero(chosen)), "percentiles": list(at)}
    for name, tilts in zip(("recorded", "simulated"), sides, strict=True):
        row[name] = np.percentile(tilts[chosen], at).round(2).tolist() if chosen.any() else None
    return row


def _line(name: str, row: Result) -> str:
    sides = (", ".join(f"{v:.2f}" for v in row[side] or ()) for side in ("recorded", "simulated"))
    return f"  {name:32} {row['frames']:6} " + "  ".join(f"{side:14}" for side in sides).rstrip()
