"""What a mission knew and no longer knows: each such loss by its name."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

# A map takes evidence back now and then: without faults 17 cells, or 5 in 100 of one that has just
# begun. A node that forgot its map begins with one view.
CELLS_TAKEN_BACK = 30
SHARE_TAKEN_BACK = 0.05
# [m] between two estimates of a rock: the first are from afar, and two tracks may become one.
ROCK_MOVES = 3.0
TRACK_MOVES = 6.0  # [m] the same, where the track has the same number
# Perception itself unconfirms a rock whose new lines of sight contradict the old ones, and confirms
# it again with more; who forgets rocks forgets all.
UNCONFIRMED = 1  # rocks at a time
HOME_MOVES = 1.0  # [m] of the distance to home beside the true one


@dataclass(frozen=True)
class Loss:
    """Something that was known before a fault, and not after it."""

    name: str  # run, mission, samples, home, map, rocks or recovery
    text: str


class Rock(NamedTuple):
    """A confirmed track."""

    id: int
    x: float  # [m]
    y: float  # [m]


@dataclass(frozen=True)
class Knowledge:
    """What the graph says at one moment."""

    run: int
    elapsed: float  # [s] of the mission
    samples_total: int
    samples_collected: int
    home_error: float = 0.0  # [m] of its distance to home, against the pose of the same frame
    cells: int = 0  # of the world map that are known
    rocks: tuple[Rock, ...] = ()


class Ledger:
    """Keeps the most that was ever known, and tells each loss once."""

    def __init__(self) -> None:
        self._best: Knowledge | None = None

    def losses(self, now: Knowledge) -> list[Loss]:
        """What is lost since the last call."""
        best = self._best or now
        found = losses_between(best, now)
        # A map that shrinks slowly shrinks as well; what is lost is not lost again.
        cells = (
            now.cells if any(loss.name == "map" for loss in found) else max(best.cells, now.cells)
        )
        self._best = replace(now, cells=cells)
        return found


def losses_between(before: Knowledge, after: Knowledge) -> list[Loss]:
    """Every loss, in the order of what matters most."""
    pairs = (
        ("run", _run(before, after)),
        ("mission", _mission(before, after)),
        ("samples", _samples(before, after)),
        ("home", _home(before, after)),
        ("map", _map(before, after)),
        ("rocks", _rocks(before, after)),
    )
    return [Loss(name, text) for name, text in pairs if text]


def _run(before: Knowledge, after: Knowledge) -> str:
    return "" if after.run == before.run else f"run {before.run} became run {after.run}"


def _mission(before: Knowledge, after: Knowledge) -> str:
    if after.elapsed >= before.elapsed:
        return ""
    return f"the mission was {before.elapsed:.1f} s old and is {after.elapsed:.1f} s old"


def _samples(before: Knowledge, after: Knowledge) -> str:
    kept = after.samples_collected >= before.samples_collected
    if kept and after.samples_total == before.samples_total:
        return ""
    then, now = (f"{k.samples_collected} of {k.samples_total}" for k in (before, after))
    return f"{then} samples became {now}"


def _home(before: Knowledge, after: Knowledge) -> str:
    if after.home_error <= HOME_MOVES or before.home_error > HOME_MOVES:
        return ""
    return f"the distance to home is wrong by {after.home_error:.1f} m"


def _map(before: Knowledge, after: Knowledge) -> str:
    gone = before.cells - after.cells
    if gone <= max(CELLS_TAKEN_BACK, SHARE_TAKEN_BACK * before.cells):
        return ""
    return f"{before.cells} known cells became {after.cells}"


def _rocks(before: Knowledge, after: Knowledge) -> str:
    gone = [rock for rock in before.rocks if not any(_same(rock, now) for now in after.rocks)]
    if len(gone) <= UNCONFIRMED:
        return ""
    where = ", ".join(f"({rock.x:.1f}, {rock.y:.1f})" for rock in gone)
    return f"no rock is known any more at {where}"


def _same(rock: Rock, now: Rock) -> bool:
    moved = math.hypot(now.x - rock.x, now.y - rock.y)
    return moved <= (TRACK_MOVES if now.id == rock.id else ROCK_MOVES)
