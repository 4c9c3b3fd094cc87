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
SETTABLE: dict[str, ParameterInfo] = {
    field.name: field.metadata["parameter"]
    for field in fields(DecisionConfig)
    if field.metadata["parameter"].settable
}


class ProtocolError(RoverError, ValueError):
    """A page asked for something that does not exist."""


@dataclass(frozen=True)
class Ask:
    """A request to the mission, or one parameter's new value."""

    id: int  # chosen by the page, repeated in the answer
    request: str = ""
    name: str = ""
    value: Value = ""


@dataclass(frozen=True)
class Answer:
    """What became of it."""

    ok: bool
    text: str  # for the person


class Robot(Protocol):
    """What the server asks of the graph; every method may be called from the server's thread."""

    async def request(self, name: str) -> Answer: ...

    async def set_parameter(self, name: str, value: Value) -> Answer: ...

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
        return Ask(data["id"], request=request)
    name, value = data.get("set"), data.get("value")
    if not isinstance(name, str) or name not in SETTABLE:
        raise ProtocolError(f"no settable parameter {name!r}")
    return Ask(data["id"], name=name, value=_checked(SETTABLE[name], name, value))


def _checked(info: ParameterInfo, name: str, value: Any) -> Value:
    """As the parameter's type; the decision node checks the range."""
    if info.choices:
        if value not in info.choices:
            raise ProtocolError(f"{name}: {value!r} is not one of {', '.join(info.choices)}")
        return str(value)
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
            "choices": info.choices,
        }
        for name, info in SETTABLE.items()
    }
    return json.dumps({"slot": "settings", "age": 0.0, "data": data})
