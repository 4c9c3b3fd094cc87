"""Telemetry to command through the three processes, over the wire and DDS."""

from __future__ import annotations

import itertools
import time
from dataclasses import replace
from pathlib import Path

from rover_simulator.recordings.recording import Recording
from rover_simulator.recordings.replay import play, telemetry_of, wait_for_answer
from rover_simulator.wire.unity_client import UnityClient
from rover_tools.evaluation.recordings import example_recording
from rover_tools.evaluation.results import Result, percentile_ms, summary
from rover_tools.output import note, print_result, result_folder, write_result
from rover_tools.runner.replay import OVERRIDES
from rover_tools.runner.run import Run, running_graph

WARM_UP = 50  # frames not counted: first use of libraries, caches, buffers
BLOCK = 100  # frames in turn with and without insets, so that what the machine does meets both


def bench(frames: int, chosen: Path | None, insets: bool, out: Path | None, as_json: bool) -> None:
    """Measure on the chosen recording, or on an example; write and print the result."""
    folder = result_folder("bench-graph", out)
    recording, source = example_recording(chosen, folder)
    with running_graph(folder, OVERRIDES) as run:
        method = measure_insets if insets else measure
        result = {"source": source, **method(run, recording, frames)}
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


def measure_insets(run: Run, recording: Recording, count: int) -> Result:
    """The same of a client that shows insets and shows none, block by block in turn."""
    client = UnityClient(run.host, run.port)
    client.connect(timeout=10.0)
    latencies: dict[str, list[float]] = {"0": [], "1": []}  # [s] by `shows_insets`
    try:
        for index, frame in enumerate(_repeated(recording, WARM_UP + 2 * count).frames):
            shows = str((index - WARM_UP) // BLOCK % 2)
            telemetry = telemetry_of(frame, frame.image_path.read_bytes())
            start = time.perf_counter()
            client.send_telemetry(telemetry | {"shows_insets": shows})
            wait_for_answer(client)
            if index >= WARM_UP:
                latencies[shows].append(time.perf_counter() - start)
    finally:
        client.close()
    run.processes.check()
    hidden, shown = tuple(latencies["0"]), tuple(latencies["1"])  # [s]
    without, with_insets = percentile_ms(hidden, 50), percentile_ms(shown, 50)
    return {
        "frames": len(shown),
        "latency_ms_p50": without,
        "latency_ms_p99": percentile_ms(hidden, 99),
        "latency_insets_ms_p50": with_insets,
        "latency_insets_ms_p99": percentile_ms(shown, 99),
        "insets_ms": round(with_insets - without, 2),
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
