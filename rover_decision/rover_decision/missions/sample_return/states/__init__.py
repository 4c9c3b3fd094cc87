"""The states of the mission, one object each."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.states.circle import Circle
from rover_decision.missions.sample_return.states.forward import Forward
from rover_decision.missions.sample_return.states.hold import Hold
from rover_decision.missions.sample_return.states.pickup import Pickup
from rover_decision.missions.sample_return.states.return_home import ReturnHome
from rover_decision.missions.sample_return.states.rock_approach import RockApproach
from rover_decision.missions.sample_return.states.standing import Standing
from rover_decision.missions.sample_return.states.stop import Stop
from rover_decision.missions.sample_return.states.stuck import Stuck
from rover_decision.missions.sample_return.states.tilt import Tilt
from rover_decision.missions.sample_return.tick import StateBehavior
from rover_decision.trouble import Limits
from rover_navigation.recovery import RecoverySequence

GAP_SECONDS = 1.0  # [s] between two frames: the rover drove blindly
JUMP = 3.0  # [m] between two frames: somebody has moved it


def make_states(
    config: DecisionConfig, parts: Parts, drivers: Drivers
) -> dict[State, StateBehavior]:
    """One object for each state of the chart."""
    limits = Limits(config.tilt_limit, GAP_SECONDS, JUMP, config.plan_max_age, config.plan_max_age)
    actuation = parts.actuation
    exploring = (limits, drivers, parts, config)
    return {
        State.IDLE: Standing("waits for the first frame", Event.start),
        State.FORWARD: Forward(*exploring),
        State.STOP: Stop(*exploring),
        State.CIRCLE: Circle(*exploring),
        State.ROCK_APPROACH: RockApproach(limits, parts.completion, actuation, config.rock_range),
        State.PICKUP: Pickup(actuation.vehicle.standing_speed),
        State.STUCK: Stuck(RecoverySequence(actuation, parts.scale.clear_distance), parts),
        State.TILT: Tilt(parts.safe_poses, parts.blocked, actuation),
        State.HOLD: Hold(limits),
        State.RETURN_HOME: ReturnHome(limits, drivers, parts, config.home_radius),
        State.DONE: Standing("the mission is over"),
        State.PAUSED: Standing("paused"),
    }
