"""The runs of a bridge, which go on where a bridge that was killed left off."""

from __future__ import annotations

from rclpy.node import Node

from rover_bridge.run_tracker import RunTracker
from rover_common.ros.state import NodeState
from rover_common.saved_state import SavedState
from rover_common.state_keeper import MakeState
from rover_common.types import Run, Telemetry

VERSION = 1  # of what is saved


class KeptRuns:
    """A run tracker whose state is saved while it tracks."""

    def __init__(self, node: Node, state_dir: str) -> None:
        self._tracker = RunTracker()
        self._state = NodeState(node, state_dir, "bridge", VERSION)
        self._state.take(lambda saved: self._tracker.resume(saved.run, saved.stamp, saved.values))

    @property
    def reason(self) -> str:
        """Why the present run began."""
        return self._tracker.reason

    @property
    def contradiction(self) -> str:
        """Why the newest telemetry is left out."""
        return self._tracker.contradiction

    def request(self, number: int) -> None:
        """As RunTracker.request."""
        self._tracker.request(number)

    def track(self, telemetry: Telemetry, time: float) -> tuple[Run, int] | None:
        """As RunTracker.track."""
        tracked = self._tracker.track(telemetry, time)
        if tracked is not None:
            run, stamp = tracked
            self._state.keep(self._snapshot, at_once=run.start == stamp)
        return tracked

    def close(self) -> None:
        """Save the last state, and end the thread that does."""
        self._state.close(None if self._tracker.memory() is None else self._snapshot)

    def _snapshot(self) -> MakeState:
        memory = self._tracker.memory()
        assert memory is not None
        state = SavedState(*memory)
        return lambda: state
