"""How long the mission's lockstep waits for a navigator that says nothing."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from rover_interfaces.msg import NavigationTick

from rover_heat import node_lockstep
from rover_heat.node_lockstep import PATIENCE, PATIENCE_ABSENT, HeatLockstep

TICK = 50_000_000  # [ns]


class Ticks:
    """A lockstep whose batches come as fast as they are answered, on a wall clock of its own."""

    def __init__(self, clock: SimpleNamespace) -> None:
        self.clock = clock
        self.answered: list[tuple[int, bool]] = []
        self._made = 0
        sensors = SimpleNamespace(
            collector=SimpleNamespace(take_complete=self._take), poses=SimpleNamespace()
        )
        navigator = SimpleNamespace(told_about=lambda stamp: True, settled=True)
        self.navigators = 1
        subscription = SimpleNamespace(get_publisher_count=lambda: self.navigators)
        node = SimpleNamespace(create_subscription=lambda *_: subscription)
        self.lockstep = HeatLockstep(
            node,
            sensors,
            navigator,
            plan_ready=lambda stamp: True,
            decide=lambda batch: None,
            answer=lambda stamp, drives: self.answered.append((stamp, drives)),
        )
        self.lockstep.work()

    def _take(self) -> SimpleNamespace:
        self._made += 1
        return SimpleNamespace(stamp=self._made * TICK, odometry=())

    @property
    def stamp(self) -> int:
        """[ns] of the tick at hand."""
        return self._made * TICK

    def look(self, seconds: float) -> None:
        """So much later."""
        self.clock.now += seconds
        self.lockstep.check_patience()

    def speak(self, stamp: int) -> None:
        """The navigator, about a tick."""
        message = NavigationTick(velocity=True)
        message.header.stamp.nanosec = stamp
        self.lockstep._on_tick(message)


@pytest.fixture
def ticks(monkeypatch) -> Ticks:
    clock = SimpleNamespace(now=0.0)
    clock.monotonic = lambda: clock.now
    monkeypatch.setattr(node_lockstep, "time", clock)
    return Ticks(clock)


def test_a_tick_waits_for_its_navigator(ticks):
    ticks.look(PATIENCE - 0.1)
    assert ticks.answered == []
    ticks.speak(ticks.stamp)
    assert ticks.answered == [(TICK, True)]
    assert ticks.lockstep.missing == 0


def test_each_tick_of_an_absent_navigator_waits_a_little(ticks):
    ticks.look(PATIENCE)
    assert ticks.answered == [(TICK, False)]
    for count in range(2, 6):
        ticks.look(PATIENCE_ABSENT / 2)
        assert len(ticks.answered) == count - 1
        ticks.look(PATIENCE_ABSENT / 2)
        assert ticks.answered[-1] == (count * TICK, False)
    assert ticks.lockstep.missing == 5


def test_one_that_speaks_again_is_waited_for_again(ticks):
    ticks.look(PATIENCE)
    ticks.speak(ticks.stamp)
    assert ticks.answered[-1] == (2 * TICK, True)
    ticks.look(PATIENCE - 0.1)
    assert len(ticks.answered) == 2


def test_one_that_was_started_again_has_not_heard_the_tick(ticks):
    ticks.look(PATIENCE_ABSENT)
    assert ticks.answered == []  # it has just come, for the first time
    ticks.speak(ticks.stamp)
    ticks.look(0.1)
    ticks.navigators = 2
    ticks.look(PATIENCE_ABSENT)
    assert ticks.answered == [(TICK, True), (2 * TICK, False)]
    assert ticks.lockstep.missing == 1
