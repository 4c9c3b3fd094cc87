"""Spin one node until SIGINT or SIGTERM and leave with exit code 0."""

from __future__ import annotations

import signal
from collections.abc import Callable

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

from rover_common.ros.fast_dds import use_profiles

try:  # handles messages faster, but knows no guard conditions; not in every release of Jazzy
    from rclpy.experimental import EventsExecutor
except ImportError:
    EventsExecutor = SingleThreadedExecutor

# An idle executor's endless wait now and then misses a signal; a bounded one never does.
WAIT_SECONDS = 0.2


def spin_for(executor: Executor, seconds: float) -> None:
    """Handle whatever comes within so many seconds; a call per event costs a third more."""
    executor.spin_until_future_complete(Future(), timeout_sec=seconds)


def run_node(
    factory: Callable[[], Node],
    args: list[str] | None = None,
    executor_class: Callable[[], Executor] = EventsExecutor,
) -> None:
    """Make the node and spin it in this thread."""
    # rclpy shuts its context down and then chains to this handler, so that no KeyboardInterrupt is
    # raised at an arbitrary line.
    signal.signal(signal.SIGINT, lambda *_: None)
    use_profiles()
    rclpy.init(args=args)
    node = None
    try:
        node = factory()
        executor = executor_class()
        executor.add_node(node)
        while rclpy.ok():
            spin_for(executor, WAIT_SECONDS)
    except ExternalShutdownException:
        pass
    except RCLError:
        if rclpy.ok():  # otherwise it is the race with the shutdown
            raise
    finally:
        # A terminal and ros2 launch both send SIGINT: the second must not interrupt the clean-up.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
