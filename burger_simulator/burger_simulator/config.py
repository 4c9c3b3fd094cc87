"""Parameters of burger_node: which maze, at what speed, and the options of the simulation."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from burger_simulator.options import BurgerOptions
from burger_simulator.world.families import FAMILIES
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze
from rover_common.config import parameter
from rover_common.frames import BASE_SCAN, IMU, BurgerFrameConfig, Frames


@dataclass(frozen=True)
class BurgerConfig(BurgerOptions):
    seed: int = parameter(
        1, "of the generated maze, and of the sensors' noise", minimum=0, maximum=2**31 - 1
    )
    family: str = parameter("challenge", "of the generated maze", choices=tuple(FAMILIES))
    world: str = parameter("", "file of a saved maze instead; empty for none")
    rate: float = parameter(
        1.0,
        "times real time, 0 as fast as it goes",
        minimum=0.0,
        maximum=1000.0,
        settable=True,
    )
    start_paused: bool = parameter(False, "whether time stands still until ~/resume")
    stamped_cmd_vel: bool = parameter(True, "TwistStamped on cmd_vel instead of Twist")
    lockstep: bool = parameter(
        False, "each tick waits for a TwistStamped on cmd_vel that has its stamp"
    )
    lockstep_with_mission: bool = parameter(
        False, "and for a Header on mission_tick that has it as well"
    )
    answer_deadline: float = parameter(
        5.0,
        "of wall time, after which a tick without its answers goes on, standing [s]",
        minimum=0.01,
        maximum=3600.0,
    )
    truth_file: str = parameter("", "file for the truth, a JSON line per tick; empty for none")

    def maze(self) -> Maze:
        """Raises MazeError."""
        if self.world:
            return Maze.load(Path(self.world))
        return generate_maze(self.seed, self.family)


@dataclass(frozen=True)
class SensorFrameConfig(BurgerFrameConfig):
    """The frames of the robot with its sensors."""

    scan_frame: str = parameter(BASE_SCAN, "frame of the lidar")
    imu_frame: str = parameter(IMU, "frame of the inertial unit")

    def frames(self) -> Frames:
        """Raises FrameIdError."""
        own = Frames(
            map=self.map_frame,
            odom=self.odom_frame,
            footprint=self.base_frame,
            scan=self.scan_frame,
            imu=self.imu_frame,
        )
        return own.prefixed(self.frame_prefix)
