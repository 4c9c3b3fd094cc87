"""Which rock to go for: known, in reach, not yet collected, not given up lately."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import RockTrack

SAME_ROCK = 1.5  # [m] a rock this near to where one was picked up is that one
MOST_TRIES = 3  # what was not there three times is no rock


@dataclass(frozen=True)
class Target:
    rock: RockTrack
    distance: float  # [m]
    bearing: float  # [rad] left positive


@dataclass
class _Tries:
    count: int
    last: float  # [s]


class RockMemory:
    """Rocks collected and given up."""

    def __init__(self, retry_after: float) -> None:
        self._retry_after = retry_after
        self._collected: list[tuple[float, float]] = []
        self._tries: dict[int, _Tries] = {}
        self._spent: dict[int, float] = {}  # [s] on this try

    def worth_going(self, rocks: tuple[RockTrack, ...], time: float) -> tuple[RockTrack, ...]:
        """The rocks to collect at `time` [s]."""
        return tuple(rock for rock in rocks if self._wanted(rock, time))

    def nearest(self, rocks: tuple[RockTrack, ...], pose: Pose, time: float) -> Target | None:
        """The nearest rock that is worth going for at `time` [s]."""
        targets = [_target(rock, pose) for rock in self.worth_going(rocks, time)]
        return min(targets, key=lambda target: target.distance, default=None)

    def left(self, rocks: tuple[RockTrack, ...]) -> int:
        """How many known rocks are not yet collected."""
        return sum(not self._is_collected(rock) for rock in rocks)

    @property
    def given_up(self) -> int:
        return len(self._tries)

    def collect(self, x: float, y: float) -> None:
        """A sample was picked up at this place [m]."""
        self._collected.append((x, y))

    def spend(self, rock: RockTrack, seconds: float) -> None:
        """Time [s] went into getting to a rock."""
        self._spent[rock.id] = self.spent(rock) + seconds

    def spent(self, rock: RockTrack) -> float:
        """[s] since the rock was first gone for, or given up last."""
        return self._spent.get(rock.id, 0.0)

    def give_up(self, rock: RockTrack, time: float) -> None:
        """For a while; for good after some tries."""
        self._spent.pop(rock.id, None)
        tries = self._tries.setdefault(rock.id, _Tries(0, time))
        tries.count, tries.last = tries.count + 1, time

    def _wanted(self, rock: RockTrack, time: float) -> bool:
        if self._is_collected(rock):
            return False
        tries = self._tries.get(rock.id)
        if tries is None:
            return True
        return tries.count < MOST_TRIES and time - tries.last >= self._retry_after

    def _is_collected(self, rock: RockTrack) -> bool:
        return any(math.hypot(rock.x - x, rock.y - y) < SAME_ROCK for x, y in self._collected)


def _target(rock: RockTrack, pose: Pose) -> Target:
    dx, dy = rock.x - pose.x, rock.y - pose.y
    return Target(rock, math.hypot(dx, dy), wrap_angle(math.atan2(dy, dx) - pose.yaw))
