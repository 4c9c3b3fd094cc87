"""What was measured of a mission, and its result: the same for the graph and for the loop."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.types import GridMap, RockTrack
from rover_simulator.world.world import World
from rover_tools.evaluation.results import Result, Truth, score


@dataclass(frozen=True)
class MissionRun:
    """What the simulator measured, as opposed to what the rover estimates."""

    time: float  # [s] simulated, since the first telemetry
    distance: float  # [m]
    contacts: int  # times that a wall or a rock was touched
    samples_left: int
    track: NDArray[np.float64]  # (n, 2) [m] true positions, one a second


def truth_of(world: World) -> Truth:
    """What a mission in this world is scored against."""
    return Truth(world.navigable, world.samples)


def mission_result(
    world: World,
    strategy: str,
    seed: int,
    *,
    done: bool,
    run: MissionRun,
    grid: GridMap | None,
    rocks: tuple[RockTrack, ...],
    recoveries: int | None,
    wall_seconds: float,
) -> Result:
    """The result of one mission; `done` is what the rover reports, all else is measured."""
    home = np.hypot(*(run.track[-1] - (world.start.x, world.start.y)))
    return {
        "done": done,
        "reason": "home" if done else "the time is up",
        "time": round(run.time, 1),
        **score(grid, rocks, truth_of(world)),
        "samples_collected": len(world.samples) - run.samples_left,
        "samples_total": len(world.samples),
        "home_distance": round(float(home), 2),
        "distance": round(run.distance, 1),
        "contacts": run.contacts,
        "recoveries": recoveries,
        "world": world.name,
        "seed": seed,
        "strategy": strategy,
        "wall_seconds": round(wall_seconds, 1),
    }


RESULT_KEYS = (
    "done", "reason", "time", "percent_mapped", "fidelity", "f1", "rocks_located", "rocks_missed",
    "rocks_false", "rocks_found", "samples_collected", "samples_total", "home_distance", "distance",
    "contacts", "recoveries", "world", "seed", "strategy", "wall_seconds",
)  # fmt: skip


def failed_result(world: str, strategy: str, seed: int, error: str) -> Result:
    """The result of a mission that did not end: nothing is known but the error."""
    reason = f"failed: {error}"
    known = {"done": False, "reason": reason, "world": world, "seed": seed, "strategy": strategy}
    return dict.fromkeys(RESULT_KEYS) | known
