"""The simulator's speed with a server at the other end."""

import os
import threading
import time

from rover_tools.benchmarks.wire_speed import processor_seconds, wire_speed


def test_the_processors_time_counts_work_and_not_waiting():
    before = processor_seconds(os.getpid())
    while time.thread_time() < 0.5:  # what the process has done before may be enough
        sum(range(10_000))
    working = time.process_time()
    assert processor_seconds(os.getpid()) >= before
    assert abs(processor_seconds(os.getpid()) - working) < 1.0
    threading.Event().wait(0.3)
    assert processor_seconds(os.getpid()) - working < 1.0


def test_frames_go_over_the_wire_and_no_thread_stays():
    threads = threading.active_count()
    assert wire_speed(seed=3, frames=20)["wire_frames_per_second"] > 0
    assert threading.active_count() == threads
