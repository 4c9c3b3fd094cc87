"""What all tests share: an isolated ROS context per test, and the recordings."""

from __future__ import annotations

import itertools
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent

os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"  # read when a message module is imported
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ.pop("ROS_DOMAIN_ID", None)  # what the tests start takes a free domain, one each
# What a shell runs in the background is deaf to Ctrl-C; the programs under test inherit from here.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:  # the same, below nohup
    signal.signal(signal.SIGHUP, signal.SIG_DFL)

import pytest  # noqa: E402
import rclpy  # noqa: E402
from hypothesis import settings  # noqa: E402
from rclpy.context import Context  # noqa: E402
from rclpy.executors import Executor, SingleThreadedExecutor  # noqa: E402
from rclpy.node import Node  # noqa: E402
from rclpy.parameter import Parameter  # noqa: E402

from rover_common.ros.fast_dds import use_profiles  # noqa: E402
from rover_tools.runner.domain import free_domain  # noqa: E402

settings.register_profile("rover", deadline=None)  # a busy machine is no fault
settings.load_profile("rover")
HOMES = itertools.count()
WAIT = 10.0  # [s] what a test waits at most for a thing to happen


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden",
        action="store_true",
        help="write the expected results of the golden replay anew",
    )


class Ros:
    """Nodes in one context of their own, spun in the test's thread until a predicate holds."""

    def __init__(
        self, domain_id: int, executor: Callable[..., Executor] = SingleThreadedExecutor
    ) -> None:
        use_profiles()
        self.context = Context()
        rclpy.init(context=self.context, args=[], domain_id=domain_id)
        self.executor = executor(context=self.context)
        self.nodes: list[Node] = []

    def add(self, factory: Callable[..., Node], **parameters: Any) -> Node:
        """Make a node with these parameter values and spin it with the others."""
        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        node = factory(context=self.context, parameter_overrides=overrides)
        self.executor.add_node(node)
        self.nodes.append(node)
        return node

    def end(self, node: Node) -> None:
        """As the end of its process."""
        self.executor.remove_node(node)
        self.nodes.remove(node)
        node.destroy_node()

    def spin_until(self, predicate: Callable[[], Any], timeout: float = WAIT) -> bool:
        """Spin until the predicate holds; False when it does not within the timeout [s]."""
        end = time.monotonic() + timeout
        while not predicate():
            left = end - time.monotonic()
            if left <= 0:
                return False
            self.executor.spin_once(timeout_sec=min(left, 0.05))
        return True

    def failures(self) -> list[str]:
        """What the nodes could not handle, which the executor does not raise."""
        counts = [getattr(node, "counts", {}) for node in self.nodes]
        return [key for each in counts for key in each if key.startswith("failed_")]

    def close(self) -> None:
        for node in reversed(self.nodes):
            self.executor.remove_node(node)
            node.destroy_node()
        self.executor.shutdown()
        self.context.try_shutdown()


def participants() -> int:
    """In DDS, of this process: each has one thread of this name."""
    count = 0
    for task in Path("/proc/self/task").iterdir():
        with suppress(OSError):  # it has ended
            count += (task / "comm").read_text().startswith("dds.ev.")
    return count


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    """Every test ends the threads that it started, and those of its nodes."""
    before, participants_before = set(threading.enumerate()), participants()
    yield
    end = time.monotonic() + WAIT
    while left := [t for t in threading.enumerate() if t not in before and t.is_alive()]:
        assert time.monotonic() < end, f"threads left behind: {left}"
        left[0].join(0.1)
    assert participants() <= participants_before, "a node that was not destroyed"


@pytest.fixture(autouse=True)
def own_ros_home(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """No test's nodes go on with what those of another one, or of the user, have saved."""
    monkeypatch.setenv("ROS_HOME", str(tmp_path_factory.getbasetemp() / f"ros_home_{next(HOMES)}"))


@pytest.fixture(scope="session")
def domain_id() -> Iterator[int]:
    """A DDS domain of this test process's own."""
    with free_domain() as domain:
        yield domain


@pytest.fixture
def ros(domain_id: int, request: pytest.FixtureRequest) -> Iterator[Ros]:
    """On the module's EXECUTOR: that of the programs takes half the time, but lets no node go."""
    ros = Ros(domain_id, getattr(request.module, "EXECUTOR", SingleThreadedExecutor))
    yield ros
    failures = ros.failures()
    ros.close()
    assert not failures


@pytest.fixture
def other_ros(domain_id: int) -> Iterator[Ros]:
    """A second context, as of another process in the same domain."""
    ros = Ros(domain_id)
    yield ros
    ros.close()


@pytest.fixture(scope="session")
def recordings() -> Path:
    """The folder of recorded runs; skips where there is none."""
    folder = Path(os.environ.get("ROVER_DATA", ROOT.parent / "shared" / "data"))
    if not (folder / "udacity").is_dir():
        pytest.skip(f"no recordings in {folder}; set ROVER_DATA to their folder")
    return folder
