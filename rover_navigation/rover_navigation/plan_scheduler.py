"""Plans are made beside the drive path, in a thread, and take effect at a defined frame.

A frame at which the map was published asks for a plan; it counts from the first frame on that is
`delay` younger. So a simulated mission repeats exactly, however fast the machine plans.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from rover_common.types import GridMap
from rover_navigation.types import Plan, PlanRequest

MOST_PENDING = 8  # requests whose map never came

MakeRequest = Callable[[GridMap], PlanRequest]


@dataclass
class _Order:
    stamp: int  # [ns]
    make_request: MakeRequest
    future: Future[Plan] | None = None


class PlanDesk:
    """Takes requests and maps, hands out plans."""

    def __init__(self, plan: Callable[[PlanRequest], Plan], delay: float, lockstep: bool) -> None:
        """delay: [s] of frame time from the request to its effect; lockstep: wait for it then."""
        self._plan = plan
        self._delay = round(delay * 1e9)
        self._lockstep = lockstep
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="planner")
        self.clear()

    def clear(self) -> None:
        """Forget all requests and the plan in force."""
        self._orders: deque[_Order] = deque()
        self._map: tuple[int, GridMap] | None = None  # the newest
        self._current: Plan | None = None

    def close(self) -> None:
        self._pool.shutdown(wait=True, cancel_futures=True)

    def ask(self, stamp: int, make_request: MakeRequest) -> None:
        """Order a plan at a frame; its map, of the same stamp, may come before or after."""
        self._orders.append(_Order(stamp, make_request))
        if len(self._orders) > MOST_PENDING:
            self._orders.popleft()
        self._start()

    def give_map(self, stamp: int, grid: GridMap) -> None:
        """The map of a frame has come: start planning. A newer map serves older orders as well."""
        self._map = (stamp, grid)
        self._start()

    def must_wait(self, stamp: int) -> bool:
        """Whether the frame needs a plan whose map has not come; never so when not in lockstep."""
        return self._lockstep and any(
            order.future is None and self._counts(order, stamp) for order in self._orders
        )

    def plan_at(self, stamp: int) -> Plan | None:
        """The plan in force at a frame."""
        while self._orders and self._counts(self._orders[0], stamp):
            order = self._orders[0]
            if order.future is None or not (self._lockstep or order.future.done()):
                break
            self._current = order.future.result()
            self._orders.popleft()
        return self._current

    def _start(self) -> None:
        if self._map is None:
            return
        stamp, grid = self._map
        for order in self._orders:
            if order.future is None and order.stamp <= stamp:
                order.future = self._pool.submit(self._plan, order.make_request(grid))

    def _counts(self, order: _Order, stamp: int) -> bool:
        return stamp >= order.stamp + self._delay
