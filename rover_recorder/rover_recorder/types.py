"""What a recording consists of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Topic:
    """A recorded topic."""

    name: str  # absolute
    type: str  # as in std_msgs/msg/String
    definition: str  # of the type and of all that it contains, as schemas.definition has it
    qos: tuple[dict[str, Any], ...] = ()  # what each publisher offers, in rosbag2's words
    type_hash: str = ""  # RIHS01_...


@dataclass(frozen=True)
class Record:
    """A recorded message."""

    topic: str
    log_time: int  # [ns] of the wall clock, when it was received
    publish_time: int  # [ns] its own stamp where it begins with one, else log_time
    data: bytes  # CDR, as it was on the wire
