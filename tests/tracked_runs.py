"""A run tracker and its telemetries by hand."""

from __future__ import annotations

import numpy as np

from rover_bridge.run_tracker import AGREEING, RunTracker
from rover_common.geometry import Pose
from rover_common.types import Run, Telemetry

SECOND = 1_000_000_000  # [ns]


def telemetry(
    x: float = 100.0, y: float = 80.0, samples: int = 6, sim_time: float | None = 0.0
) -> Telemetry:
    return Telemetry(
        pose=Pose(x, y, 0.0),
        speed=0.0,
        throttle=0.0,
        brake=0.0,
        steering_angle=0.0,
        near_sample=False,
        picking_up=False,
        sample_count=samples,
        samples=np.zeros((samples, 2)),
        jpeg=b"",
        image=np.zeros((1, 1, 3), np.uint8),
        sim_time=sim_time,
    )


def track(tracker: RunTracker, time: float, **changes: float | None) -> tuple[Run, int]:
    """The run and the stamp of a telemetry, which is sent until it is confirmed."""
    for _ in range(AGREEING):
        tracked = tracker.track(telemetry(**changes), time)
        if tracked is not None:
            return tracked
    raise AssertionError(f"never confirmed: {tracker.contradiction}")


def number(tracker: RunTracker, time: float, **changes: float | None) -> int:
    """The run that telemetries at this time [s] belong to."""
    return track(tracker, time, **changes)[0].number


def tracker_at_ten() -> RunTracker:
    """In its first run, at 10 s."""
    tracker = RunTracker()
    run, stamp = track(tracker, 10.0)
    assert (run.number, run.start, stamp) == (1, 10 * SECOND, 10 * SECOND)
    return tracker
