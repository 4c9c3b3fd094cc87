"""What holds at every frame of a mission in which everything goes wrong at times."""

from __future__ import annotations

from itertools import pairwise

from chart_model import EXPLORING
from frames_by_hand import CONFIG
from rough_missions import run_rough_mission

from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.states import GAP_SECONDS
from rover_decision.types import Decision, Frame

AT_REST = {State.IDLE, State.DONE, State.PAUSED, State.HOLD}


def test_every_frame_keeps_the_rules():
    history: list[tuple[Frame, Decision]] = []
    last = run_rough_mission(CONFIG, 80.0, lambda *both: history.append(both))
    states = [decision.state for _, decision in history]
    wanted = {State.FORWARD, State.PICKUP, State.TILT, State.STUCK, State.HOLD, State.RETURN_HOME}
    assert wanted <= set(states)
    assert last.progress.recoveries > 2
    for frame, decision in history:
        command, vehicle = decision.command, frame.vehicle
        if decision.state in AT_REST or vehicle.picking_up:
            assert command == SAFE_COMMAND
        if command.pickup:
            assert vehicle.near_sample
            assert abs(vehicle.speed) < 0.2
            assert command.throttle == command.steering_angle == 0.0
    for (before, was), (frame, decision) in pairwise(history):
        gap = frame.time - before.time > GAP_SECONDS
        if gap and was.state in EXPLORING | {State.RETURN_HOME}:
            assert decision.state in (State.HOLD, State.TILT)
    homeward = states[states.index(State.RETURN_HOME) :]
    assert not set(homeward) & EXPLORING
