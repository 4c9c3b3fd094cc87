"""Who drives: priority and timeout, over every order of what is heard."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rover_bridge.arbiter import TIMEOUT, Arbiter, Driver
from rover_common.sensor_types import Twist

HEARD = [Driver.MANUAL, Driver.CMD_VEL, Driver.DECISION]


def test_nobody_drives_before_anybody_is_heard():
    arbiter = Arbiter()
    assert arbiter.driver(0.0) is Driver.NOBODY
    assert arbiter.velocity(Driver.NOBODY) is None


def test_a_person_comes_before_a_velocity_and_that_before_the_mission():
    arbiter = Arbiter()
    for driver in reversed(HEARD):
        arbiter.hear(driver, 10.0, Twist(1.0))
        assert arbiter.driver(10.0) is driver


def test_each_gives_way_after_the_timeout():
    arbiter = Arbiter()
    for number, driver in enumerate(HEARD):
        arbiter.hear(driver, 10.0 + 0.2 * number)
    for number, driver in enumerate(HEARD):
        last = 10.0 + 0.2 * number + TIMEOUT
        assert arbiter.driver(last - 0.01) is driver
        assert arbiter.driver(last + 0.01) is not driver
    assert arbiter.driver(99.0) is Driver.NOBODY


@given(st.lists(st.tuples(st.sampled_from(HEARD), st.floats(0.0, 2.0)), max_size=20))
def test_the_first_that_is_fresh_drives_with_its_newest_velocity(heard):
    arbiter, times, wanted = Arbiter(), {}, {}
    for number, (driver, time) in enumerate(sorted(heard, key=lambda each: each[1])):
        arbiter.hear(driver, time, Twist(float(number)))
        times[driver], wanted[driver] = time, Twist(float(number))
    fresh = [driver for driver in HEARD if driver in times and 2.0 - times[driver] <= TIMEOUT]
    driver = arbiter.driver(2.0)
    assert driver is (fresh[0] if fresh else Driver.NOBODY)
    assert arbiter.velocity(driver) == (wanted[driver] if fresh else None)
