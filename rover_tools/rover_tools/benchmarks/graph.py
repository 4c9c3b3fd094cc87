"""Telemetry to command through the three processes, over the wire and DDS."""

from __future__ import annotations

import itertools
from dataclasses import replace
from pathlib import Path

from rover_simulator.recordings.recording import Recording
from rover_simulator.recordings.replay import play
from rover_simulator.wire.unity_client import UnityClient
from rover_tools.evaluation.recordings import example_recording
from rover_tools.evaluation.results import Result, percentile_ms, summary
from rover_tools.output import note, print_result, result_folder, write_result
from rover_tools.runner.replay import OVERRIDES
from rover_tools.runner.run import Run, running_graph

WARM_UP = 50  # frames not counted: first use of libraries, caches, buffers


def bench(frames: int, chosen: Path | None, out: Path | None, as_json: bool) -> None:
    """Measure on the chosen recording, or on an example; write and print the result."""
    folder = result_folder("bench-graph", out)
    recording, source = example_recording(chosen, folder)
    with running_graph(folder, OVERRIDES) as run:
        result = {"source": source, **measure(run, recording, frames)}
    write_result(folder, result)
    print_result(result, as_json, summary(result))
    note(f"one telemetry in flight, {WARM_UP} frames of warm-up not counted; results in {folder}")


def measure(run: Run, recording: Recording, count: int) -> Result:
    """Send `count` frames, one at a time, after a warm-up."""
    client = UnityClient(run.host, run.port)
    client.connect(timeout=10.0)
    try:
        playback = play(_repeated(recording, WARM_UP + count), client, in_flight=1)
    finally:
        client.close()
    run.processes.check()
    latencies = playback.latencies[WARM_UP:]
    return {
        "frames": len(latencies),
        "latency_ms_p50": percentile_ms(latencies, 50),
        "latency_ms_p90": percentile_ms(latencies, 90),
        "latency_ms_p99": percentile_ms(latencies, 99),
        "latency_ms_max": percentile_ms(latencies, 100),
        "frames_per_second": round(len(latencies) / sum(latencies), 1),
        "counts": run.watch.counts(),
    }


def _repeated(recording: Recording, count: int) -> Recording:
    """The recording over and over, with time going on, `count` frames in all."""
    length = recording.frames[-1].time + 0.1
    frames = (
        replace(frame, time=frame.time + lap * length)
        for lap in itertools.count()
        for frame in recording.frames
    )
    return Recording(tuple(itertools.islice(frames, count)))
