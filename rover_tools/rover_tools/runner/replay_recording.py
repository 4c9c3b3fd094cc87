"""Replay a recording of the graph through perception and decision, and compare what they make."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from rover_common.types import Command, GridMap
from rover_recorder.errors import RecordingError
from rover_tools.evaluation.results import Result, Truth
from rover_tools.progress import Progress
from rover_tools.runner.node_player import Player
from rover_tools.runner.recorded_run import FrameMessages, RecordedRun
from rover_tools.runner.replay import write_replay
from rover_tools.runner.run import started_graph

NODES = ("perception_node", "decision_node")


def replay_recording(
    recorded: RecordedRun, folder: Path, params: Path | None, truth: Truth, in_flight: int
) -> Result:
    """Play the recording into the two nodes, score their map, and write the results.

    Raises DomainError, GraphNotReadyError, ProcessDiedError, NoAnswerError, RecordingError, or
    TelemetryError for an image that is none.
    """
    stamp, map_then = recorded.last_map() or (None, None)
    track: list[tuple[int, float, float]] = []  # stamp [ns], x, y [m]

    def frames() -> Iterator[FrameMessages]:
        for frame in recorded.frames():
            track.append((frame.stamp, frame.pose.x, frame.pose.y))
            yield frame

    with (
        started_graph(folder, parameters_file=params, nodes=NODES) as run,
        Player(run.domain_id) as player,
    ):
        run.wait_ready(NODES)
        answered = itertools.count(1)
        with Progress(recorded.frame_count, "frames") as progress:
            playback = player.play(
                frames(), in_flight, stamp, lambda: progress.show(next(answered), "replayed")
            )
        if not track:
            raise RecordingError(f"{recorded.recording.path} holds no whole frame")
        comparison = {
            "commands_different": different_commands(recorded.commands(), player.commands),
            "map_cells_different": different_cells(map_then, player.map_then),
        }
        playback = replace(playback, skipped=recorded.frame_count - playback.frames)
        stamps, x, y = zip(*track, strict=True)
        title = str(recorded.recording.path)
        return write_replay(playback, stamps[-1], np.array([x, y]).T, run, truth, title, comparison)


def different_commands(some: dict[int, Command], others: dict[int, Command]) -> int:
    """On the frames that both know, by their stamps."""
    return sum(some[stamp] != others[stamp] for stamp in some.keys() & others.keys())


def different_cells(one: GridMap | None, other: GridMap | None) -> int | None:
    """Of two maps of the same ground; None where there are no two."""
    if one is None or other is None:
        return None
    return int(np.count_nonzero(one.cells != other.cells))
