"""The samples: how many are left, and which rock to go for: in reach, not yet collected, not given
up lately.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from rover_common.geometry import Pose, bearing_to
from rover_common.types import RockTrack
from rover_decision.types import Frame
from rover_navigation.types import Target

SAME_ROCK = 1.5  # [m] a rock this near to where one was picked up is that one
MAX_TRIES = 3  # a rock that was not there three times is none


@dataclass(frozen=True)
class SeenRock:
    """A rock to go for, as the rover sees it."""

    rock: RockTrack
    distance: float  # [m]
    bearing: float  # [rad] left positive


@dataclass
class _Tries:
    count: int
    last: float  # [s]


class Samples:
    """What is known of the samples, from the run's first frame on."""

    def __init__(self, arm_forward: float, deadline: float, retry_after: float) -> None:
        """arm_forward [m] of where the arm picks up; deadline, retry_after [s] of one rock."""
        self._arm_forward = arm_forward
        self._deadline = deadline
        self._retry_after = retry_after
        self.total = 0
        self._count: int | None = None  # not yet collected, at the newest frame
        self._collected: list[tuple[float, float]] = []
        self._tries: dict[int, _Tries] = {}
        self._spent: dict[int, float] = {}  # [s] on this try

    def update(self, frame: Frame) -> None:
        """Once per frame: a smaller count means that one was picked up here."""
        count, pose = frame.vehicle.sample_count, frame.pose
        if self._count is None:
            self.total = count
        elif count < self._count:
            x = pose.x + self._arm_forward * math.cos(pose.yaw)
            y = pose.y + self._arm_forward * math.sin(pose.yaw)
            self._collected.append((x, y))
        self._count = count

    def memory(self) -> dict[str, Any]:
        """All of it, for JSON."""
        return {
            "total": self.total,
            "count": self._count,
            "collected": list(self._collected),
            "tries": [[id, tries.count, tries.last] for id, tries in self._tries.items()],
            "spent": list(self._spent.items()),
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self.total, self._count = int(memory["total"]), memory["count"]
        self._collected = [(float(x), float(y)) for x, y in memory["collected"]]
        self._tries = {int(id): _Tries(int(n), float(last)) for id, n, last in memory["tries"]}
        self._spent = {int(id): float(seconds) for id, seconds in memory["spent"]}

    @property
    def all_collected(self) -> bool:
        return self.total > 0 and self._count == 0

    @property
    def collected(self) -> int:
        return max(0, self.total - (self._count or 0))

    @property
    def given_up(self) -> int:
        return len(self._tries)

    def known(self, rocks: tuple[RockTrack, ...]) -> int:
        """How many of the rocks are not yet collected."""
        return sum(not self._is_collected(rock) for rock in rocks)

    def nearest(self, frame: Frame) -> SeenRock | None:
        """The nearest rock that is worth going for."""
        seen = [_seen(rock, frame.pose) for rock in self._wanted(frame)]
        return min(seen, key=lambda rock: rock.distance, default=None)

    def targets(self, frame: Frame, reach: float) -> tuple[Target, ...]:
        """What a plan is to lead to: within `reach` [m] of each rock worth going for."""
        return tuple(Target(rock.id, rock.x, rock.y, reach) for rock in self._wanted(frame))

    def spend(self, frame: Frame, seconds: float) -> None:
        """Time [s] went into getting to the nearest rock, which is given up after its deadline."""
        seen = self.nearest(frame)
        if seen is None:
            return
        rock_id = seen.rock.id
        self._spent[rock_id] = self._spent.get(rock_id, 0.0) + seconds
        if self._spent[rock_id] > self._deadline:
            del self._spent[rock_id]
            tries = self._tries.setdefault(rock_id, _Tries(0, frame.time))
            tries.count, tries.last = tries.count + 1, frame.time

    def _wanted(self, frame: Frame) -> list[RockTrack]:
        if self.all_collected:
            return []
        return [rock for rock in frame.rocks if self._is_wanted(rock, frame.time)]

    def _is_wanted(self, rock: RockTrack, time: float) -> bool:
        if self._is_collected(rock):
            return False
        tries = self._tries.get(rock.id)
        if tries is None:
            return True
        return tries.count < MAX_TRIES and time - tries.last >= self._retry_after

    def _is_collected(self, rock: RockTrack) -> bool:
        return any(math.hypot(rock.x - x, rock.y - y) < SAME_ROCK for x, y in self._collected)


def _seen(rock: RockTrack, pose: Pose) -> SeenRock:
    distance = math.hypot(rock.x - pose.x, rock.y - pose.y)
    return SeenRock(rock, distance, bearing_to(pose, rock.x, rock.y))
