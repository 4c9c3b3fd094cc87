"""Maps of whole missions, driven steadily and roughly, against the truth.

Each mission runs in one process without ROS; the map is that of its last frame. The rough driver
overrides the mission for seconds at a time, full throttle with the steering held, so that the
rover runs up walls, rocks and comes down with its image, pitch and roll to match.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from rover_simulator.options import WorldOptions
from rover_simulator.simulation import Simulation
from rover_simulator.world.world import World
from rover_tools.evaluation.closed_loop import Loop
from rover_tools.evaluation.map_files import draw_map
from rover_tools.evaluation.results import Result, Truth, score
from rover_tools.output import note, print_result, result_folder, write_result

FRAME_STEPS = 4  # 12.5 frames a second
OWN_SECONDS = (8.0, 20.0)  # [s] for which the mission drives
ROUGH_SECONDS = (1.5, 3.0)  # [s] for which it is overridden
ROUGH_STEERING_DEG = (3.0, 15.0)  # [deg] to either side
TILTED = math.radians(5.0)  # beyond what driving on flat ground does


class RoughSimulation(Simulation):
    """The simulator with a driver who overrides the commands for seconds at a time."""

    def __init__(self, world: World, seed: int, frame_steps: int) -> None:
        super().__init__(world, seed, frame_steps)
        self._random = np.random.default_rng(seed)
        self._rough = True
        self._until = 0.0  # [s]
        self._steering_deg = 0.0

    def handle(self, event: str, data: Mapping[str, Any]) -> bool:
        if self.time >= self._until:
            self._rough = not self._rough
            seconds = self._random.uniform(*(ROUGH_SECONDS if self._rough else OWN_SECONDS))
            self._until = self.time + seconds
            side = self._random.choice((-1.0, 1.0))
            self._steering_deg = side * self._random.uniform(*ROUGH_STEERING_DEG)
        if event == "data" and self._rough:
            steering = f"{self._steering_deg:.4f}"
            data = {**data, "throttle": "1.0", "brake": "0.0", "steering_angle": steering}
        return super().handle(event, data)


DRIVERS: dict[str, Callable[[World, int, int], Simulation]] = {
    "steady": Simulation,
    "rough": RoughSimulation,
}


def bench(
    worlds: Sequence[WorldOptions],
    drivers: Sequence[str],
    time_limit: float,
    out: Path | None,
    as_json: bool,
) -> None:
    """Drive each world with each driver; write and print the scores."""
    cv2.setNumThreads(1)
    folder = result_folder("bench-tours", out)
    rows = []
    for options in worlds:
        world = options.load()
        for driver in drivers:
            rows.append(tour(world, options.seed, driver, time_limit, folder))
            note(_line(rows[-1]))
    result = {"tours": rows}
    write_result(folder, result)
    print_result(result, as_json, "\n".join(map(_line, rows)))
    note(f"maps and figures in {folder}")


def tour(world: World, seed: int, driver: str, time_limit: float, folder: Path) -> Result:
    """One mission and its scores; draws its map into the folder."""
    simulation = DRIVERS[driver](world, seed, FRAME_STEPS)
    loop = Loop(simulation)
    tilts: list[float] = []
    start = time.monotonic()
    try:
        result = loop.run(
            time_limit,
            lambda _: tilts.append(max(abs(simulation.pose.pitch), abs(simulation.pose.roll))),
        )
    finally:
        loop.close()
    truth = Truth(world.navigable, world.samples)
    title = f"{world.name}, {driver}"
    draw_map(
        folder / f"{world.name}-{driver}.png", result.world_map, result.track, result.rocks,
        truth.navigable, truth.samples, title,
    )  # fmt: skip
    return {
        "world": world.name,
        "driver": driver,
        "time": round(simulation.time, 1),
        "frames": len(tilts),
        "contacts": simulation.contacts,
        "tilted_percent": round(100.0 * float(np.mean(np.array(tilts) > TILTED)), 1),
        "tilt_max_deg": round(math.degrees(max(tilts, default=0.0)), 1),
        **score(result.world_map, result.rocks, truth),
        "wall_seconds": round(time.monotonic() - start, 1),
    }


def _line(row: Result) -> str:
    return (
        f"{row['world']:14} {row['driver']:7} {row['frames']:5} frames, "
        f"{row['tilted_percent']:4.1f} % tilted, up to {row['tilt_max_deg']:4.1f} deg: "
        f"mapped {row['percent_mapped']:5.2f}, fidelity {row['fidelity']:5.2f}, "
        f"F1 {row['f1']:5.2f}, {row['rocks_located']} rocks located, {row['rocks_false']} false"
    )
