"""Play a recorded run over the wire, as the simulator that made it would send it."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from rover_common.errors import RoverError
from rover_simulator.recordings.recording import RecordedFrame, Recording
from rover_simulator.wire.telemetry_format import format_telemetry
from rover_simulator.wire.unity_client import ANSWERED_EVENTS, Event, UnityClient

# Simulated time begins here: a ROS clock that reads zero counts as not yet set.
START_TIME = 1.0  # [s]
ANSWER_TIMEOUT = 30.0  # [s] far beyond the bridge's own deadline


class NoAnswerError(RoverError):
    """The server left a telemetry without an answer."""


@dataclass(frozen=True)
class Playback:
    """The outcome of a replay."""

    frames: int  # sent, and answered
    skipped: int  # rows of the log that could not be used
    latencies: tuple[float, ...]  # [s] telemetry to command, in the order of the answers
    seconds: float  # [s] from the first telemetry to the last answer
    last_time: float  # [s] simulated time of the last frame


def play(
    recording: Recording,
    client: UnityClient,
    in_flight: int,
    on_answer: Callable[[], None] = lambda: None,
) -> Playback:
    """Send every frame of the recording to the connected server, as fast as it answers.

    At most `in_flight` telemetries are unanswered at any time: the simulator has two, from the two
    that it sends unasked on connecting. Raises NoAnswerError.
    """
    sent_at: deque[float] = deque()
    latencies: list[float] = []
    last_time = START_TIME
    start = time.perf_counter()

    def take_answer() -> None:
        wait_for_answer(client)
        latencies.append(time.perf_counter() - sent_at.popleft())
        on_answer()

    for frame in recording.frames:
        jpeg = frame.image_path.read_bytes()
        last_time = START_TIME + frame.time
        telemetry = telemetry_of(frame, jpeg)
        while len(sent_at) >= in_flight:
            take_answer()
        sent_at.append(time.perf_counter())
        client.send_telemetry(telemetry)
    while sent_at:
        take_answer()
    return Playback(
        frames=len(latencies),
        skipped=len(recording.skips),
        latencies=tuple(latencies),
        seconds=time.perf_counter() - start,
        last_time=last_time,
    )


def wait_for_answer(client: UnityClient) -> Event:
    """The next event that the simulator answers with a telemetry; raises NoAnswerError."""
    while (event := client.receive(ANSWER_TIMEOUT)) is not None:
        if event.name in ANSWERED_EVENTS:
            return event
    raise NoAnswerError(f"no answer within {ANSWER_TIMEOUT:.0f} s")


def telemetry_of(frame: RecordedFrame, jpeg: bytes) -> dict[str, str]:
    """The telemetry object of a recorded frame; recordings know nothing of the samples."""
    return format_telemetry(
        pose=frame.pose,
        speed=frame.speed,
        throttle=frame.throttle,
        brake=frame.brake,
        steering_angle=frame.steering_angle,
        near_sample=False,
        picking_up=False,
        sample_count=0,
        samples=(),
        image=jpeg,
        sim_time=START_TIME + frame.time,
    )
