"""Parts that a parameter chooses by name: the project's own, and those of installed packages.

Both are entry points, `module:object`, and are imported when they are asked for. The project's own
are listed in code; another package lists its own in its metadata, under the group of the registry.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from importlib.metadata import EntryPoint, entry_points
from typing import TypeVar

from rover_common.errors import RoverError

T = TypeVar("T")


class PartError(RoverError, LookupError):
    """A part that is not there, cannot be imported, or is something else."""


class Registry(Collection[str]):
    """The names of one kind of part. An own name takes precedence over an installed one."""

    def __init__(self, kind: str, group: str, own: Mapping[str, str]) -> None:
        """kind: in words, for errors; group: of entry points; own: objects by name."""
        self.kind, self.group = kind, group
        self._own = {name: EntryPoint(name, value, group) for name, value in own.items()}

    @property
    def own(self) -> tuple[str, ...]:
        """The names of the project's own parts."""
        return tuple(self._own)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (name in self._own or name in self._installed())

    def __iter__(self) -> Iterator[str]:
        """The project's own first, then those of other packages in their order."""
        yield from self._own
        yield from sorted(self._installed().keys() - self._own)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def load(self, name: str, expected: type[T]) -> T:
        """The part of this name; raises PartError, which says in one line what is wrong."""
        entry = self._own.get(name) or self._installed().get(name)
        if entry is None:
            raise PartError(f"no {self.kind} '{name}'; there are {', '.join(self)}")
        try:
            part = entry.load()
        except Exception as error:  # anything may go wrong in a module that somebody writes
            cause = f"{type(error).__name__}: {' '.join(str(error).split())}"
            raise PartError(f"{self.kind} '{name}', {entry.value}: {cause}") from error
        if not isinstance(part, expected):
            raise PartError(
                f"{self.kind} '{name}', {entry.value}: is no {expected.__name__}, but a "
                f"{type(part).__name__}"
            )
        return part

    def _installed(self) -> dict[str, EntryPoint]:
        return {entry.name: entry for entry in entry_points(group=self.group)}
