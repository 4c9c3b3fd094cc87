"""A recording on the page: what the graph said up to a position, played on or sought in.

What is small is held in memory from the beginning, so that track, plots and states of any position
are made anew in a moment. Images and maps are read from the recording as they are shown.
"""

from __future__ import annotations

import asyncio
import time
from bisect import bisect_right
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

from rover_common import topics
from rover_common.errors import RoverError
from rover_dashboard.conversions import COMPRESSED_VISION, TYPES, decoded, usable_parts
from rover_dashboard.feed import SLOTS
from rover_dashboard.history import History
from rover_dashboard.node_intake import Intake
from rover_dashboard.protocol import Answer, PlaybackChange, Wish
from rover_dashboard.slots import Slots

PERIOD = 0.05  # [s] between two steps of a recording that plays
SPEEDS = (0.5, 1.0, 2.0, 5.0, 10.0, 30.0)  # to choose from
FAR = 5.0  # [s] a leap so long passes over the images in between
AT_ONCE = 500  # messages between two moments in which viewers are served
MAPS = (topics.WORLDMAP, topics.MAP)
LARGE = (
    *MAPS,
    topics.COMPRESSED_IMAGE,
    topics.VISION_IMAGE,
    COMPRESSED_VISION,
    topics.PLAN,
    topics.MISSION_MARKERS,
    topics.HEAT_MARKERS,
    topics.TEMPERATURE_1,
    topics.TEMPERATURE_2,
)


class PlaybackError(RoverError, ValueError):
    """Nothing of a rover is in a recording."""


class Record(Protocol):
    """A recorded message."""

    @property
    def topic(self) -> str: ...

    @property
    def log_time(self) -> int:
        """[ns] of the wall clock, when it was received."""

    @property
    def publish_time(self) -> int:
        """[ns] its stamp."""

    @property
    def data(self) -> bytes:
        """CDR."""


class Source(Protocol):
    """A recording."""

    def records(
        self, topics: Collection[str] | None = None, start: int | None = None
    ) -> Iterator[Record]:
        """In the order of their log times [ns]; of all topics or of some, from a time on."""


@dataclass(frozen=True)
class _Small:
    """A message that is held in memory."""

    log_time: int  # [ns]
    topic: str  # relative to the namespace
    message: Any  # of a map, its stamp [ns]: its age is plotted, also where it is not shown


class Playback:
    """The recording as the server sees it; positions are [s] of frame time from the first frame."""

    def __init__(self, source: Source, names: Collection[str]) -> None:
        """names: of the recorded topics. Raises PlaybackError."""
        self._source = source
        self._prefix = _prefix(names)
        self._small: list[_Small] = []
        self._large_times: dict[str, list[int]] = {name: [] for name in LARGE}  # log times [ns]
        self._stamps: list[int] = []  # [ns] of the frames
        self._frame_times: list[int] = []  # [ns] log times of the frames
        self._last = 0  # [ns] log time
        self._read()
        self.position = 0.0
        self.speed = 1.0
        self.playing = False
        self._wanted = 0.0  # position to go to
        self._log_time = 0  # [ns] up to which messages have been taken
        self._taken = 0  # of the small messages
        self._large: Iterator[Record] = iter(())
        self._next_large: Record | None = None
        self.slots = Slots(lambda: self.position)
        self.history = History(lambda: self._log_time * 1e-9)
        self._intake = Intake(self.slots, self.history)
        self._tell()

    @property
    def end(self) -> float:
        """The last position."""
        return (self._stamps[-1] - self._stamps[0]) / 1e9

    async def carry_out(self, wish: Wish) -> Answer:
        if not isinstance(wish, PlaybackChange):
            return Answer(False, "this is a recording: nothing here can be driven")
        if wish.name == "position":
            self._wanted = min(max(wish.value, 0.0), self.end)
        elif wish.name == "speed":
            self.speed = min(max(wish.value, SPEEDS[0]), SPEEDS[-1])
        else:
            self.playing = bool(wish.value)
            if self.playing and self._wanted >= self.end:
                self._wanted = 0.0  # once more
        self._tell()
        return Answer(True, "")

    def watch(self, watched: bool) -> None:
        """It plays on for the next viewer."""

    async def run(self) -> None:
        """Play until cancelled."""
        await self._go_to(0.0, anew=True)
        last = time.monotonic()
        while True:
            await asyncio.sleep(PERIOD)
            now = time.monotonic()
            if self.playing:
                self._wanted = min(self._wanted + self.speed * (now - last), self.end)
                self.playing = self._wanted < self.end
            last = now
            if self._wanted != self.position:
                await self._go_to(self._wanted, anew=self._wanted < self.position)
                self._tell()

    def _tell(self) -> None:
        self.slots.put(
            "playback",
            {
                "end": round(self.end, 2),
                "position": round(self.position, 2),
                "playing": self.playing,
                "speed": self.speed,
                "speeds": SPEEDS,
            },
        )

    def _read(self) -> None:
        """One pass over the whole recording."""
        known = {self._name_of(topic): topic for topic in TYPES}
        for record in self._source.records(list(known)):
            topic = known[record.topic]
            self._last = record.log_time
            if topic in LARGE:
                self._large_times[topic].append(record.log_time)
                if topic in MAPS:
                    self._small.append(_Small(record.log_time, topic, record.publish_time))
                continue
            for part in usable_parts(decoded(topic, record.data)):
                self._small.append(_Small(record.log_time, topic, part))
            if topic == topics.ODOMETRY:
                self._stamps.append(record.publish_time)
                self._frame_times.append(record.log_time)
        if not self._stamps:
            raise PlaybackError("the recording holds no frame of a rover")

    def _name_of(self, topic: str) -> str:
        """In the recording; a topic that begins with a slash is in no namespace."""
        return topic if topic.startswith("/") else self._prefix + topic

    async def _go_to(self, position: float, anew: bool) -> None:
        """Take the messages up to a position; `anew`: from the first one on."""
        before, self.position = self.position, position
        until = self._log_time_at(position)
        if anew:
            self._restart()
        if anew or position > before + FAR:
            self._open_large(until)
        while self._taken < len(self._small) and self._small[self._taken].log_time <= until:
            small = self._small[self._taken]
            self._log_time = small.log_time
            if small.topic in MAPS:
                self.history.add_map(small.message)
            else:
                self._intake.take(small.topic, small.message)
            self._taken += 1
            if self._taken % AT_ONCE == 0:
                await asyncio.sleep(0)
        self._take_large(until)
        self._log_time = until

    def _restart(self) -> None:
        self._taken = 0
        self.history.restart()
        self.slots.empty(set(SLOTS) - {"playback", "robot"})
        self._intake = Intake(self.slots, self.history)

    def _log_time_at(self, position: float) -> int:
        """[ns] of all that had come when the frame of a position had."""
        frame = bisect_right(self._stamps, self._stamps[0] + round(position * 1e9)) - 1
        if frame >= len(self._stamps) - 1:
            return self._last
        return self._frame_times[frame]

    def _open_large(self, until: int) -> None:
        """Read images and maps from where the newest of each before a log time [ns] is found."""
        starts = [
            times[bisect_right(times, until) - 1]
            for times in self._large_times.values()
            if times and times[0] <= until
        ]
        names = [self._prefix + topic for topic in LARGE]
        self._large = self._source.records(names, start=min(starts, default=until))
        self._next_large = next(self._large, None)

    def _take_large(self, until: int) -> None:
        """The newest of each topic up to a log time [ns]."""
        newest: dict[str, bytes] = {}
        while self._next_large is not None and self._next_large.log_time <= until:
            newest[self._next_large.topic.removeprefix(self._prefix)] = self._next_large.data
            self._next_large = next(self._large, None)
        for topic, data in newest.items():
            for part in usable_parts(decoded(topic, data)):
                self._intake.take(topic, part)


def _prefix(names: Collection[str]) -> str:
    """What stands before the names of a rover's topics: its namespace, with slashes."""
    ending = f"/{topics.ODOMETRY}"
    found = sorted((name for name in names if name.endswith(ending)), key=len)
    if not found:
        raise PlaybackError(f"the recording has no topic {topics.ODOMETRY}")
    return found[0].removesuffix(topics.ODOMETRY)
