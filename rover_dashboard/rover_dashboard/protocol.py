"""What a page may ask for, and the answer: checked here, before it becomes a call of a service."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Protocol

from rover_common.config import ParameterInfo
from rover_common.errors import RoverError
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Request

Value = str | float
REQUESTS = [request.value for request in Request]
PLAYBACK = ("playing", "position", "speed")  # 0 or 1; [s]; seconds a second
SETTABLE: dict[str, ParameterInfo] = {
    field.name: field.metadata["parameter"]
    for field in fields(DecisionConfig)
    if field.metadata["parameter"].settable
}


class ProtocolError(RoverError, ValueError):
    """A page asked for something that does not exist."""


@dataclass(frozen=True)
class MissionRequest:
    """To the decision node."""

    name: str


@dataclass(frozen=True)
class ParameterChange:
    """Of the decision node."""

    name: str
    value: Value


@dataclass(frozen=True)
class PlaybackChange:
    """Of a recording that is shown: whether it plays, where, how fast."""

    name: str  # one of PLAYBACK
    value: float


Wish = MissionRequest | ParameterChange | PlaybackChange


@dataclass(frozen=True)
class Ask:
    """What a page asks for."""

    id: int  # chosen by the page, repeated in the answer
    wish: Wish


@dataclass(frozen=True)
class Answer:
    """What became of it."""

    ok: bool
    text: str  # for the person


class Robot(Protocol):
    """The graph or a recording, as the server sees it; called in the server's thread."""

    async def carry_out(self, wish: Wish) -> Answer:
        """What a page asks for."""

    def watch(self, watched: bool) -> None:
        """Whether somebody looks."""


def parse(text: str) -> Ask:
    """Raises ProtocolError."""
    try:
        data = json.loads(text)
    except ValueError as error:
        raise ProtocolError("no JSON") from error
    if not isinstance(data, dict) or type(data.get("id")) is not int:
        raise ProtocolError("no object with a whole number as its id")
    request = data.get("request")
    if request is not None:
        if request not in REQUESTS:
            raise ProtocolError(f"no request {request!r}")
        return Ask(data["id"], MissionRequest(request))
    if "playback" in data:
        return Ask(data["id"], _playback_change(data["playback"], data.get("value")))
    name, value = data.get("set"), data.get("value")
    if not isinstance(name, str) or name not in SETTABLE:
        raise ProtocolError(f"no settable parameter {name!r}")
    return Ask(data["id"], ParameterChange(name, _checked(SETTABLE[name], name, value)))


def _playback_change(name: Any, value: Any) -> PlaybackChange:
    if name not in PLAYBACK:
        raise ProtocolError(f"nothing to change in a playback: {name!r}")
    return PlaybackChange(name, _number(name, value))


def _checked(info: ParameterInfo, name: str, value: Any) -> Value:
    """As the parameter's type; the decision node checks the range."""
    if info.choices:
        if value not in info.choices:
            raise ProtocolError(f"{name}: {value!r} is not one of {', '.join(info.choices)}")
        return str(value)
    return _number(name, value)


def _number(name: str, value: Any) -> float:
    if type(value) not in (int, float) or not math.isfinite(value):
        raise ProtocolError(f"{name}: {value!r} is no number")
    return float(value)


def answer_message(id_: int, answer: Answer) -> str:
    data = {"id": id_, "ok": answer.ok, "text": answer.text}
    return json.dumps({"slot": "answer", "age": 0.0, "data": data})


def settings_message() -> str:
    """What may be set, for the page's controls."""
    data: Mapping[str, Any] = {
        name: {
            "description": info.description,
            "minimum": info.minimum,
            "maximum": info.maximum,
            "choices": list(info.choices),
        }
        for name, info in SETTABLE.items()
    }
    return json.dumps({"slot": "settings", "age": 0.0, "data": data})
