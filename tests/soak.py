"""Measures whether hours of driving leave anything behind in the three nodes.

Run by hand, on an idle machine:

./rover shell -c 'PYTHONPATH=tests:tests/dashboard:$PYTHONPATH python tests/soak.py --hours 2'

Missions follow each other in the embedded simulator, as fast as the graph answers. Every ten
seconds of wall time the memory, threads and descriptors of each node are taken, and the files in
shared memory; of each span the 99th percentile of the time from odometry to command. Prints one
JSON object: the medians of the second span, as the first one fills caches, of the last one, and the
highest from the second span on.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import psutil
from latency import Latency
from std_srvs.srv import Trigger
from watched_graph import Watched, watched_graph

from rover_common.ros.shared_memory import FOLDER
from rover_tools.runner.graph import NODES

SEED, SIZE = 2, 1.0
LOOK = 10.0  # [s] of wall time between two looks
SPAN = 600.0  # [s] of simulated time
HOUR, SECOND, MEBIBYTE = 3600.0, 10**9, 2**20


class Span:
    """What was seen in so much simulated time."""

    def __init__(self) -> None:
        self.looks: list[dict[str, float]] = []
        self.laps: list[float] = []

    def summary(self) -> dict[str, float]:
        values = {
            name: round(statistics.median(look[name] for look in self.looks), 1)
            for name in self.looks[0]
        }
        return values | {"p99_ms": round(float(np.percentile(self.laps, 99)), 1)}


def look_at(watched: Watched) -> dict[str, float]:
    """Memory [MiB], threads and descriptors by node, and files in shared memory."""
    found: dict[str, float] = {}
    for name in NODES:
        process = psutil.Process(watched.run.processes.pid(name))
        with process.oneshot():
            found[f"{name} MiB"] = process.memory_info().rss / MEBIBYTE
            found[f"{name} threads"] = process.num_threads()
            found[f"{name} descriptors"] = process.num_fds()
    return found | {"shared memory files": len(list(FOLDER.iterdir()))}


def soak(watched: Watched, hours: float) -> list[Span]:
    """The spans, in their order; a mission that is over begins again."""
    watch = watched.run.watch
    latency = Latency(watch.node)
    start = watch.node.create_client(Trigger, "decision_node/start")
    spans: list[Span] = []
    begin = None
    while (driven := 0.0 if begin is None else latency.stamp / SECOND - begin) < hours * HOUR:
        time.sleep(LOOK)
        watched.run.processes.check()
        if latency.stamp == 0:
            continue
        begin = latency.stamp / SECOND if begin is None else begin
        if driven >= SPAN * len(spans):
            spans.append(Span())
        span = spans[-1]
        span.looks.append(look_at(watched))
        laps, latency.laps = latency.laps, []
        span.laps += laps
        print(f"{driven:7.0f} s", json.dumps(span.summary()), file=sys.stderr)
        if watch.mission is not None and watch.mission.state_name == "DONE":
            start.call_async(Trigger.Request())
    return spans


def main() -> None:
    parser = argparse.ArgumentParser(description="Measure, and print one JSON object.")
    parser.add_argument("--hours", type=float, default=2.0, help="of simulated time")
    hours = parser.parse_args().hours
    began = time.monotonic()
    with (
        tempfile.TemporaryDirectory() as folder,
        watched_graph(Path(folder), SEED, SIZE, "fast") as watched,
    ):
        spans = soak(watched, hours)
        runs = watched.run.watch.mission.run if watched.run.watch.mission else 0
    summaries = [span.summary() for span in spans]
    counted = summaries[1:] or summaries
    highest = {name: max(each[name] for each in counted) for name in counted[0]}
    print(
        json.dumps(
            {
                "simulated_hours": hours,
                "wall_minutes": round((time.monotonic() - began) / 60, 1),
                "missions": runs,
                "second_span": counted[0],
                "last_span": counted[-1],
                "highest": highest,
                "p99_ms": [each["p99_ms"] for each in summaries],
                "load": os.getloadavg()[0],
            }
        )
    )


if __name__ == "__main__":
    main()
