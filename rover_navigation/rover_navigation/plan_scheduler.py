"""Plans are made beside the drive path, in a thread, and take effect at a defined frame.

A frame at which the map was published asks for a plan; it counts from the first frame on that is
`delay` younger. So a simulated mission repeats exactly, however fast the machine plans.
"""

from __future__ import annotations

import traceback
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Generic, TypeVar

from rover_common.types import GridMap
from rover_navigation.types import PlanFailed

MAX_PENDING = 8  # orders whose map never came
# [s] of wall time that lockstep waits for a plan, which takes 0.05 s: then the planner hangs.
PATIENCE = 10.0

RequestT = TypeVar("RequestT")
PlanT = TypeVar("PlanT")
MakeRequest = Callable[[GridMap], RequestT]
MakePlan = Callable[[RequestT], PlanT]


@dataclass
class _Order(Generic[RequestT, PlanT]):
    stamp: int  # [ns]
    make_request: MakeRequest[RequestT]
    future: Future[PlanT] | None = None


@dataclass(frozen=True)
class PlanStatus(Generic[PlanT]):
    """What the planner has said up to a frame."""

    plan: PlanT | None = None  # the newest one that came
    failure: PlanFailed | None = None  # the newest answer, when it was no plan


class PlanScheduler(Generic[RequestT, PlanT]):
    """Takes orders and maps, hands out plans; a planner's failure is a value, not an exception."""

    def __init__(
        self,
        plan: MakePlan[RequestT, PlanT],
        delay: float,
        lockstep: bool,
        patience: float = PATIENCE,
    ) -> None:
        """delay: [s] of frame time from the order to its effect; lockstep: wait for it then."""
        self._plan = plan
        self._delay = round(delay * 1e9)
        self._lockstep = lockstep
        self._patience = patience
        self._pool = _pool()
        self._orders: deque[_Order[RequestT, PlanT]] = deque()
        self._map: tuple[int, GridMap] | None = None  # the newest
        self._status: PlanStatus[PlanT] = PlanStatus()
        self.failures = 0  # in all
        self.last_failure = ""  # why the newest of them did not come

    def use(self, plan: MakePlan[RequestT, PlanT]) -> None:
        """Make the plans with another planner; those that are being made are not."""
        self._plan = plan

    def begin(self, start: int) -> None:
        """A new run begins at a stamp [ns]: forget all that is older, and the plan in force."""
        for order in self._orders:
            if order.future is not None:
                order.future.cancel()
        self._orders.clear()
        if self._map is not None and self._map[0] < start:
            self._map = None
        self._status = PlanStatus()

    def close(self) -> None:
        """End the planner's thread; one that hangs is left to itself."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def order(self, stamp: int, make_request: MakeRequest[RequestT]) -> None:
        """Order a plan at a frame; its map, of the same stamp, may come before or after."""
        self._orders.append(_Order(stamp, make_request))
        if len(self._orders) > MAX_PENDING:
            self._orders.popleft()
        self._start()

    def give_map(self, stamp: int, grid: GridMap) -> None:
        """The map of a frame has come: start planning. A newer map serves older orders as well."""
        if self._map is not None and stamp < self._map[0]:
            return
        self._map = (stamp, grid)
        self._start()

    def ready(self, stamp: int) -> bool:
        """Whether the maps of all plans that count at a frame have come; only lockstep waits."""
        return not self._lockstep or not any(
            order.future is None and self._counts(order, stamp) for order in self._orders
        )

    def drop_waiting(self) -> None:
        """The maps of the orders that still wait for one will not come: they have failed."""
        for order in [order for order in self._orders if order.future is None]:
            self._orders.remove(order)
            self._take(PlanFailed(order.stamp, "its map did not come"))

    def status_at(self, stamp: int) -> PlanStatus[PlanT]:
        """What counts at a frame."""
        while self._orders and self._counts(self._orders[0], stamp):
            order = self._orders[0]
            if order.future is None or not (self._lockstep or order.future.done()):
                break
            self._orders.popleft()
            self._take(self._outcome(order))
        return self._status

    def _take(self, outcome: PlanT | PlanFailed) -> None:
        if isinstance(outcome, PlanFailed):
            self._status = PlanStatus(self._status.plan, outcome)
            self.failures += 1
            self.last_failure = outcome.reason
        else:
            self._status = PlanStatus(outcome)

    def _outcome(self, order: _Order[RequestT, PlanT]) -> PlanT | PlanFailed:
        assert order.future is not None
        try:
            return order.future.result(self._patience)
        except Exception as error:  # whatever it is, the drive path must not end with it
            if not order.future.done():
                self._replace_pool()
                return PlanFailed(order.stamp, f"no plan within {self._patience:g} s")
            return PlanFailed(order.stamp, _told(error))

    def _replace_pool(self) -> None:
        """The planner's thread hangs: go on with a new one, and order anew what waits for it."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._pool = _pool()
        for order in self._orders:
            order.future = None
        self._start()

    def _start(self) -> None:
        if self._map is None:
            return
        stamp, grid = self._map
        for order in [order for order in self._orders if order.future is None]:
            if order.stamp <= stamp:
                if not self._lockstep:
                    self._drop_overtaken()
                order.future = self._pool.submit(_make, self._plan, order.make_request, grid)

    def _drop_overtaken(self) -> None:
        """A planner that is late makes the newest plan next: else each would be later still."""
        self._orders = deque(
            order for order in self._orders if order.future is None or not order.future.cancel()
        )

    def _counts(self, order: _Order[RequestT, PlanT], stamp: int) -> bool:
        return stamp >= order.stamp + self._delay


def _make(
    plan: MakePlan[RequestT, PlanT], make_request: MakeRequest[RequestT], grid: GridMap
) -> PlanT:
    """In the planner's thread."""
    return plan(make_request(grid))


def _told(error: Exception) -> str:
    """What it is, and where it comes from."""
    places = traceback.extract_tb(error.__traceback__)
    where = f" ({places[-1].filename}:{places[-1].lineno})" if places else ""
    return f"{type(error).__name__}: {error}{where}"


def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(1, thread_name_prefix="planner")
