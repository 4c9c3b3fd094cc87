"""Parameters of simulator_node: which world, for which server, at what speed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rover_common.config import parameter
from rover_simulator.options import FPS, LONGEST, MOST_FPS, SIZES, WorldOptions
from rover_simulator.world.world import World


@dataclass(frozen=True)
class SimulatorConfig:
    host: str = parameter("127.0.0.1", "host of the server")
    port: int = parameter(4567, "TCP port of the server", minimum=1, maximum=65535)
    seed: int = parameter(
        1, "of the generated canyon, or of a map's samples", minimum=0, maximum=2**31 - 1
    )
    size: float = parameter(
        1.0,
        "of a generated canyon; 1 is as large as the original",
        minimum=SIZES[0],
        maximum=SIZES[1],
    )
    map: str = parameter("", "picture of a map to make the world of; empty for none")
    world: str = parameter("", "folder of a saved world instead; empty for none")
    rate: float = parameter(
        1.0,
        "times real time, 0 as fast as the server answers",
        minimum=0.0,
        maximum=1000.0,
        settable=True,
    )
    fps: float = parameter(FPS, "[1/s] frames per simulated second", minimum=1.0, maximum=MOST_FPS)
    time_limit: float = parameter(
        0.0,
        "[s] of simulated time at which the node ends; 0 for none",
        minimum=0.0,
        maximum=LONGEST,
    )
    dead_man: float = parameter(
        0.5,
        "[s] of simulated time without a command, after which a rover that drives brakes; 0: never",
        minimum=0.0,
        maximum=60.0,
    )
    start_paused: bool = parameter(False, "whether time stands still at the start")

    def load(self) -> World:
        """Raises TruthError or WorldError."""
        picture, folder = (Path(name) if name else None for name in (self.map, self.world))
        return WorldOptions(self.seed, self.size, picture, folder).load()
