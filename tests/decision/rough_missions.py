"""Missions in which everything goes wrong at times: tilts, obstacles nobody sees, lost frames."""

from __future__ import annotations

from dataclasses import replace

from planar_rover import PERIOD, PlanarRover, Watch, rover_in_bends, run_mission

from rover_common.types import Command
from rover_decision.missions.sample_return import make_core
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Decision, Frame, Request

CYCLE = 30.0  # [s] in which the faults repeat
LOST_FRAMES = (1.0, 17.0)  # [s] from when in each


class RoughRover(PlanarRover):
    """Tilts, is held, and loses frames."""

    def frame(self) -> Frame:
        shown = super().frame()
        if 12.0 < self.time % CYCLE < 12.6:
            tilted = replace(shown.pose, pitch=-0.3)
            return replace(shown, vehicle=replace(shown.vehicle, pose=tilted))
        return shown

    def step(self, command: Command) -> None:
        held = 20.0 < self.time % CYCLE < 23.0 and not command.pickup
        super().step(Command(brake=1.0) if held else command)
        lost = any(time <= self.time % CYCLE < time + PERIOD for time in LOST_FRAMES)
        if lost and not self.picking_up:
            self.time += 1.5


def run_rough_mission(
    config: DecisionConfig, seconds: float, watch: Watch = lambda frame, decision: None
) -> Decision:
    """With a pause as soon as one is possible, and the request to come home in the end."""
    core = make_core(config, lockstep=True)
    requests = {25.0: Request.PAUSE, 27.0: Request.RESUME, 0.7 * seconds: Request.RETURN_HOME}

    def ask(frame: Frame, decision: Decision) -> None:
        watch(frame, decision)
        for time, request in list(requests.items()):
            if frame.time >= time and core.request(request):
                del requests[time]

    try:
        return run_mission(rover_in_bends(RoughRover), config, seconds, ask, core)
    finally:
        core.close()
