"""A growing list of rows of which each reader gets what is new to it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

Row = Sequence[Any]


@dataclass(frozen=True)
class Cursor:
    """How far a reader has come."""

    generation: int = -1
    count: int = 0


@dataclass(frozen=True)
class News:
    """Rows that a reader does not have yet."""

    restart: bool  # whether they replace what it has
    rows: list[Row]
    cursor: Cursor  # after them


class Log:
    """At most `limit` rows: when there are more, `thin` says which of them stay."""

    def __init__(self, limit: int, thin: Callable[[list[Row]], list[Row]]) -> None:
        self._limit = limit
        self._thin = thin
        self._rows: list[Row] = []
        self._generation = 0  # grows when rows that were handed out change

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def last(self) -> Row | None:
        return self._rows[-1] if self._rows else None

    def append(self, row: Row) -> bool:
        """Whether the log was thinned."""
        self._rows.append(row)
        if len(self._rows) <= self._limit:
            return False
        self._rows = self._thin(self._rows)
        self._generation += 1
        return True

    def clear(self) -> None:
        self._rows = []
        self._generation += 1

    def since(self, cursor: Cursor) -> News | None:
        """What is new after a cursor, None when nothing is."""
        restart = cursor.generation != self._generation
        rows = self._rows if restart else self._rows[cursor.count :]
        if not rows and not restart:
            return None
        return News(restart, list(rows), Cursor(self._generation, len(self._rows)))


def every_second(rows: list[Row]) -> list[Row]:
    """Half of the rows, the newest among them."""
    return rows[::-2][::-1]


def newer_half(rows: list[Row]) -> list[Row]:
    return rows[len(rows) // 2 :]
