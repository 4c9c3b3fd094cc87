"""Play a recorded run into the running graph, and score what it published."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rover_common.errors import RoverError
from rover_simulator.recordings.recording import Recording
from rover_simulator.recordings.replay import Playback, play
from rover_simulator.wire.unity_client import UnityClient
from rover_tools.evaluation.results import Result, Truth, percentile_ms, score, write_results
from rover_tools.progress import Progress
from rover_tools.runner.run import Run, running_graph

REFUSED = "telemetry_"  # counters of the bridge begin with it: a frame that it did not publish
MAP_SECONDS = 5.0  # [s] for the map with the last frame to arrive

# A recording waits for its answers, and each image was taken at its own pose.
OVERRIDES: dict[str, dict[str, object]] = {
    "bridge_node": {"answer_deadline": 5.0},
    "perception_node": {"image_lag": 0},
}


class UnusedRunError(RoverError):
    """The graph could use no frame of a run."""


def replay_log(
    recording: Recording,
    folder: Path,
    params: Path | None,
    truth: Truth,
    in_flight: int,
    title: str,
) -> Result:
    """Play the recording into a graph, score what it published, write the results."""
    with running_graph(folder, OVERRIDES, params) as run:
        return _replay(recording, run, truth, in_flight, title)


def _replay(recording: Recording, run: Run, truth: Truth, in_flight: int, title: str) -> Result:
    playback = _play_with_progress(recording, run, in_flight)
    track = np.array([(frame.pose.x, frame.pose.y) for frame in recording.frames])
    last_stamp = round(playback.last_time * 1e9)
    remarks: Result = {"remarks": recording.remarks()}
    return write_replay(playback, last_stamp, track, run, truth, title, remarks)


def write_replay(
    playback: Playback,
    last_stamp: int,
    track: NDArray[np.float64],
    run: Run,
    truth: Truth,
    title: str,
    others: Result,
) -> Result:
    """Score what the graph published of a replay, and write the results.

    last_stamp [ns]: of the last frame; track: positions (n, 2) [m]. `others` become parts of the
    result. Raises UnusedRunError.
    """
    run.processes.check()
    grid = run.watch.wait_map(last_stamp, MAP_SECONDS)
    rocks = run.watch.rocks()
    counts = run.watch.counts()
    refused = refusals(counts)
    if not counts.get("perception_node", {}).get("frames"):
        causes = ", ".join(f"{cause} ({count})" for cause, count in refused.items())
        raise UnusedRunError(
            f"none of {playback.frames} frames could be used: {causes or 'none was mapped'}; "
            f"{run.folder / 'log'} tells more"
        )
    result = {
        "frames": playback.frames,
        "frames_refused": sum(refused.values()),
        "frames_skipped": playback.skipped,
        "frames_per_second": round(playback.frames / playback.seconds, 1),
        "latency_ms_p50": percentile_ms(playback.latencies, 50),
        "latency_ms_p99": percentile_ms(playback.latencies, 99),
        **others,
        **score(grid, rocks, truth),
        "counts": counts,
    }
    write_results(run.folder, result, grid, track, rocks, truth, title)
    return result


def refusals(counts: Mapping[str, Mapping[str, int]]) -> dict[str, int]:
    """How many frames the bridge did not publish, by cause."""
    return {
        name.removeprefix(REFUSED).replace("_", " "): count
        for name, count in counts.get("bridge_node", {}).items()
        if name.startswith(REFUSED)
    }


def _play_with_progress(recording: Recording, run: Run, in_flight: int) -> Playback:
    client = UnityClient(run.host, run.port)
    client.connect(timeout=10.0)
    answered = itertools.count(1)
    try:
        with Progress(len(recording.frames), "frames") as progress:
            return play(
                recording, client, in_flight, lambda: progress.show(next(answered), "replayed")
            )
    finally:
        client.close()
