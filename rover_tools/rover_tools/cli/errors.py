"""The edge of every subcommand: errors that the user can act on become one sentence."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable

from rover_common.ground_truth import TruthError
from rover_simulator.recordings.recording import RecordingError
from rover_simulator.recordings.replay import NoAnswerError
from rover_simulator.world.world import WorldError
from rover_tools.evaluation.results import SamplesError
from rover_tools.evaluation.strategy import ParametersError
from rover_tools.runner.domain import NoFreeDomainError
from rover_tools.runner.graph_watch import GraphNotReadyError
from rover_tools.runner.processes import ProcessDiedError
from rover_tools.scoreboard.errors import ScoreboardError

EXPECTED = (
    GraphNotReadyError,
    NoAnswerError,
    NoFreeDomainError,
    OSError,
    ParametersError,
    ProcessDiedError,
    RecordingError,
    SamplesError,
    ScoreboardError,
    TruthError,
    WorldError,
)


def run_command(name: str, body: Callable[[], None]) -> int:
    """Run the body; the exit code is 0, 1 after an expected error, 130 after Ctrl-C."""
    # A supervisor's SIGTERM ends the processes of the run as well, like Ctrl-C.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        body()
    except EXPECTED as error:
        print(f"rover {name}: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"rover {name}: stopped", file=sys.stderr)
        return 130
    return 0
