"""The commands of a recorded drive, as the simulated vehicle takes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from rover_simulator.recordings.recording import RecordedFrame
from rover_simulator.vehicle.vehicle import STEP, Controls


def commands(
    frames: Sequence[RecordedFrame],
) -> Iterator[tuple[RecordedFrame, Controls, int]]:
    """Each frame but the last, the controls until the next one, and the physics steps to it."""
    start = frames[0].time
    for frame, following in pairwise(frames):
        steps = round((following.time - start) / STEP) - round((frame.time - start) / STEP)
        yield frame, between(frame, following), steps


def between(frame: RecordedFrame, following: RecordedFrame) -> Controls:
    """Keys ramp their inputs, so that between two samples the input is about their mean."""
    return Controls(
        (frame.steering_angle + following.steering_angle) / 2,
        (frame.throttle + following.throttle) / 2,
        (frame.brake + following.brake) / 2,
    )
