"""Where home lies, by the way home that the parameters name."""

from __future__ import annotations

from rover_common.geometry import bearing_to
from rover_decision.missions.sample_return.classic.backtrack import BreadcrumbTrail
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.tick import TickContext

HOME_RADIUS = 2.0  # [m]


class Homing:
    """The bearing to the next breadcrumb, along the shortest path, or to home itself."""

    def __init__(self, parts: Parts, drivers: Drivers) -> None:
        self._parts = parts
        self._drivers = drivers
        self._trail = BreadcrumbTrail()
        for x, y in parts.breadcrumbs.points:  # of a mission that goes on
            self._trail.drop((float(x), float(y)))

    def update(self, tick: TickContext) -> None:
        """Once per frame."""
        if tick.heading_home:
            self._trail.follow(tick.pose)
        else:
            self._trail.add(tick.pose)

    def bearing(self, tick: TickContext) -> float:
        """[rad] where to go."""
        name = self._parts.home_paths.method.name
        if name == "breadcrumbs" and self._trail.next is not None:
            return bearing_to(tick.pose, *self._trail.next)
        if name == "shortest_path" and tick.plan is not None and len(tick.plan.home_path) > 0:
            return self._drivers.tracker.bearing(tick.pose, tick.plan.home_path)
        return bearing_to(tick.pose, *self._parts.home)
