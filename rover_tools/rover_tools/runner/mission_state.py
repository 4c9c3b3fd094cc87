"""What is kept of a mission while it runs, so that `--resume` can go on with it after a crash.

The folder `state` of the result folder holds how the mission was started, the saved states of the
nodes and that of the simulator. It goes when the mission is over.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from rover_common.errors import RoverError
from rover_common.whole_file import write_whole
from rover_recorder.reader import FOLDER as RECORDING
from rover_tools.evaluation.strategy import Strategy
from rover_tools.runner.graph import NODES

STATE, LOG = "state", "log"
SETUP = "mission.json"
SIMULATION = "simulation.state"


class ResumeError(RoverError):
    """There is no mission in the folder that can go on."""


@dataclass(frozen=True)
class MissionSetup:
    """How a mission was started."""

    seed: int
    time_limit: float  # [s] of simulated time
    fps: float
    explorer: str
    way_home: str
    whole: bool  # whether what comes with the strategy's name is set too
    parameters: str | None  # path of a file

    @classmethod
    def of(
        cls, seed: int, time_limit: float, fps: float, strategy: Strategy, parameters: Path | None
    ) -> MissionSetup:
        file = None if parameters is None else str(parameters.resolve())
        chosen = strategy.explorer, strategy.way_home, strategy.whole
        return cls(seed, time_limit, fps, *chosen, file)

    @property
    def strategy(self) -> Strategy:
        return Strategy(self.explorer, self.way_home, self.whole)

    @property
    def parameters_file(self) -> Path | None:
        return None if self.parameters is None else Path(self.parameters)


def state_parameters(folder: Path) -> Mapping[str, Mapping[str, object]]:
    """Of the nodes, by their names: where they keep their states for a result folder."""
    return {node: {"state_dir": str(folder.resolve() / STATE)} for node in NODES}


def prepare(folder: Path, setup: MissionSetup, resume: bool) -> None:
    """Keep how a mission is started; of one that goes on, its logs and its recording so far."""
    if resume:
        _set_aside(folder)
        return
    end(folder)
    (folder / STATE).mkdir(parents=True)
    write_whole(folder / STATE / SETUP, json.dumps(asdict(setup)))


def begun(folder: Path) -> MissionSetup:
    """How the mission was started that was interrupted there; raises ResumeError."""
    file = folder / STATE / SETUP
    try:
        return MissionSetup(**json.loads(file.read_text()))
    except FileNotFoundError:
        raise ResumeError(f"no mission was interrupted in {folder}: there is no {file}") from None
    except (ValueError, TypeError) as error:
        raise ResumeError(f"{file} is not how a mission was started: {error}") from error


def _set_aside(folder: Path) -> None:
    """Under a name with the next number."""
    number = 1 + len(list(folder.glob(f"{LOG}-[0-9]*")))
    for name in (LOG, RECORDING):
        if (folder / name).exists():
            (folder / name).rename(folder / f"{name}-{number}")


def logs_of(folder: Path, name: str) -> list[Path]:
    """The log of a process in every part of the mission, in their order."""
    count = len(list(folder.glob(f"{LOG}-[0-9]*")))
    folders = [f"{LOG}-{number}" for number in range(1, count + 1)]
    logs = [folder / part / f"{name}.log" for part in [*folders, LOG]]
    return [log for log in logs if log.exists()]


def end(folder: Path) -> None:
    """Nothing can go on with a mission there any more."""
    shutil.rmtree(folder / STATE, ignore_errors=True)
