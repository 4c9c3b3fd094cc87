"""The states of classic B and the events that lead from one to another.

Once it goes for a rock, only the pickup, being stuck, or a circle ends that.
"""

from __future__ import annotations

from statemachine import HistoryState, StateChart
from statemachine import State as ChartState

from rover_decision.missions.sample_return.chart import State


class ClassicBChart(StateChart):
    """Explores, then heads home; both are interrupted by rocks and by being stuck."""

    class driving(ChartState.Compound):
        class phases(ChartState.Compound):
            class exploring(ChartState.Compound):
                forward = ChartState(initial=True, value=State.FORWARD)
                stop = ChartState(value=State.STOP)
                circle = ChartState(value=State.CIRCLE)

                blocked = forward.to(stop)
                cleared = stop.to(forward)
                recovered = circle.to(forward)

            class heading_home(ChartState.Compound):
                return_home = ChartState(initial=True, value=State.RETURN_HOME)

            phase = HistoryState()
            phase.to(exploring)
            finished = exploring.to(heading_home)
            circling = exploring.forward.to(exploring.circle)

        rock_approach = ChartState(value=State.ROCK_APPROACH)

        rock_seen = phases.to(rock_approach)
        circling = rock_approach.to(phases.exploring.circle)

    idle = ChartState(initial=True, value=State.IDLE)
    stuck = ChartState(value=State.STUCK)
    pickup = ChartState(value=State.PICKUP)
    paused = ChartState(value=State.PAUSED)
    done = ChartState(value=State.DONE)

    start = idle.to(driving.phases.exploring)
    stopped_moving = driving.to(stuck)
    recovered = stuck.to(driving.phases.phase)
    rock_reached = driving.to(pickup)
    picked_up = pickup.to(driving.phases.phase)
    pickup_failed = pickup.to(driving.rock_approach)
    arrived = driving.phases.heading_home.to(done)
    pause = paused.from_(idle, driving, stuck, done)
    resume = paused.to(driving.phases.phase)
