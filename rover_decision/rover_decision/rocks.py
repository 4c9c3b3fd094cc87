"""Which rock to go for: known, in reach, not yet collected, not given up lately."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.dataflow import Rock
from rover_common.geometry import Pose, wrap_angle

SAME_ROCK = 1.5  # [m] a rock this near to where one was picked up is that one


@dataclass(frozen=True)
class Target:
    rock: Rock
    distance: float  # [m]
    bearing: float  # [rad] left positive


class RockMemory:
    """Rocks collected and given up."""

    def __init__(self, retry_after: float) -> None:
        self._retry_after = retry_after
        self._collected: list[tuple[float, float]] = []
        self._given_up: dict[int, float] = {}

    def nearest(self, rocks: tuple[Rock, ...], pose: Pose, time: float) -> Target | None:
        """The nearest rock that is worth going for at `time` [s]."""
        targets = [_target(rock, pose) for rock in rocks if self._wanted(rock, time)]
        return min(targets, key=lambda target: target.distance, default=None)

    def wanted(self, rocks: tuple[Rock, ...]) -> int:
        """How many known rocks are not yet collected."""
        return sum(not self._is_collected(rock) for rock in rocks)

    @property
    def given_up(self) -> int:
        return len(self._given_up)

    def collect(self, x: float, y: float) -> None:
        """A sample was picked up at this place [m]."""
        self._collected.append((x, y))

    def give_up(self, rock: Rock, time: float) -> None:
        self._given_up[rock.id] = time

    def _wanted(self, rock: Rock, time: float) -> bool:
        since = time - self._given_up.get(rock.id, -math.inf)
        return since >= self._retry_after and not self._is_collected(rock)

    def _is_collected(self, rock: Rock) -> bool:
        return any(math.hypot(rock.x - x, rock.y - y) < SAME_ROCK for x, y in self._collected)


def _target(rock: Rock, pose: Pose) -> Target:
    dx, dy = rock.x - pose.x, rock.y - pose.y
    return Target(rock, math.hypot(dx, dy), wrap_angle(math.atan2(dy, dx) - pose.yaw))
