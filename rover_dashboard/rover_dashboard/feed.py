"""What each viewer gets: newest values that it has not seen, each encoded once for all viewers."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from rover_dashboard.encoders import Encoded, map_of, picture_of
from rover_dashboard.history import LOGS, History
from rover_dashboard.log import Cursor
from rover_dashboard.slots import Slot, Slots

# In the order in which they are sent. The first ones are heard of while somebody looks only.
VIEWS = ("camera", "vision", "map", "plan", "markers", "sources", "thermal_1", "thermal_2")
SLOTS = ("playback", "robot", "simulator", "health", "mission", "vehicle", "parameters", *VIEWS)
OF_RUN = ("map", "plan", "markers", "sources", "vision")  # nothing of another run may stay

ENCODERS: Mapping[str, Callable[[Any], Encoded | None]] = {
    "camera": picture_of,
    "vision": picture_of,
    "thermal_1": picture_of,
    "thermal_2": picture_of,
    "map": map_of,
}
Message = str | bytes


@dataclass
class Seen:
    """What a viewer has."""

    versions: dict[str, int] = field(default_factory=dict)
    cursors: dict[str, Cursor] = field(default_factory=dict)


class Feed:
    """Slots and history as messages; see the package's README for their format."""

    def __init__(self, slots: Slots, history: History) -> None:
        self._slots = slots
        self._history = history
        self._encoded: dict[str, tuple[int, Encoded | str | None]] = {}

    def news(self, seen: Seen) -> Iterator[Message]:
        """What changed since the last call with this viewer's `seen`."""
        for name in LOGS:
            news = self._history.since(name, seen.cursors.get(name, Cursor()))
            if news is not None:
                seen.cursors[name] = news.cursor
                yield _text(name, 0.0, _json({"restart": news.restart, "rows": news.rows}))
        for name in SLOTS:
            slot = self._slots.get(name)
            if slot is not None and seen.versions.get(name) != slot.version:
                seen.versions[name] = slot.version
                yield self._message(name, slot)

    def _message(self, name: str, slot: Slot) -> Message:
        age = round(self._slots.age(slot), 3)
        content = self._encode(name, slot)
        if isinstance(content, Encoded):
            header = _json({"slot": name, "age": age, **content.facts})
            return header.encode() + b"\n" + content.content
        return _text(name, age, content or "null")

    def _encode(self, name: str, slot: Slot) -> Encoded | str | None:
        version, content = self._encoded.get(name, (-1, None))
        if version != slot.version:
            encode = ENCODERS.get(name, _json)
            content = None if slot.value is None else encode(slot.value)
            self._encoded[name] = (slot.version, content)
        return content


def _text(name: str, age: float, data: str) -> str:
    """A message of text; `data` is JSON already."""
    return f'{{"slot":"{name}","age":{age},"data":{data}}}'


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"))
