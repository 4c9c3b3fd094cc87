"""`rover replay DIR`: a recorded run through the wire, the graph and the scoring."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np
from tqdm import tqdm

from rover_simulator.recordings.recording import Recording, read_recording
from rover_simulator.recordings.replay import Playback, play
from rover_simulator.wire.unity_client import UnityClient
from rover_tools.cli.errors import run_command
from rover_tools.evaluation.results import (
    Result,
    Truth,
    percentile_ms,
    score,
    summary,
    write_results,
)
from rover_tools.runner.run import Run, note, result_folder, running_graph

MAP_SECONDS = 5.0  # [s] for the map with the last frame to arrive

# A recording waits for its answers, and each image was taken at its own pose.
OVERRIDES: dict[str, dict[str, object]] = {
    "bridge_node": {"answer_deadline": 5.0},
    "perception_node": {"image_lag": 0},
}


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    options = _parser().parse_args(arguments)
    return run_command("replay", lambda: _replay(options))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="rover replay", description=__doc__)
    add = parser.add_argument
    add("folder", type=Path, help="the recorded run: robot_log.csv and its images in IMG/")
    add("--truth", type=Path, metavar="PNG", help="the true map, 200 x 200, non-zero navigable")
    add("--samples", type=Path, metavar="CSV", help="true positions of the rocks in view: x,y [m]")
    add(
        "--yaw-convention",
        choices=("ccw-from-east", "cw-from-north"),
        default="ccw-from-east",
        help="of the log's yaw (default: %(default)s)",
    )
    add("--in-flight", type=int, default=2, choices=(1, 2, 3), metavar="N",
        help="telemetries unanswered at a time, 1 to 3 (default: %(default)s)")  # fmt: skip
    add("--params", type=Path, metavar="YAML", help="parameters instead of those that ship")
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true", help="print the result as one JSON object")
    return parser


def _replay(options: argparse.Namespace) -> None:
    recording = read_recording(options.folder, options.yaw_convention)
    truth = Truth.load(options.truth, options.samples)
    folder = result_folder("replay", options.out)
    with running_graph(folder, OVERRIDES, options.params) as run:
        result = replay(recording, run, truth, options.in_flight, str(options.folder))
    print(json.dumps(result) if options.json else summary(result))
    note(f"replayed {result['frames']} frames; results in {folder}")


def replay(recording: Recording, run: Run, truth: Truth, in_flight: int, title: str) -> Result:
    """Play the recording into the running graph, score what it published, write the results."""
    playback = _play_with_progress(recording, run, in_flight)
    run.processes.check()
    grid = run.watch.wait_map(round(playback.last_time * 1e9), MAP_SECONDS)
    rocks = run.watch.rocks()
    result = {
        "frames": playback.frames,
        "frames_skipped": playback.skipped,
        "frames_per_second": round(playback.frames / playback.seconds, 1),
        "latency_ms_p50": percentile_ms(playback.latencies, 50),
        "latency_ms_p99": percentile_ms(playback.latencies, 99),
        **score(grid, rocks, truth),
        "counts": run.watch.counts(),
    }
    track = np.array([(frame.pose.x, frame.pose.y) for frame in recording.frames])
    write_results(run.folder, result, grid, track, rocks, truth, title)
    return result


def _play_with_progress(recording: Recording, run: Run, in_flight: int) -> Playback:
    client = UnityClient(run.host, run.port)
    client.connect(timeout=10.0)
    try:
        # disable=None: no bar where standard error is not a terminal.
        with tqdm(total=len(recording.frames), unit="frame", disable=None) as bar:
            return play(recording, client, in_flight, bar.update)
    finally:
        client.close()
