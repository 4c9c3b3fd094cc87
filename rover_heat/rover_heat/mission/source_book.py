"""The sources of this run: known by number, served or not, and what speaks against them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rover_common.geometry import Pose, wrap_angle
from rover_heat.config import HeatConfig, thermal_yaw
from rover_heat.planning.types import HeatPlan, StandOff
from rover_heat.thermal.detection import AZIMUTHS, PIXEL
from rover_heat.thermal.fix import View
from rover_heat.thermal.sensing import Columns
from rover_heat.thermal.sources import SAME_SIDE, Group
from rover_heat.types import HeatSource

MOST_TRIES = 3  # poses before a source that are tried in vain, until it is left to the end
SURE_OBSERVATIONS, SURE_RANGE = 10, 1.2  # fixes, and [m] of the nearest, of a sure source
# A source that is not warm from near is none.
COLD_RANGE, COLD_OBLIQUE = 1.0, math.radians(40.0)  # [m], off its normal
COLD_FIELD = math.radians(18.0)  # off a sensor's axis
COLD_ON_WALL = 0.12  # [m] from the source to what the lidar met there
COLD_LEAST = 8  # such frames
NEAR, COLD_NEAR = 0.5, 3  # [m] from where one counts for so many
COLD_SHARE = 0.6  # of the contrast that is heat: less is cold


@dataclass
class _Entry:
    source: HeatSource
    stands: tuple[StandOff, ...] = ()
    nearest: float = math.inf  # [m] of its fixes
    tries: int = 0  # poses in vain
    rounds: int = 0  # times that it was left to the end
    cold: int = 0  # frames that should have shown it
    missing: bool = False  # in the newest plan

    def memory(self) -> dict[str, Any]:
        """For JSON."""
        poses = [(stand.pose, stand.seconds) for stand in self.stands]
        stands = [[pose.x, pose.y, pose.yaw, seconds] for pose, seconds in poses]
        return vars(self) | {"source": dict(vars(self.source)), "stands": stands}

    @classmethod
    def of(cls, memory: dict[str, Any]) -> _Entry:
        """What `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        source = memory["source"]
        covariance = tuple(map(float, source["covariance"]))
        stands = tuple(StandOff(Pose(x, y, yaw), s) for x, y, yaw, s in memory["stands"])
        source = HeatSource(**source | {"covariance": covariance})
        return cls(**memory | {"source": source, "stands": stands})


@dataclass
class SourceBook:
    config: HeatConfig
    _entries: dict[int, _Entry] = field(default_factory=dict)
    _next: int = 1

    def memory(self) -> dict[str, Any]:
        """For JSON."""
        return {"next": self._next, "entries": [e.memory() for e in self._entries.values()]}

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        entries = [_Entry.of(each) for each in memory["entries"]]
        self._entries = {entry.source.id: entry for entry in entries}
        self._next = int(memory["next"])

    def update(self, plan: HeatPlan) -> None:
        """A new plan: its groups are old sources, seen better, or new ones."""
        for entry in self._entries.values():
            entry.missing = True
        for number, group in enumerate(plan.sources):
            entry = self._entry_of(group)
            entry.source = replace(
                entry.source, x=group.x, y=group.y, covariance=group.covariance,
                normal=group.normal, observations=group.observations, peak=group.peak,
            )  # fmt: skip
            entry.missing, entry.nearest = False, group.nearest
            if plan.placed:
                entry.stands = plan.stand_offs[number]
        gone = [n for n, e in self._entries.items() if e.missing and not e.source.delivered]
        for number in gone:
            del self._entries[number]

    def note_views(self, views: Iterable[tuple[View, Columns]]) -> list[HeatSource]:
        """Frames of one tick; the sources that they refute, which are dropped."""
        refuted = []
        for view, columns in views:
            for entry in self._entries.values():
                if not entry.source.delivered:
                    entry.cold += self._coldness(view, columns, entry.source)
        for number, entry in list(self._entries.items()):
            if entry.cold >= COLD_LEAST and entry.cold > entry.source.observations:
                refuted.append(self._entries.pop(number).source)
        return refuted

    @property
    def sources(self) -> tuple[HeatSource, ...]:
        return tuple(entry.source for entry in self._entries.values())

    @property
    def delivered(self) -> int:
        return sum(entry.source.delivered for entry in self._entries.values())

    def next(self, only_sure: bool = False) -> HeatSource | None:
        """The one to serve next: the soonest reached of those tried least."""
        open_ = [
            entry
            for entry in self._entries.values()
            if not entry.source.delivered and entry.stands and entry.rounds < 2
            and (not only_sure or self._is_sure(entry))
        ]  # fmt: skip
        best = min(open_, key=lambda e: (e.rounds, e.stands[0].seconds), default=None)
        return None if best is None else best.source

    def stand_off(self, number: int) -> StandOff | None:
        """Where to stand before a source now: another pose after each that was in vain."""
        entry = self._entries.get(number)
        if entry is None or not entry.stands:
            return None
        return entry.stands[entry.tries % len(entry.stands)]

    def get(self, number: int) -> HeatSource | None:
        entry = self._entries.get(number)
        return None if entry is None else entry.source

    def failed(self, number: int) -> None:
        """A pose before a source was in vain."""
        entry = self._entries.get(number)
        if entry is not None:
            entry.tries += 1
            if entry.tries % MOST_TRIES == 0:
                entry.rounds += 1

    def mark_delivered(self, number: int) -> None:
        entry = self._entries[number]
        entry.source = replace(entry.source, delivered=True)

    def _entry_of(self, group: Group) -> _Entry:
        for entry in self._entries.values():
            source = entry.source
            near = math.dist((source.x, source.y), (group.x, group.y)) < self.config.group_distance
            turned = abs(wrap_angle(source.normal - group.normal))
            if near and turned < SAME_SIDE and entry.missing:
                return entry
        number, self._next = self._next, self._next + 1
        source = HeatSource(
            number, group.x, group.y, group.covariance, group.normal, group.observations, group.peak
        )
        self._entries[number] = entry = _Entry(source)
        return entry

    @staticmethod
    def _is_sure(entry: _Entry) -> bool:
        seen = entry.source.observations >= SURE_OBSERVATIONS
        return seen and entry.nearest <= SURE_RANGE and entry.cold * 2 < entry.source.observations

    def _coldness(self, view: View, columns: Columns, source: HeatSource) -> int:
        """What a frame says against a source that it ought to show, and does not."""
        dx, dy = source.x - view.pose.x, source.y - view.pose.y
        distance, direction = math.hypot(dx, dy), math.atan2(dy, dx)
        aside = wrap_angle(direction - view.pose.yaw - thermal_yaw(self.config, view.sensor))
        oblique = abs(wrap_angle(direction + math.pi - source.normal))
        if distance > COLD_RANGE or oblique > COLD_OBLIQUE or abs(aside) > COLD_FIELD:
            return 0
        around = np.abs(AZIMUTHS - aside) <= 1.5 * PIXEL
        if columns[around].max() >= COLD_SHARE * self.config.temp_contrast:
            return 0
        to_hits = np.hypot(*(view.hits - (source.x, source.y)).T)
        if not (to_hits < COLD_ON_WALL).any():
            return 0
        return COLD_NEAR if distance < NEAR else 1
