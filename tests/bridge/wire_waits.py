"""How long a good simulator waits beside clients that harm, and what they cost: run by hand, alone.

./rover shell -c 'PYTHONPATH=tests:$PYTHONPATH python tests/bridge/wire_waits.py'

Memory is that of this process, in which the bridge runs: the most while a client harms, over what
it was before.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import psutil
import rclpy
from flooders import running
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from telemetry import picture_bomb, telemetry
from wire_clients import Decider, Unity

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.ros.fast_dds import use_profiles

SECONDS = 5.0  # [s] of each flood
IDLE = 100  # connections that say nothing
BOMBS = 50
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


def ask(unity: Unity, wire: dict[str, str] | None = None) -> float:
    """[s] until a telemetry has its answer."""
    start = time.monotonic()
    unity.ask(telemetry() if wire is None else wire)
    return time.monotonic() - start


def memory() -> float:
    """[MiB]"""
    return float(psutil.Process().memory_info().rss) / 2**20


class Report:
    """Of the waits beside somebody; printed as it ends."""

    def __init__(self, name: str) -> None:
        self._name, self._before = name, memory()
        self._most = self._before
        self._waits: list[float] = []

    def add(self, seconds: float) -> None:
        self._waits.append(seconds)
        self._most = max(self._most, memory())

    def ask_for(self, unity: Unity, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.add(ask(unity))

    def tell(self) -> None:
        waits = sorted(self._waits)
        median, worst = 1e3 * waits[len(waits) // 2], 1e3 * waits[-1]
        print(
            f"{self._name}: {len(waits)} answers, median {median:.1f} ms, worst {worst:.1f} ms, "
            f"memory {self._most - self._before:+.1f} MiB",
            flush=True,
        )


def beside_floods() -> None:
    for name, arguments in FLOODS.items():
        with bridge() as port, Unity(port) as unity:
            ask(unity)
            alone = Report("alone")
            alone.ask_for(unity, SECONDS)
            alone.tell()
            beside = Report(name)
            with running("flood", port, *arguments, "--seconds", 3 * SECONDS):
                beside.ask_for(unity, SECONDS)
            beside.tell()


def beside_idle_connections() -> None:
    for kind in ("tcp", "websocket"):
        with bridge() as port:
            beside = Report(f"a new simulator beside {IDLE} idle {kind}")
            with running(kind, port, "--clients", IDLE, "--seconds", 60):
                start = time.monotonic()
                with Unity(port) as unity:
                    ask(unity)
                    beside.add(time.monotonic() - start)
            beside.tell()


def beside_picture_bombs() -> None:
    """Small files that claim a picture of gigabytes, each before a good telemetry."""
    bomb = telemetry() | {"image": picture_bomb()}
    with bridge() as port, Unity(port) as unity:
        ask(unity)
        beside = Report(f"{BOMBS} pictures of 32760 x 32760")
        for _ in range(BOMBS):
            for wire in (bomb, telemetry()):
                beside.add(ask(unity, wire))
        beside.tell()


def main() -> None:
    use_profiles()
    rclpy.init()
    beside_floods()
    beside_idle_connections()
    beside_picture_bombs()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
