"""What must hold for the chart, whatever its arrows are: properties of groups of states."""

from __future__ import annotations

from collections.abc import Callable

from chart_model import EXPLORING, START, ChartModel, Configuration, Phase

from rover_decision.missions.sample_return.chart import Event, State

Rule = Callable[[ChartModel], bool]
RULES: list[Rule] = []

DRIVING = EXPLORING | {State.RETURN_HOME}
RECOVERING = frozenset({State.STUCK, State.TILT})
PLANNING = (Event.planner_failed, Event.plan_stale, Event.map_stale)
# what interrupts a mission, with the state for it and what ends it
INTERRUPTIONS = {
    Event.rock_reached: (State.PICKUP, (Event.picked_up, Event.pickup_failed)),
    Event.stopped_moving: (State.STUCK, (Event.recovered,)),
    Event.tilted: (State.TILT, (Event.recovered,)),
    Event.input_gap: (State.HOLD, (Event.inputs_restored,)),
    Event.pause: (State.PAUSED, (Event.resume,)),
}
SIGHTS = {Event.blocked, Event.cleared, Event.rock_seen, Event.rock_lost, Event.circling}
FIRST = {Phase.EXPLORING: State.FORWARD, Phase.HEADING_HOME: State.RETURN_HOME}
EXPLORER = Configuration(State.FORWARD)
HOMEWARD = Configuration(State.RETURN_HOME, Phase.HEADING_HOME)
DRIVERS = [Configuration(state) for state in EXPLORING] + [HOMEWARD]


def rule(function: Rule) -> Rule:
    RULES.append(function)
    return function


@rule
def a_mission_begins_by_exploring(chart: ChartModel) -> bool:
    return chart.after(START, Event.start) == EXPLORER


@rule
def heading_home_is_never_lost(chart: ChartModel) -> bool:
    """No sequence of events leads from it back to exploring."""
    return all(at.phase is Phase.HEADING_HOME for at in chart.paths(HOMEWARD))


@rule
def an_interruption_comes_before_all_else(chart: ChartModel) -> bool:
    """From each state that drives, in both phases."""
    return all(
        chart.after(at, event) == Configuration(state, at.phase)
        for at in DRIVERS
        for event, (state, _) in INTERRUPTIONS.items()
    )


@rule
def an_interruption_returns_to_the_phase_that_it_interrupted(chart: ChartModel) -> bool:
    return all(
        chart.state_after(at, event, end) is FIRST[at.phase]
        for at in DRIVERS
        for event, (_, ends) in INTERRUPTIONS.items()
        for end in ends
    )


@rule
def exploring_without_planning_holds(chart: ChartModel) -> bool:
    """Until the inputs are restored."""
    return all(
        chart.after(at, trouble).state is State.HOLD
        and chart.after(at, trouble, Event.inputs_restored) == EXPLORER
        for at in DRIVERS
        if at.phase is Phase.EXPLORING
        for trouble in PLANNING
    )


@rule
def heading_home_needs_no_planning(chart: ChartModel) -> bool:
    return all(chart.after(HOMEWARD, trouble) == HOMEWARD for trouble in PLANNING)


@rule
def exploring_ends_by_heading_home_and_that_at_home(chart: ChartModel) -> bool:
    return all(
        chart.after(at, Event.finished) == HOMEWARD
        and chart.state_after(at, Event.finished, Event.arrived) is State.DONE
        for at in DRIVERS
        if at.phase is Phase.EXPLORING
    )


@rule
def exploring_follows_what_it_sees(chart: ChartModel) -> bool:
    """To the same state from all that drive on, and back to driving ahead."""
    ahead = {Configuration(State.FORWARD), Configuration(State.CIRCLE)}
    standing = Configuration(State.STOP)
    to_rock = Configuration(State.ROCK_APPROACH)
    return (
        all(chart.after(at, Event.blocked, Event.cleared) == EXPLORER for at in ahead)
        and all(chart.after(at, Event.blocked) == standing for at in ahead)
        and all(chart.after(at, Event.rock_seen) == to_rock for at in {*ahead, standing})
        and chart.after(to_rock, Event.rock_lost) == EXPLORER
        and chart.state_after(EXPLORER, Event.circling) is State.CIRCLE
        and chart.after(EXPLORER, Event.circling, Event.recovered) == EXPLORER
    )


@rule
def an_approach_is_not_stopped_by_the_ground(chart: ChartModel) -> bool:
    """A rock stands before a wall: ROCK_APPROACH looks for itself, and drives by sight."""
    to_rock = Configuration(State.ROCK_APPROACH)
    others = SIGHTS - {Event.rock_lost} | {Event.recovered}
    return all(chart.after(to_rock, event) == to_rock for event in others)


@rule
def events_of_another_state_change_nothing(chart: ChartModel) -> bool:
    """What ends an interruption, starts a mission or ends it says nothing to one that drives."""
    ends = {end for _, ends in INTERRUPTIONS.values() for end in ends} | {
        Event.start,
        Event.gave_up,
    }
    quiet = {
        State.FORWARD: ends | {Event.cleared, Event.rock_lost, Event.arrived},
        State.STOP: ends | {Event.blocked, Event.circling, Event.rock_lost, Event.arrived},
        State.CIRCLE: ends - {Event.recovered}
        | {Event.cleared, Event.circling, Event.rock_lost, Event.arrived},
        State.ROCK_APPROACH: ends | {Event.arrived},
        State.RETURN_HOME: ends | {Event.finished},
    }
    return all(
        chart.after(at, event) == at for at in DRIVERS for event in quiet[at.state]
    )  # fmt: skip


@rule
def sights_mean_nothing_outside_of_exploring(chart: ChartModel) -> bool:
    return all(
        chart.after(at, sight) == at
        for at in chart.paths()
        if at.state not in EXPLORING
        for sight in SIGHTS
    )


@rule
def a_pause_holds_everything_but_the_arm(chart: ChartModel) -> bool:
    """Also what is interrupted already; afterwards it goes on in its phase."""
    going_on = {at for at in chart.paths() if at.state not in (State.PICKUP, State.PAUSED)}
    return all(
        chart.state_after(at, Event.pause) is State.PAUSED
        and chart.state_after(at, Event.pause, Event.resume) is FIRST[at.phase]
        for at in going_on
    ) and all(chart.after(at, Event.pause) == at for at in set(chart.paths()) - going_on)


@rule
def only_resume_ends_a_pause(chart: ChartModel) -> bool:
    return _stays(chart, State.PAUSED, unless={Event.resume})


@rule
def only_the_arm_ends_a_pickup(chart: ChartModel) -> bool:
    return _stays(chart, State.PICKUP, unless={Event.picked_up, Event.pickup_failed})


@rule
def a_recovery_is_only_paused_ended_or_given_up(chart: ChartModel) -> bool:
    ends = {Event.recovered, Event.pause}
    return _stays(chart, State.TILT, unless=ends) and _stays(
        chart, State.STUCK, unless=ends | {Event.gave_up}
    )


@rule
def a_hold_is_only_paused_ended_or_given_up(chart: ChartModel) -> bool:
    return _stays(chart, State.HOLD, unless={Event.inputs_restored, Event.pause, Event.gave_up})


@rule
def nothing_but_its_start_moves_an_idle_mission(chart: ChartModel) -> bool:
    return _stays(chart, State.IDLE, unless={Event.start, Event.pause})


@rule
def a_mission_that_is_over_stays_over(chart: ChartModel) -> bool:
    return _stays(chart, State.DONE, unless={Event.pause})


@rule
def what_does_not_help_is_given_up_for_home(chart: ChartModel) -> bool:
    """However the rover came to hold, or to be stuck."""
    return all(
        chart.after(at, Event.gave_up) == HOMEWARD
        for at in chart.paths()
        if at.state in (State.HOLD, State.STUCK)
    )


@rule
def only_a_rover_that_heads_home_arrives(chart: ChartModel) -> bool:
    return all(
        chart.after(at, event).state is not State.DONE or at.state is State.DONE
        for at in chart.paths()
        for event in Event
        if (at, event) != (HOMEWARD, Event.arrived)
    )


@rule
def every_state_is_reachable(chart: ChartModel) -> bool:
    """And every interruption in either phase."""
    interrupted = {state for state, _ in INTERRUPTIONS.values()}
    both = {Configuration(state, phase) for state in interrupted for phase in Phase}
    reached = set(chart.paths())
    return both <= reached and {at.state for at in reached} == set(State)


@rule
def home_can_be_reached_from_everywhere(chart: ChartModel) -> bool:
    homeward = {at for at in chart.paths() if at.state is State.DONE}
    while True:
        nearer = {
            at for at in chart.paths() if any(chart.after(at, event) in homeward for event in Event)
        }
        if nearer <= homeward:
            return set(chart.paths()) == homeward
        homeward |= nearer


def _stays(chart: ChartModel, state: State, unless: set[Event]) -> bool:
    """Whether nothing leads out of a state but these events."""
    return all(
        chart.after(at, event) == at
        for at in chart.paths()
        if at.state is state
        for event in set(Event) - unless
    )
