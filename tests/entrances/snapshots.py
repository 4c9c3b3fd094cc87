"""The state of a node as a value, to be compared with itself."""

from __future__ import annotations

from typing import Any

import numpy as np

OURS = ("rover_", "burger_simulator")
# What a refused message may change: what is counted and said, and what other threads do.
ASIDE = (
    "rover_common.ros.diagnostics", "rover_common.ros.endpoint_watch", "rover_bridge.server",
    "rover_common.ros.checked_node", "rover_bridge.inbox", "rover_common.input_monitor",
)  # fmt: skip
NAMES_ASIDE = ("counts", "_last_lines", "_warned", "_orders")


def snapshot(value: Any, *aside: Any) -> Any:
    """Equal where nothing of this project, no array, number or text in it has changed.

    aside: what is left out, wherever it is held.
    """
    return _walk(value, {id(each): each for each in aside})


def _walk(value: Any, seen: dict[int, Any]) -> Any:
    """seen: everything that was walked through so far, by its identity."""
    if isinstance(value, bool | int | float | str | bytes | None):
        return repr(value)
    if isinstance(value, np.ndarray):
        return value.shape, str(value.dtype), hash(value.tobytes())
    if id(value) in seen:
        return "again"
    seen[id(value)] = value
    if isinstance(value, dict):
        return [(repr(key), _walk(each, seen)) for key, each in list(value.items())]
    if isinstance(value, list | tuple | set | frozenset) or type(value).__name__ == "deque":
        return [_walk(each, seen) for each in list(value)]
    module = type(value).__module__
    if ".msg" in module or not module.startswith(OURS) or module.startswith(ASIDE):
        return type(value).__name__, id(value)
    slots = [name for kind in type(value).__mro__ for name in getattr(kind, "__slots__", ())]
    members = {name: getattr(value, name, None) for name in slots} | getattr(value, "__dict__", {})
    return [
        (name, _walk(each, seen))
        for name, each in sorted(members.items())
        if name not in NAMES_ASIDE and not name.startswith("_Node__")
    ]
