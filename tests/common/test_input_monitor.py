"""Inputs that are silent, slow or invalid are warnings and errors, with their cause."""

from __future__ import annotations

import pytest

from rover_common.health import Level
from rover_common.input_monitor import WINDOW, Input, InputLimits, InputMonitor, InputReport

LIMITS = InputLimits()
IMAGE, ODOMETRY, FRAMES = "image", "odom", "frames"
PERIOD = 0.04  # [s]


class Watched:
    """A monitor, its time, and its newest reports."""

    def __init__(self, pause: float = 0.0) -> None:
        self.there = True
        inputs = [
            Input(IMAGE, "bridge", lambda: self.there, pause),
            Input(ODOMETRY, "bridge", lambda: self.there),
            Input(FRAMES),
        ]
        self.monitor = InputMonitor(inputs, LIMITS)
        self.now = 100.0

    def run(self, seconds: float, *names: str, period: float = PERIOD) -> None:
        for _ in range(round(seconds / period)):
            self.now += period
            for name in names:
                self.monitor.note(name, self.now)

    def of(self, name: str) -> InputReport:
        reports = {each.finding.name: each for each in self.monitor.reports(self.now)}
        return reports[name]

    def level(self, name: str) -> Level:
        return self.of(name).finding.level

    def text(self, name: str) -> str:
        return self.of(name).finding.text


@pytest.fixture
def watched() -> Watched:
    """All inputs have come for a while."""
    made = Watched()
    made.run(5.0, IMAGE, ODOMETRY, FRAMES)
    return made


def test_nothing_is_expected_before_the_first_message():
    waiting = Watched()
    waiting.now += 1000.0
    assert {waiting.level(name) for name in (IMAGE, ODOMETRY, FRAMES)} == {Level.OK}


def test_steady_inputs_are_well_and_have_their_rate(watched):
    report = watched.of(IMAGE)
    assert report.finding.level is Level.OK
    assert report.rate == pytest.approx(1.0 / PERIOD, rel=0.05)
    assert (report.received, report.dropped, report.age) == (125, 0, 0.0)


def test_a_silent_input_is_a_warning_and_then_an_error_that_names_age_and_source(watched):
    watched.now += LIMITS.input_warn_age + 0.01
    assert watched.level(IMAGE) is Level.WARN
    watched.now += LIMITS.input_error_age - LIMITS.input_warn_age
    assert watched.level(IMAGE) is Level.ERROR
    assert watched.text(IMAGE) == "none for 0.7 s: bridge is silent"
    watched.there = False
    assert watched.text(IMAGE) == "none for 0.7 s: bridge is not there"
    watched.run(PERIOD, IMAGE)
    assert watched.level(IMAGE) is Level.OK


def test_what_is_joined_is_not_blamed_for_the_silence_of_its_parts(watched):
    watched.run(3.0, IMAGE)
    assert watched.level(ODOMETRY) is Level.ERROR
    assert watched.level(FRAMES) is Level.OK


def test_parts_that_never_join_are_an_error_of_what_is_joined():
    watched = Watched()
    watched.run(1.0, IMAGE, ODOMETRY)
    assert watched.level(FRAMES) is Level.ERROR


def test_a_topic_that_never_comes_from_a_source_that_is_heard_is_an_error():
    watched = Watched()
    watched.run(1.0, IMAGE)
    assert watched.level(ODOMETRY) is Level.ERROR


def test_some_drops_are_a_warning_and_nothing_but_drops_an_error(watched):
    watched.monitor.drop(FRAMES, watched.now, "no pose", 2)
    assert watched.level(FRAMES) is Level.WARN
    assert watched.text(FRAMES) == "2 dropped in 2 s: no pose"
    assert watched.of(FRAMES).dropped == 2
    watched.run(WINDOW + 0.1, IMAGE, ODOMETRY, FRAMES)
    assert watched.level(FRAMES) is Level.OK
    for _ in range(25):
        watched.run(PERIOD, IMAGE, ODOMETRY)
        watched.monitor.drop(FRAMES, watched.now, "no pose")
    assert watched.level(FRAMES) is Level.ERROR
    assert watched.text(FRAMES) == "none usable for 1.0 s: no pose"


def test_a_slow_input_is_a_warning():
    watched = Watched()
    watched.run(6.0, IMAGE, ODOMETRY, FRAMES, period=0.3)
    assert watched.level(IMAGE) is Level.WARN
    assert watched.text(IMAGE) == "3.5 messages/s"


def test_an_input_that_begins_is_not_slow():
    watched = Watched()
    watched.run(0.2, IMAGE, ODOMETRY, FRAMES)
    assert watched.level(IMAGE) is Level.OK


def test_nothing_is_expected_while_it_is_held(watched):
    for _ in range(30):
        watched.now += 0.1
        watched.monitor.hold(IMAGE, watched.now)
    assert watched.level(IMAGE) is Level.OK
    watched.now += 1.0
    assert watched.level(IMAGE) is Level.ERROR


def test_a_usual_pause_is_no_silence():
    watched = Watched(pause=1.0)
    watched.run(2.0, IMAGE, ODOMETRY, FRAMES)
    watched.run(1.3, ODOMETRY)
    assert watched.level(IMAGE) is Level.OK
    watched.run(0.3, ODOMETRY)
    assert watched.level(IMAGE) is Level.WARN
    watched.run(0.3, ODOMETRY)
    assert watched.level(IMAGE) is Level.ERROR
