"""How long a good simulator waits for its answers beside clients that harm: run by hand, alone.

./rover shell -c 'python tests/bridge/wire_waits.py'
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import rclpy
from flooders import running
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from telemetry import telemetry
from wire_clients import Decider, Unity

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.ros.fast_dds import use_profiles

SECONDS = 5.0  # [s] of each flood
IDLE = 100  # connections that say nothing
FLOODS = {
    "one client, 10,000 messages a second": ("--clients", 1, "--rate", 10000),
    "one client, as fast as it can": ("--clients", 1),
    "eight clients, as fast as they can": ("--clients", 8),
}


@contextmanager
def bridge() -> Iterator[int]:
    """The port of a bridge whose telemetries another node answers."""
    node = BridgeNode(parameter_overrides=[Parameter("port", value=0)])
    decider = Decider()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(decider)
    ended = threading.Event()

    def spin() -> None:
        while not ended.is_set():
            executor.spin_once(timeout_sec=0.05)

    thread = threading.Thread(target=spin)
    thread.start()
    while not (node.count_subscribers(topics.COMMAND) and decider.count_publishers(topics.STATUS)):
        ended.wait(0.05)
    try:
        yield node.port
    finally:
        ended.set()
        thread.join()
        node.destroy_node()
        decider.destroy_node()


def ask(unity: Unity) -> float:
    """[s] until a telemetry has its answer."""
    start = time.monotonic()
    unity.ask(telemetry())
    return time.monotonic() - start


def report(name: str, waits: list[float]) -> None:
    waits.sort()
    median, worst = 1e3 * waits[len(waits) // 2], 1e3 * waits[-1]
    print(f"{name}: {len(waits)} answers, median {median:.1f} ms, worst {worst:.1f} ms", flush=True)


def ask_for(unity: Unity, seconds: float) -> list[float]:
    waits, end = [], time.monotonic() + seconds
    while time.monotonic() < end:
        waits.append(ask(unity))
    return waits


def main() -> None:
    use_profiles()
    rclpy.init()
    for name, arguments in FLOODS.items():
        with bridge() as port, Unity(port) as unity:
            ask(unity)
            report("alone", ask_for(unity, SECONDS))
            with running("flood", port, *arguments, "--seconds", 3 * SECONDS):
                report(name, ask_for(unity, SECONDS))
    for kind in ("tcp", "websocket"):
        with bridge() as port, running(kind, port, "--clients", IDLE, "--seconds", 60):
            start = time.monotonic()
            with Unity(port) as unity:
                ask(unity)
                report(f"a new simulator beside {IDLE} idle {kind}", [time.monotonic() - start])
    rclpy.shutdown()


if __name__ == "__main__":
    main()
