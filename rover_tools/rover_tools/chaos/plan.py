"""Which faults come, when and for how long: everything by the seed, nothing by the machine."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeVar

from rover_tools.chaos.graph_shapes import GRAPH_SHAPES
from rover_tools.chaos.wire_shapes import WIRE_SHAPES
from rover_tools.runner.graph import NODES

T = TypeVar("T")

FIRST = 8.0  # [s] of the mission before the first fault: by then the rover drives
GAPS = (2.0, 6.0)  # [s] without a fault after each one


class Kind(StrEnum):
    """What is done."""

    KILL = "kill"  # SIGKILL to a node, which is started again
    STOP = "stop"  # SIGSTOP to a node, then SIGCONT
    FLOOD = "flood"  # telemetries to the bridge as fast as clients can send
    IDLE = "idle"  # connections to the bridge that say nothing
    WIRE = "wire"  # bytes to the bridge that are no good messages
    GRAPH = "graph"  # messages to the nodes that no node of ours sends


@dataclass(frozen=True)
class Shape:
    """What a kind of fault is done to, or with, and how long it may last."""

    targets: Sequence[str]
    seconds: tuple[float, float]  # [s]
    rest: float = 0.0  # [s] more without a fault afterwards


SHAPES: Mapping[Kind, Shape] = {
    Kind.KILL: Shape(tuple(NODES), (0.0, 0.0), rest=4.0),
    Kind.STOP: Shape(tuple(NODES), (0.3, 5.0)),
    Kind.FLOOD: Shape(("1 client", "4 clients"), (1.0, 3.0)),
    Kind.IDLE: Shape(("tcp", "websocket"), (1.0, 3.0)),
    Kind.WIRE: Shape(tuple(WIRE_SHAPES), (0.5, 2.0)),
    Kind.GRAPH: Shape(tuple(GRAPH_SHAPES), (0.5, 2.0)),
}


@dataclass(frozen=True)
class Fault:
    """One of the plan; it comes later than planned while the one before still has effects."""

    number: int  # from 1
    at: float  # [s] of wall time since the faults began
    kind: Kind
    target: str  # a node, or what is sent
    seconds: float  # [s] that it lasts; 0 for a moment

    @property
    def text(self) -> str:
        """For people."""
        lasting = f" for {self.seconds:.1f} s" if self.seconds else ""
        return f"{self.kind} {self.target}{lasting}"


def plan_faults(seed: int, seconds: float) -> tuple[Fault, ...]:
    """All faults that begin within so many seconds, one after the other, never two at a time.

    Each kind comes once before one comes again, and so does each target of a kind.
    """
    chance = random.Random(f"faults {seed}")
    kinds = _in_turn(tuple(Kind), chance)
    targets = {kind: _in_turn(shape.targets, chance) for kind, shape in SHAPES.items()}
    faults: list[Fault] = []
    at = FIRST
    while at < seconds:
        kind = next(kinds)
        shape = SHAPES[kind]
        lasting = round(chance.uniform(*shape.seconds), 2)
        faults.append(Fault(len(faults) + 1, round(at, 2), kind, next(targets[kind]), lasting))
        at += lasting + shape.rest + chance.uniform(*GAPS)
    return tuple(faults)


def _in_turn(values: Sequence[T], chance: random.Random) -> Iterator[T]:
    """All values in an order of chance, then all again in another one."""
    while True:
        yield from chance.sample(values, len(values))
