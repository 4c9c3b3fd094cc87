"""Spin one node until SIGINT or SIGTERM and leave with exit code 0."""

from __future__ import annotations

import os
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rclpy
from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.exceptions import ParameterException
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from rover_common.errors import CANNOT_START, RoverError
from rover_common.ros.fast_dds import use_profiles
from rover_common.ros.memory import return_large_arrays
from rover_common.ros.parameters import unknown_parameters
from rover_common.ros.shared_memory import remove_stale_memory

try:  # handles messages faster, but knows no guard conditions; not in every release of Jazzy
    from rclpy.experimental import EventsExecutor
except ImportError:
    EventsExecutor = SingleThreadedExecutor

# Python hears of a signal between two waits.
WAIT_SECONDS = 0.2
MAX_DOMAIN = 232  # beyond, DDS has no ports
SOURCE_LINE = re.compile(r", at /.*", re.DOTALL)  # of the C library, in its messages


class StartError(RoverError):
    """ROS cannot start with these arguments, or in this environment."""


def start_ros(args: list[str] | None = None, **options: Any) -> None:
    """As rclpy.init; raises StartError for arguments or a domain that are none."""
    domain = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not (domain.isdecimal() and int(domain) <= MAX_DOMAIN):
        raise StartError(f"ROS_DOMAIN_ID is '{domain}', not a number from 0 to {MAX_DOMAIN}")
    use_profiles()
    remove_stale_memory()
    try:
        rclpy.init(args=args, **options)
    except (RCLError, RCLInvalidROSArgsError, UnknownROSArgsError) as error:
        raise StartError(SOURCE_LINE.sub("", str(error))) from error


def spin_for(executor: Executor, seconds: float) -> None:
    """Handle whatever comes within so many seconds; a call per event costs a third more."""
    executor.spin_until_future_complete(Future(), timeout_sec=seconds)


class StopSignals:
    """SIGINT and SIGTERM, which end the wait at hand; those after the first change nothing.

    An executor whose callbacks never pause does not end for a timeout, but for its future.
    """

    def __init__(self) -> None:
        self.asked = False
        self._wait: Future | None = None  # the one at hand
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def spin(self, executor: Executor) -> None:
        """Handle whatever comes for a while, or until a signal."""
        self._wait = Future()
        self._wait._lock = threading.RLock()  # a signal may come while it is held
        if not self.asked:
            executor.spin_until_future_complete(self._wait, timeout_sec=WAIT_SECONDS)
        self._wait = None

    def _ask(self, *_: object) -> None:
        self.asked = True
        if self._wait is not None:
            self._wait.set_result(None)


@contextmanager
def start_errors() -> Iterator[None]:
    """What cannot be used ends the process with one line, and with an exit code that says so."""
    try:
        yield
    except (RoverError, ParameterException, OSError) as error:
        print(f"{Path(sys.argv[0]).name}: {' '.join(str(error).split())}", file=sys.stderr)
        sys.exit(CANNOT_START)


def run_node(
    factory: Callable[[], Node],
    args: list[str] | None = None,
    executor_class: Callable[[], Executor] = EventsExecutor,
    keeps_maps: bool = False,
) -> None:
    """Make the node and spin it in this thread.

    A signal ends the loop alone, not the context: a callback that runs may still publish, and the
    node closes while ROS is there. One that keeps maps does not grow from mission to mission.
    """
    stop = StopSignals()
    if keeps_maps:
        return_large_arrays()
    with start_errors():
        start_ros(args, signal_handler_options=SignalHandlerOptions.NO)
    node = None
    try:
        with start_errors():
            node = factory()
        for name in unknown_parameters(node):
            node.get_logger().warning(f"ignored: there is no parameter {name}")
        executor = executor_class()
        executor.add_node(node)
        while not stop.asked and rclpy.ok():
            stop.spin(executor)
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
