"""Encounters with the ramp: where it is, and what is kept free for it, for good."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_heat.planning.types import HeatPlan, StandOff
from rover_heat.ramp.estimate import Ramp, estimate_ramp
from rover_heat.ramp.hazards import Hazards
from rover_heat.tilt import Lean

SAME_FOOT, SAME_RISE = 0.4, math.radians(30.0)  # [m], [rad] between encounters with one foot
AHEAD = 0.20  # [m] of a place that held the wheels, from the axle


@dataclass
class RampBook:
    length: float  # [m] of ground that a ramp takes
    ramps: tuple[Ramp, ...] = ()
    hazards: Hazards = field(default_factory=Hazards)
    approaches: tuple[StandOff, ...] = ()  # of each ramp, in the newest plan that knows them all
    done: bool = False  # stood on its flat part
    served: bool = False  # stands there, and the last payload is released

    def memory(self) -> dict[str, Any]:
        """For JSON. Who is killed on top has been there: nothing but a look around is left."""
        return {
            "ramps": [dict(vars(ramp)) for ramp in self.ramps],
            "hazards": self.hazards.memory(),
            "done": self.done or self.served,
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self.ramps = tuple(Ramp(**ramp) for ramp in memory["ramps"])
        self.hazards = Hazards.of(memory["hazards"])
        self.done = bool(memory["done"])

    def meet(self, pose: Pose, lean: Lean, hits: NDArray[np.float64]) -> Ramp:
        """The robot tilts at a pose: another ramp, the same one again, or one met from its side.

        The last says where it is not safe, and not how it lies: it is marked and no ramp to climb.
        """
        ramp = estimate_ramp(pose, lean, hits)
        if ramp.straight and not any(_is_same(known, ramp) for known in self.ramps):
            self.ramps = (*self.ramps, ramp)
            self.hazards = self.hazards.with_ramp(ramp, self.length)
        self.hazards = self.hazards.with_disc(pose)
        return ramp

    def block_ahead(self, pose: Pose) -> None:
        """Something holds the wheels that the lidar does not see."""
        x = pose.x + AHEAD * math.cos(pose.yaw)
        y = pose.y + AHEAD * math.sin(pose.yaw)
        self.hazards = self.hazards.with_disc(Pose(x, y, pose.yaw))

    def update(self, plan: HeatPlan) -> None:
        """A new plan."""
        if len(plan.approaches) == len(self.ramps):
            self.approaches = plan.approaches

    def best(self) -> tuple[Ramp, StandOff] | None:
        """The ramp to climb: one between walls, and of those the soonest reached."""
        stands = self.approaches if len(self.approaches) == len(self.ramps) else ()
        pairs = zip(self.ramps, stands, strict=False)
        reachable = [pair for pair in pairs if math.isfinite(pair[1].seconds)]
        return min(reachable, key=lambda p: (not p[0].between, p[1].seconds), default=None)


def _is_same(a: Ramp, b: Ramp) -> bool:
    near = math.dist((a.x, a.y), (b.x, b.y)) < SAME_FOOT
    return near and abs(wrap_angle(a.yaw - b.yaw)) < SAME_RISE
