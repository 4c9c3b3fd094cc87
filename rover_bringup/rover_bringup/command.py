"""The edge of every subcommand: errors that the user can act on become one sentence."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable

from rover_bringup.domain import NoFreeDomainError
from rover_bringup.node_watch import GraphNotReadyError
from rover_bringup.processes import ProcessDiedError
from rover_bringup.results import SamplesError
from rover_bringup.scoreboard.errors import ScoreboardError
from rover_bringup.strategy import ParametersError
from rover_common.scoring import TruthError
from rover_simulator.recording import RecordingError
from rover_simulator.replay import NoAnswerError
from rover_simulator.world import WorldError

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
