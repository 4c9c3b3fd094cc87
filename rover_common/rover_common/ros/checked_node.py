"""A node that no message and no timer ends, and that believes no message unchecked."""

from __future__ import annotations

import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import wraps
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription
from rclpy.timer import Timer

from rover_common.ros.message_checks import CHECKS, parts_of
from rover_common.ros.message_errors import FrameError, MessageError, StampError

SAID_AGAIN = 30.0  # [s] of wall time between two lines about the same topic and cause
AHEAD = 10_000_000_000  # [ns] that a stamp may be ahead of the node's clock


def left_alone(message: Any) -> None:
    """What is done about a refused message, besides counting it, unless a node says otherwise."""


class CheckedNode(Node):
    """Every subscription of it, also one that rclpy makes itself, has an `Entrance`.

    `counts` holds `refused_<topic>_<cause>` of messages that cannot be used, and `failed_<topic>`
    of those that the node failed to handle, which is a defect of the node, as `failed_<timer>` is:
    the name of the timer's callback, without the underscore. `on_refused` is called with the topic
    of a message that is refused, and why.
    """

    def __init__(self, name: str, **kwargs: Any) -> None:
        self.counts: Counter[str] = Counter()  # before rclpy subscribes /clock
        self.on_refused: Callable[[str, str], None] = lambda topic, why: None
        self._expected_frames: dict[str, str] = {}
        self._last_lines: dict[str, float] = {}  # [s] of wall time of the last line
        super().__init__(name, **kwargs)

    def expect_frames(self, frame_ids: Mapping[str, str]) -> None:
        """Refuse messages of these topics whose header names another frame."""
        self._expected_frames |= frame_ids

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[[Any], Any],
        qos_profile: QoSProfile | int,
        *,
        refused: Callable[[Any], object] = left_alone,
        raw: bool = False,
        **options: Any,
    ) -> Subscription:
        """As rclpy's. Raises KeyError for a type without a check; raw messages have none.

        refused: called with a message that was refused, as where a command has to be answered.
        """
        check = None if raw else CHECKS[msg_type]
        entrance = Entrance(self, topic, callback, check, refused)
        return super().create_subscription(
            msg_type, topic, entrance, qos_profile, raw=raw, **options
        )

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[..., Any],
        *arguments: Any,
        **options: Any,
    ) -> Timer:
        """As rclpy's."""
        name = getattr(callback, "__name__", type(callback).__name__).strip("_")

        @wraps(callback)
        def guarded(*given: Any, **keywords: Any) -> None:
            with self.guard(name):
                callback(*given, **keywords)

        return super().create_timer(timer_period_sec, guarded, *arguments, **options)

    def check_against_node(self, topic: str, message: Any) -> None:
        """What depends on the node: its clock, and the frame that it expects."""
        header = getattr(message, "header", None)
        if header is None or isinstance(message, DiagnosticArray):  # others have other clocks
            return
        now = self.get_clock().now().nanoseconds
        ahead = header.stamp.sec * 1_000_000_000 + header.stamp.nanosec - now
        if now > 0 and ahead > AHEAD:  # simulated time is 0 until it begins
            raise StampError(f"a stamp {ahead / 1e9:.1f} s ahead of the clock")
        wanted = self._expected_frames.get(topic)
        if wanted is not None and header.frame_id != wanted:
            raise FrameError(f"in frame '{header.frame_id}', not in '{wanted}'")

    def refuse(self, topic: str, error: MessageError) -> None:
        """Count a message, and say so."""
        key = f"refused_{topic.lstrip('/')}_{error.cause}"
        self.counts[key] += 1
        self.on_refused(topic, str(error))
        if self._may_say(key):
            text = f"{topic}: refused: {error} ({self.counts[key]} so far)"
            self.get_logger().warning(text)

    @contextmanager
    def guard(self, name: str) -> Iterator[None]:
        """An exception within, of a topic or a timer, ends here: counted, and told once."""
        try:
            yield
        except Exception:
            if not self.context.ok():  # the race with the shutdown
                raise
            self._fail(name)

    def _fail(self, topic: str) -> None:
        key = f"failed_{topic.lstrip('/')}"
        self.counts[key] += 1
        if self._may_say(key):
            self.get_logger().error(f"{topic}: failed: {traceback.format_exc()}")

    def _may_say(self, key: str) -> bool:
        now = time.monotonic()
        last = self._last_lines.get(key)
        if last is not None and now - last < SAID_AGAIN:
            return False
        self._last_lines[key] = now
        return True


class Entrance:
    """What comes in on a topic: checked, then handed on; never an exception to the executor."""

    def __init__(
        self,
        node: CheckedNode,
        topic: str,
        callback: Callable[[Any], Any],
        check: Callable[[Any], None] | None,
        refused: Callable[[Any], object] = left_alone,
    ) -> None:
        """check: raises a MessageError; None for raw messages, which are bytes."""
        self._node = node
        self._topic = topic
        self._callback = callback
        self._check = check
        self._refused = refused

    def __call__(self, message: Any) -> None:
        for part in parts_of(message):
            with self._node.guard(self._topic):
                take = self._callback if self._passes(part) else self._refused
                take(part)

    def _passes(self, message: Any) -> bool:
        if self._check is None:
            return True
        try:
            self._check(message)
            self._node.check_against_node(self._topic, message)
        except MessageError as error:
            self._node.refuse(self._topic, error)
            return False
        return True
