"""A mission brought to each of its states, in both phases, by frames alone."""

from __future__ import annotations

from collections.abc import Callable

from chart_model import Configuration, Phase
from frames_by_hand import AWAY, TILTED, DrivenMission, exploring, heading_home, over, rock
from maps import MIDDLE, straight_plan

from rover_common.geometry import Pose
from rover_decision.missions.sample_return.chart import State
from rover_decision.types import Request
from rover_navigation.monitors import CIRCLE_SECONDS

ROCK_AHEAD = (rock(MIDDLE.x + 3.0, MIDDLE.y),)


def stopped() -> DrivenMission:
    mission = exploring()
    mission.tick(ahead=0.8)
    return mission


def approaching() -> DrivenMission:
    mission = exploring()
    mission.tick(rocks=ROCK_AHEAD)
    return mission


def circling() -> DrivenMission:
    """Forward, and to the left of where it faces all the time."""
    mission = exploring()
    end = mission.time + 1.2 * CIRCLE_SECONDS
    while mission.time < end and mission.state is State.FORWARD:
        pose = Pose(MIDDLE.x + 0.1 * mission.time, MIDDLE.y, 0.05 * mission.time)
        left = straight_plan(pose=Pose(pose.x, pose.y, pose.yaw + 0.5))
        mission.tick(pose=pose, speed=1.0, plan=left)
    return mission


def picking_up(mission: DrivenMission) -> DrivenMission:
    mission.tick(pose=AWAY, near_sample=True)
    return mission


def stuck(mission: DrivenMission) -> DrivenMission:
    mission.tick_until(State.STUCK, 10.0, pose=AWAY)
    return mission


def tilted(mission: DrivenMission) -> DrivenMission:
    mission.tick(pose=Pose(AWAY.x, AWAY.y, 0.0, pitch=TILTED.pitch))
    return mission


def holding(mission: DrivenMission) -> DrivenMission:
    mission.wait(2.0)
    mission.tick(pose=AWAY)
    return mission


def paused(mission: DrivenMission) -> DrivenMission:
    mission.request(Request.PAUSE)
    mission.tick(pose=AWAY)
    return mission


def exploring_away() -> DrivenMission:
    mission = exploring()
    mission.tick(pose=AWAY)
    return mission


INTERRUPTED: dict[State, Callable[[DrivenMission], DrivenMission]] = {
    State.PICKUP: picking_up,
    State.STUCK: stuck,
    State.TILT: tilted,
    State.HOLD: holding,
    State.PAUSED: paused,
}


def paused_before_the_first_frame() -> DrivenMission:
    mission = DrivenMission()
    mission.request(Request.PAUSE)
    return mission


REACHED: dict[Configuration, Callable[[], DrivenMission]] = {
    Configuration(State.IDLE): DrivenMission,
    Configuration(State.FORWARD): exploring,
    Configuration(State.STOP): stopped,
    Configuration(State.ROCK_APPROACH): approaching,
    Configuration(State.CIRCLE): circling,
    Configuration(State.RETURN_HOME, Phase.HEADING_HOME): heading_home,
    Configuration(State.DONE, Phase.HEADING_HOME): over,
}
for _state, _interrupt in INTERRUPTED.items():
    REACHED[Configuration(_state)] = lambda interrupt=_interrupt: interrupt(exploring_away())
    REACHED[Configuration(_state, Phase.HEADING_HOME)] = lambda interrupt=_interrupt: interrupt(
        heading_home()
    )


def reach(at: Configuration) -> DrivenMission:
    """A mission in this configuration, which a frame has been decided in (but in IDLE)."""
    mission = REACHED[at]()
    assert mission.state is at.state
    return mission
