"""What drives the rover in the states, made of the parameters that may change during a mission."""

from __future__ import annotations

from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.explorers import PlanExplorer, SightDriver
from rover_decision.missions.sample_return.home_paths import HomewardDriver
from rover_navigation.actuation import Actuation
from rover_navigation.path_tracking import PathTracker
from rover_navigation.scale import Scale


class Drivers:
    """None of them remembers anything, so that each can be replaced at any frame."""

    tracker: PathTracker
    explorer: PlanExplorer
    sight: SightDriver
    homeward: HomewardDriver

    def __init__(self, actuation: Actuation, scale: Scale, config: DecisionConfig) -> None:
        self._actuation = actuation
        self._scale = scale
        self.configure(config)

    def configure(self, config: DecisionConfig) -> None:
        """Make all of them as the parameters say."""
        self.tracker = PathTracker(self._actuation, self._scale, config.top_speed)
        self.sight = SightDriver(self._actuation, self._scale, config)
        self.explorer = PlanExplorer(self.tracker, self.sight, config)
        self.homeward = HomewardDriver(
            self.tracker, self.sight, config.stop_clearance, config.go_clearance
        )
