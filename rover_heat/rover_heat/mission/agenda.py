"""What comes next: explore, deliver, climb, come back, or end; by what is known and the time."""

from __future__ import annotations

from dataclasses import dataclass

from rover_heat.config import HeatConfig
from rover_heat.mission.chart import Event
from rover_heat.mission.ramp_book import RampBook
from rover_heat.mission.source_book import SourceBook
from rover_heat.types import HeatSource

DELIVER_AT, RAMP_AT = 0.60, 0.85  # of the time limit


@dataclass
class Agenda:
    config: HeatConfig
    sources: SourceBook
    ramps: RampBook
    payloads: int  # sequences left on board
    explored: bool = False  # nothing is left to see
    ramp_given_up: bool = False
    back: bool = False  # at the start again, or given up
    share: float = 0.0  # of the time limit that has passed

    def update(self, share: float) -> None:
        """One tick: the share of the time limit that has passed."""
        self.share = share

    @property
    def time_is_up(self) -> bool:
        return self.share >= 1.0

    @property
    def may_explore(self) -> bool:
        """Whether there is more to see, and time for it."""
        enough = len(self.sources.sources) >= self.config.min_sources
        late = self.share >= DELIVER_AT and enough
        return not self.explored and not late and self.share < RAMP_AT

    def next_source(self) -> HeatSource | None:
        """The source to serve now, if there is one that may be served."""
        kept = 0 if self.ramps.done or self.ramp_given_up else 1
        if self.payloads <= kept or self.share >= RAMP_AT:
            return None
        if self.may_explore:
            at_once = self.config.deliver == "at_once"
            return self.sources.next(only_sure=True) if at_once else None
        return self.sources.next()

    def next_event(self) -> Event:
        """What leads to the state that comes next, from one that has done its work."""
        if self.time_is_up:
            return Event.finish
        if self.next_source() is not None:
            return Event.deliver
        if self.may_explore:
            return Event.explore
        if not (self.ramps.done or self.ramp_given_up):
            return Event.climb
        if self.config.return_to_start and not self.back:
            return Event.go_back
        return Event.finish
