"""The states of the mission, one object each."""

from __future__ import annotations

from rover_heat.mission.chart import State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states.attempting_ramp import AttemptingRamp
from rover_heat.mission.states.exploring import Exploring
from rover_heat.mission.states.goal_navigation import GoalNavigation
from rover_heat.mission.states.hold import Hold
from rover_heat.mission.states.initializing import Initializing
from rover_heat.mission.states.launching import Launching
from rover_heat.mission.states.returning import Returning
from rover_heat.mission.states.standing import Standing
from rover_heat.mission.states.tilt_interrupt import TiltInterrupt
from rover_heat.mission.tick import HeatBehavior

RECOVERING = (State.TILT_INTERRUPT,)


def make_states(parts: HeatParts) -> dict[State, HeatBehavior]:
    """One object for each state of the chart."""
    approach = GoalNavigation(parts)
    return {
        State.INITIALIZING: Initializing(parts),
        State.EXPLORING: Exploring(parts),
        State.TILT_INTERRUPT: TiltInterrupt(parts),
        State.GOAL_NAVIGATION: approach,
        State.LAUNCHING: Launching(parts, approach),
        State.ATTEMPTING_RAMP: AttemptingRamp(parts),
        State.RETURNING: Returning(parts),
        State.DONE: Standing(parts, "the mission is over"),
        State.PAUSED: Standing(parts, "paused"),
        State.FAILED: Standing(parts, "failed"),
        State.HOLD: Hold(parts),
    }
