"""Whether a node's inputs are alive, as frequent as they should be, and valid.

Nothing is expected before the first message of an input's source. Times are [s] of any clock that
does not fall back.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, field

from rover_common.config import parameter
from rover_common.health import Finding, Level

WINDOW = 2.0  # [s] in which messages and drops are counted


@dataclass(frozen=True)
class InputLimits:
    """Parameters of a node that has inputs."""

    input_warn_age: float = parameter(
        0.4,
        "[s] of wall time without an input, after which it is a warning",
        minimum=0.05,
        maximum=3600.0,
    )
    input_error_age: float = parameter(
        0.7,
        "[s] of wall time without an input, after which it is an error",
        minimum=0.05,
        maximum=3600.0,
    )
    input_min_rate: float = parameter(
        5.0, "[1/s] messages of an input; fewer are a warning", minimum=0.0, maximum=1000.0
    )


@dataclass(frozen=True)
class Input:
    """One topic, or what the node joins of several."""

    name: str
    source: str = ""  # the node that sends it; empty for what is joined
    present: Callable[[], bool] = lambda: True  # whether somebody publishes it
    pause: float = 0.0  # [s] of silence that is usual; such an input has no least rate


@dataclass(frozen=True)
class InputReport:
    """One input at one time."""

    finding: Finding
    age: float | None  # [s] since the last usable message; None before the first
    rate: float  # [1/s] of usable messages
    received: int
    dropped: int


@dataclass
class _Record:
    waiting: float | None = None  # [s] since when the next message is expected
    first: float | None = None  # [s] the first usable message
    last: float | None = None  # [s] the newest one
    flowing: float = 0.0  # [s] since when messages have come without a long pause
    times: deque[float] = field(default_factory=deque)
    drops: deque[float] = field(default_factory=deque)
    why: str = ""  # of the newest drop
    received: int = 0
    dropped: int = 0


class InputMonitor:
    """Counts what comes, and judges it; `inputs` in the order of the data's flow."""

    def __init__(self, inputs: Iterable[Input], limits: InputLimits) -> None:
        self._inputs = tuple(inputs)
        self._limits = limits
        self._records = {each.name: _Record() for each in self._inputs}
        self._pauses = {each.name: each.pause for each in self._inputs}

    @property
    def names(self) -> Collection[str]:
        return self._records.keys()

    def note(self, name: str, now: float) -> None:
        """A usable message came."""
        record = self._records[name]
        if record.last is None or now - record.last > WINDOW:
            record.flowing = now
        record.first = now if record.first is None else record.first
        record.last = record.waiting = now
        record.received += 1
        record.times.append(now)
        _forget(record.times, now)

    def drop(self, name: str, now: float, why: str, count: int = 1) -> None:
        """Messages came that cannot be used."""
        record = self._records[name]
        if record.waiting is None:
            record.waiting = now
        record.dropped += count
        record.drops.extend([now] * count)
        record.why = why
        _forget(record.drops, now)

    def hold(self, name: str, now: float) -> None:
        """Nothing is expected at present."""
        record = self._records[name]
        if record.waiting is not None:
            record.waiting = record.flowing = now

    def silent(self, name: str, now: float) -> bool:
        """Whether nothing usable has come for longer than is usual, and the warning's limit."""
        waiting, pause = self._records[name].waiting, self._pauses[name]
        return waiting is not None and now - waiting - pause > self._limits.input_warn_age

    def dropping(self, name: str, now: float) -> bool:
        """Whether messages were dropped lately."""
        drops = self._records[name].drops
        _forget(drops, now)
        return bool(drops)

    def reports(self, now: float) -> list[InputReport]:
        """All inputs in their order."""
        self._expect(now)
        return [self._report(each, self._records[each.name], now) for each in self._inputs]

    def _expect(self, now: float) -> None:
        """A source that was heard sends all that is its own; what is joined follows from all."""
        for each in self._inputs:
            record = self._records[each.name]
            others = [o for o in self._inputs if o.source and each.source in ("", o.source)]
            begun = [first for o in others if (first := self._records[o.name].first) is not None]
            if record.waiting is None and begun:
                record.waiting = min(begun)
            if not each.source and any(self.silent(o.name, now) for o in others):
                self.hold(each.name, now)

    def _report(self, each: Input, record: _Record, now: float) -> InputReport:
        _forget(record.times, now)
        _forget(record.drops, now)
        rate = len(record.times) / WINDOW
        level, text = self._judge(each, record, now, rate)
        age = None if record.last is None else now - record.last
        finding = Finding(each.name, level, text, each.source)
        return InputReport(finding, age, rate, record.received, record.dropped)

    def _judge(self, each: Input, record: _Record, now: float, rate: float) -> tuple[Level, str]:
        if record.waiting is None:
            return Level.OK, "none yet"
        limits, wait = self._limits, now - record.waiting
        if wait - each.pause > limits.input_warn_age:
            late = wait - each.pause > limits.input_error_age
            return Level.ERROR if late else Level.WARN, _silence(each, record, wait)
        if record.drops:
            return Level.WARN, f"{len(record.drops)} dropped in {WINDOW:.0f} s: {record.why}"
        steady = now - record.flowing > WINDOW and not each.pause
        slow = steady and rate < limits.input_min_rate
        return Level.WARN if slow else Level.OK, f"{rate:.1f} messages/s"


def _silence(each: Input, record: _Record, wait: float) -> str:
    if record.drops:
        return f"none usable for {wait:.1f} s: {record.why}"
    if not each.source:
        return f"none for {wait:.1f} s"
    return f"none for {wait:.1f} s: {each.source} is {'silent' if each.present() else 'not there'}"


def _forget(times: deque[float], now: float) -> None:
    while times and now - times[0] > WINDOW:
        times.popleft()
