"""The states of classic A and the events that lead from one to another.

A rock comes before all else but being stuck; the push comes before everything, and goes back to
where it came from.
"""

from __future__ import annotations

from statemachine import HistoryState, StateChart
from statemachine import State as ChartState

from rover_decision.missions.sample_return.chart import State


class ClassicAChart(StateChart):
    """Explores, then heads home; both are interrupted by rocks, by being stuck, and by pushes."""

    class driving(ChartState.Compound):
        class phases(ChartState.Compound):
            class exploring(ChartState.Compound):
                forward = ChartState(initial=True, value=State.FORWARD)
                stop = ChartState(value=State.STOP)

                blocked = forward.to(stop)
                cleared = stop.to(forward)

            class heading_home(ChartState.Compound):
                return_home = ChartState(initial=True, value=State.RETURN_HOME)

            phase = HistoryState(type="deep")
            phase.to(exploring)
            finished = exploring.to(heading_home)

        rock_approach = ChartState(value=State.ROCK_APPROACH)
        stuck = ChartState(value=State.STUCK)

        before_push = HistoryState(type="deep")
        before_push.to(phases)
        rock_seen = phases.to(rock_approach)
        rock_lost = rock_approach.to(phases.phase)
        stopped_moving = stuck.from_(phases, rock_approach)
        recovered = stuck.to(phases.phase)

    idle = ChartState(initial=True, value=State.IDLE)
    circle = ChartState(value=State.CIRCLE)
    pickup = ChartState(value=State.PICKUP)
    paused = ChartState(value=State.PAUSED)
    done = ChartState(value=State.DONE)

    start = idle.to(driving.phases.exploring)
    circling = driving.to(circle)
    recovered = circle.to(driving.before_push)
    rock_reached = driving.to(pickup)
    picked_up = pickup.to(driving.phases.phase)
    pickup_failed = pickup.to(driving.phases.phase)
    arrived = driving.phases.heading_home.to(done)
    pause = paused.from_(idle, driving, circle, done)
    resume = paused.to(driving.phases.phase)
