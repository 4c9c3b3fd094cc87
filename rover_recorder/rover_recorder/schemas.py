"""Definitions of message types as a recording carries them, so that it explains itself.

The format is that of rosbag2 (`ros2msg`): the type's .msg file, followed by those of all types that
it contains, each below a line of `=` and a line with its name.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from rover_recorder.errors import RecordingError

SEPARATOR = "=" * 80
FIELD = re.compile(r"^(?P<type>\w+(?:/\w+)?)(?:<=\d+)?(?:\[[^\]]*\])?\s+\w")
PRIMITIVES = {
    "bool", "byte", "char", "float32", "float64", "int8", "uint8", "int16", "uint16", "int32",
    "uint32", "int64", "uint64", "string", "wstring",
}  # fmt: skip
STAMPED = ("std_msgs/Header", "builtin_interfaces/Time")  # types that begin with a time


def installed_text(name: str) -> str:
    """The .msg file of a type like `std_msgs/Header`; raises RecordingError."""
    package, kind = name.split("/")
    try:
        path = Path(get_package_share_directory(package)) / "msg" / f"{kind}.msg"
        return path.read_text()
    except (PackageNotFoundError, OSError):
        raise RecordingError(f"the type {name} is not installed") from None


def definition(kind: str, text_of: Callable[[str], str] = installed_text) -> str:
    """Of a type like `std_msgs/msg/Header`; raises RecordingError for one that is not installed."""
    package, _, name = kind.split("/")
    root = f"{package}/{name}"
    texts = {root: text_of(root)}
    waiting = [root]
    while waiting:
        outer = waiting.pop(0)
        for inner in _contained(texts[outer], outer.split("/")[0]):
            if inner not in texts:
                texts[inner] = text_of(inner)
                waiting.append(inner)
    first, *others = texts.items()
    return first[1] + "".join(f"\n{SEPARATOR}\nMSG: {name}\n{text}" for name, text in others)


def begins_with_stamp(text: str) -> bool:
    """Whether the first field of a definition is a header or a time."""
    for code in map(_code_of, text.splitlines()):
        field = FIELD.match(code)
        if field and "=" not in code:
            return field["type"] in STAMPED
        if code == SEPARATOR:
            break
    return False


def same_fields(one: str, other: str) -> bool:
    """Whether two definitions differ in comments and blank lines alone."""
    return _codes_of(one) == _codes_of(other)


def _contained(text: str, package: str) -> Iterator[str]:
    """Names of the message types of a .msg file's fields."""
    for code in map(_code_of, text.splitlines()):
        field = FIELD.match(code)
        if field and field["type"] not in PRIMITIVES:
            yield field["type"] if "/" in field["type"] else f"{package}/{field['type']}"


def _code_of(line: str) -> str:
    return line.partition("#")[0].strip()


def _codes_of(text: str) -> list[str]:
    return [" ".join(code.split()) for code in map(_code_of, text.splitlines()) if code]
