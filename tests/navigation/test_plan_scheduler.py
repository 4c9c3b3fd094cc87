"""The plan scheduler: when a plan takes effect, and what happens when none comes."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator

import pytest
from maps import HALL, OPEN_EAST, UNKNOWN, request, straight_plan

from rover_common.types import GridMap
from rover_navigation.plan_scheduler import MAX_PENDING, PlanScheduler
from rover_navigation.types import Plan, PlanRequest

SECOND = 1_000_000_000  # [ns]
DELAY = 0.3  # [s]


class Planner:
    """A planner that works as fast as its test lets it, and fails where it is told to."""

    def __init__(self) -> None:
        self.gate = threading.Event()  # closed, it hangs
        self.gate.set()
        self.hangs = MAX_PENDING  # so often, while it is closed
        self.begun: list[int] = []  # stamps [ns] of the requests that were taken up
        self.maps: list[GridMap] = []
        self.took_up = threading.Semaphore(0)
        self.fails = False

    def __call__(self, asked: PlanRequest) -> Plan:
        self.begun.append(asked.stamp)
        self.maps.append(asked.grid)
        self.took_up.release()
        if self.hangs > 0 and not self.gate.is_set():
            self.hangs -= 1
            self.gate.wait()
        if self.fails:
            raise ZeroDivisionError("no such thing")
        return straight_plan(stamp=asked.stamp)


@pytest.fixture
def planner() -> Iterator[Planner]:
    planner = Planner()
    yield planner
    planner.gate.set()


@pytest.fixture
def make(planner: Planner) -> Iterator[Callable[..., PlanScheduler]]:
    made: list[PlanScheduler] = []

    def scheduler(lockstep: bool, patience: float = 5.0) -> PlanScheduler:
        made.append(PlanScheduler(planner, DELAY, lockstep, patience))
        return made[-1]

    yield scheduler
    planner.gate.set()
    for each in made:
        each.close()


@pytest.fixture(params=[True, False], ids=["lockstep", "live"])
def lockstep(request) -> bool:
    return request.param


def order(scheduler: PlanScheduler, stamp: int, grid: GridMap | None = HALL) -> None:
    """Order a plan at a frame, whose map comes at once unless it is None."""
    scheduler.order(stamp, lambda map_: request(map_, stamp=stamp))
    if grid is not None:
        scheduler.give_map(stamp, grid)


def settled(scheduler: PlanScheduler, stamp: int) -> PlanScheduler:
    """The scheduler with all that was ordered made."""
    scheduler._pool.submit(int).result(5.0)
    return scheduler


def test_a_plan_takes_effect_after_the_delay(make, lockstep):
    scheduler = make(lockstep)
    order(scheduler, 10 * SECOND)
    settled(scheduler, 10 * SECOND)
    assert scheduler.status_at(10 * SECOND + 299_999_999).plan is None
    assert scheduler.status_at(10 * SECOND + 300_000_000).plan.stamp == 10 * SECOND


def test_the_map_may_come_before_the_frame_orders(make, lockstep, planner):
    scheduler = make(lockstep)
    scheduler.give_map(SECOND, HALL)
    order(scheduler, SECOND, grid=None)
    assert scheduler.ready(2 * SECOND)
    assert settled(scheduler, SECOND).status_at(2 * SECOND).plan.stamp == SECOND


def test_a_newer_map_serves_older_orders_and_an_older_one_does_not(make, planner):
    scheduler = make(lockstep=True)
    order(scheduler, 2 * SECOND, grid=None)
    scheduler.give_map(SECOND, HALL)
    assert not scheduler.ready(3 * SECOND)
    scheduler.give_map(3 * SECOND, OPEN_EAST)
    assert scheduler.status_at(3 * SECOND).plan.stamp == 2 * SECOND
    assert planner.maps == [OPEN_EAST]


def test_a_map_that_was_overtaken_does_not_replace_the_newer_one(make, planner):
    scheduler = make(lockstep=True)
    scheduler.give_map(2 * SECOND, OPEN_EAST)
    scheduler.give_map(SECOND, UNKNOWN)
    order(scheduler, 2 * SECOND, grid=None)
    assert scheduler.ready(3 * SECOND)
    assert scheduler.status_at(3 * SECOND).plan is not None
    assert planner.maps == [OPEN_EAST]


def test_only_lockstep_waits_for_maps(make, lockstep):
    scheduler = make(lockstep)
    order(scheduler, SECOND, grid=None)
    assert scheduler.ready(SECOND + 200_000_000)  # it does not count yet
    assert scheduler.ready(SECOND + 400_000_000) is not lockstep
    scheduler.give_map(SECOND, HALL)
    assert scheduler.ready(SECOND + 400_000_000)


def test_a_live_robot_does_not_wait_for_a_plan(make, planner):
    scheduler = make(lockstep=False)
    planner.gate.clear()
    order(scheduler, SECOND)
    assert scheduler.status_at(2 * SECOND).plan is None
    planner.gate.set()
    assert settled(scheduler, SECOND).status_at(2 * SECOND).plan.stamp == SECOND


def test_a_live_planner_that_is_late_makes_the_newest_plan_next(make, planner):
    """Else each plan would be later than the one before, and in the end none would count."""
    scheduler = make(lockstep=False)
    planner.gate.clear()
    for step in range(3 * MAX_PENDING):
        order(scheduler, SECOND + step * SECOND // 4)
        if step == 0:
            assert planner.took_up.acquire(timeout=5.0)
    planner.gate.set()
    now = SECOND + 3 * MAX_PENDING * SECOND // 4
    newest = now - SECOND // 4
    assert settled(scheduler, now).status_at(now + SECOND).plan.stamp == newest
    assert planner.begun == [SECOND, newest]


def test_a_planner_that_raises_is_a_value_that_the_next_plan_replaces(make, lockstep, planner):
    scheduler = make(lockstep)
    order(scheduler, SECOND)
    before = settled(scheduler, SECOND).status_at(2 * SECOND).plan
    planner.fails = True
    order(scheduler, 2 * SECOND)
    status = settled(scheduler, 2 * SECOND).status_at(3 * SECOND)
    assert status.plan is before
    assert status.failure.stamp == 2 * SECOND
    assert "ZeroDivisionError: no such thing" in status.failure.reason
    assert (scheduler.failures, scheduler.last_failure) == (1, status.failure.reason)
    planner.fails = False
    order(scheduler, 3 * SECOND)
    status = settled(scheduler, 3 * SECOND).status_at(4 * SECOND)
    assert (status.plan.stamp, status.failure) == (3 * SECOND, None)
    assert scheduler.failures == 1


def test_a_request_that_cannot_be_made_is_a_failure_too(make):
    scheduler = make(lockstep=True)
    scheduler.order(SECOND, lambda grid: request(grid, nonsense=True))
    scheduler.give_map(SECOND, HALL)
    assert "TypeError" in scheduler.status_at(2 * SECOND).failure.reason


def test_lockstep_gives_a_planner_up_that_hangs_and_goes_on_with_another_thread(make, planner):
    scheduler = make(lockstep=True, patience=1.0)
    planner.hangs = 1
    planner.gate.clear()
    hung = SECOND
    order(scheduler, hung)
    assert planner.took_up.acquire(timeout=5.0)
    order(scheduler, 2 * SECOND, grid=None)
    status = scheduler.status_at(hung + SECOND // 2)
    assert (status.failure.stamp, status.failure.reason) == (hung, "no plan within 1 s")
    scheduler.give_map(2 * SECOND, HALL)
    status = scheduler.status_at(3 * SECOND)
    assert (status.plan.stamp, status.failure) == (2 * SECOND, None)


def test_orders_whose_maps_do_not_come_fail(make):
    scheduler = make(lockstep=True)
    for stamp in (SECOND, 2 * SECOND):
        order(scheduler, stamp, grid=None)
        assert not scheduler.ready(3 * SECOND)
    scheduler.drop_waiting()
    assert scheduler.ready(3 * SECOND)
    status = scheduler.status_at(3 * SECOND)
    assert (status.failure.stamp, scheduler.failures) == (2 * SECOND, 2)
    assert "map" in status.failure.reason


def test_orders_without_maps_do_not_pile_up(make, lockstep):
    scheduler = make(lockstep)
    for step in range(3 * MAX_PENDING):
        order(scheduler, SECOND + step, grid=None)
    scheduler.drop_waiting()
    assert scheduler.failures <= MAX_PENDING


class TestNewRun:
    """What a new run leaves of the one before: nothing."""

    def test_the_plan_in_force_and_its_failure_are_forgotten(self, make, lockstep, planner):
        scheduler = make(lockstep)
        order(scheduler, SECOND)
        assert settled(scheduler, SECOND).status_at(2 * SECOND).plan is not None
        planner.fails = True
        order(scheduler, 2 * SECOND)
        assert settled(scheduler, SECOND).status_at(3 * SECOND).failure is not None
        scheduler.begin(4 * SECOND)
        status = scheduler.status_at(4 * SECOND)
        assert (status.plan, status.failure) == (None, None)

    def test_plans_in_the_making_never_take_effect(self, make, lockstep, planner):
        scheduler = make(lockstep)
        planner.gate.clear()
        order(scheduler, SECOND)
        order(scheduler, SECOND + 1)
        assert planner.took_up.acquire(timeout=5.0)
        scheduler.begin(2 * SECOND)
        planner.gate.set()
        status = settled(scheduler, SECOND).status_at(9 * SECOND)
        assert (status.plan, status.failure, scheduler.failures) == (None, None, 0)
        assert planner.begun == [SECOND]

    def test_an_older_map_serves_no_order_of_it(self, make, planner):
        scheduler = make(lockstep=True)
        scheduler.give_map(SECOND, UNKNOWN)
        scheduler.begin(2 * SECOND)
        order(scheduler, 2 * SECOND, grid=None)
        assert not scheduler.ready(3 * SECOND)
        assert planner.begun == []

    def test_a_map_of_it_that_came_early_is_kept(self, make, planner):
        scheduler = make(lockstep=True)
        scheduler.give_map(2 * SECOND, HALL)
        scheduler.begin(2 * SECOND)
        order(scheduler, 2 * SECOND, grid=None)
        assert scheduler.status_at(3 * SECOND).plan.stamp == 2 * SECOND
