"""A node's saved state: found at its start, offered to its first frame, and kept from then on."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from rclpy.node import Node

from rover_common.errors import RoverError
from rover_common.saved_state import SavedState, StateFile
from rover_common.state_keeper import MakeState, StateKeeper
from rover_common.types import Run

AUTO = "auto"  # the value of state_dir for a folder of ROS's own


class NodeState:
    """Does nothing where the node keeps no state."""

    def __init__(self, node: Node, state_dir: str, kind: str, version: int) -> None:
        """state_dir: a folder, AUTO, or empty for none; kind and version: of the content."""
        self._logger = node.get_logger()
        self._found: list[SavedState] = []
        self._keeper: StateKeeper | None = None
        if not state_dir:
            return
        folder = default_folder(node) if state_dir == AUTO else Path(state_dir).expanduser()
        name = node.get_fully_qualified_name().strip("/").replace("/", ".")
        file = StateFile(folder / f"{name}.state", kind, version)
        self._found, refusals = file.read()
        for refusal in refusals:
            self._logger.warning(refusal)
        self._keeper = StateKeeper(file, self._logger.warning)

    def resume(self, run: Run, stamp: int, adopt: Callable[[SavedState], None]) -> None:
        """Offer what was found to the node's first frame, if it is of its run and not later.

        A second call does nothing. Of `adopt`, see `take`.
        """
        if not self._found:
            return
        usable = [state for state in self._found if state.continues_with(run, stamp)]
        if not usable:
            self._logger.info(f"the saved state is of another run than {run.number}: not used")
        self._found = usable
        state = self.take(adopt)
        if state is not None:
            age = (stamp - state.stamp) * 1e-9
            self._logger.info(f"goes on with run {run.number}, as it was saved {age:.1f} s before")

    def take(self, adopt: Callable[[SavedState], None]) -> SavedState | None:
        """Offer what was found, whatever run it is of; what was adopted.

        What cannot be adopted raises a RoverError, ValueError, TypeError or KeyError and must have
        changed nothing; then the older copy is tried.
        """
        found, self._found = self._found, []
        for state in found:
            try:
                adopt(state)
            except (RoverError, ValueError, TypeError, KeyError) as error:
                self._logger.warning(f"a saved state is not used: {error!r:.200}")
                continue
            return state
        return None

    def keep(self, snapshot: Callable[[], MakeState], at_once: bool = False) -> None:
        """As StateKeeper.keep."""
        if self._keeper is not None:
            self._keeper.keep(snapshot, at_once)

    def keep_first(self, snapshot: Callable[[], MakeState]) -> None:
        """As StateKeeper.keep_first."""
        if self._keeper is not None:
            self._keeper.keep_first(snapshot)

    def close(self, snapshot: Callable[[], MakeState] | None = None) -> None:
        """Keep the last one, unless there is none, and end the thread."""
        if self._keeper is not None:
            self._keeper.close(snapshot)


def default_folder(node: Node) -> Path:
    """Below ROS_HOME, of the node's domain alone."""
    home = os.environ.get("ROS_HOME") or "~/.ros"
    domain = node.context.get_domain_id()
    return Path(home).expanduser() / "rover_state" / f"domain_{domain}"
