"""What deciding costs per frame, and what each plan costs.

Whole missions in one process without ROS. Plans are made in their thread as always, but the loop
waits for each before it goes on, so that no plan is timed while the simulator and perception take
the interpreter from it. `wall` is what a frame or a plan had to wait, `thread` what its thread
worked: on a busy machine the former counts other programs as well.

A long drive is a mission that searches for a sample which is not there, until its time is over: it
shows whether the costs grow with the map.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from rover_decision.core import DecisionCore, Mission
from rover_decision.missions.sample_return import make_planner
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.types import Decision, Frame
from rover_navigation.plan_scheduler import MakePlan
from rover_navigation.types import Plan, PlanRequest
from rover_simulator.options import WorldOptions
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import START_TIME, Simulation
from rover_tools.benchmarks.costs import COLUMNS, Costs
from rover_tools.evaluation.closed_loop import Loop
from rover_tools.evaluation.results import Result
from rover_tools.evaluation.strategy import Strategy
from rover_tools.output import note, print_result, result_folder, write_result

PLAN_LIMIT = 50.0  # [ms] within which a plan should be made
SPAN = 100.0  # [s] of a mission, over which costs are averaged
COMPARED = 3  # spans at the beginning and at the end of a long drive
# [m] In a corner of the world, behind the canyon's walls: nothing can see a sample there.
OUT_OF_SIGHT = (1.0, 1.0)


def timed_core(config: DecisionConfig, costs: Costs) -> DecisionCore:
    """A core with its frames and its plans timed; a frame's order of a plan is a part of it."""
    make_plan = make_planner(config).plan

    def timed_plan(request: PlanRequest) -> Plan:
        try:
            with costs.plans.lap():
                return make_plan(request)
        finally:
            costs.planned.set()

    return TimedCore(partial(SampleReturnMission, config), timed_plan, config.plan_delay, costs)


class TimedCore(DecisionCore):
    """Measures its steps; in lockstep."""

    def __init__(
        self, make_mission: Callable[[], Mission], make_plan: MakePlan, delay: float, costs: Costs
    ) -> None:
        super().__init__(make_mission, make_plan, delay, lockstep=True)
        self._costs = costs

    def step(self, frame: Frame) -> Decision:
        if frame.map_stamp == frame.stamp:
            self._costs.planned.clear()
        with self._costs.frames.lap():
            return super().step(frame)


def bench(
    worlds: Sequence[WorldOptions],
    strategy: Strategy | None,
    fps: float,
    time_limit: float,
    out: Path | None,
    as_json: bool,
    drive_on: bool = False,
) -> None:
    """Run one mission in each world; write and print the costs of all of them together.

    drive_on: long drives instead, for as long as the time limit says.
    """
    cv2.setNumThreads(1)
    folder = result_folder("bench-decision", out)
    costs = Costs()
    missions = []
    for world in worlds:
        own = Costs()
        missions.append(_run(world, strategy or Strategy(), fps, time_limit, own, drive_on))
        costs.frames.laps += own.frames.laps
        costs.plans.laps += own.plans.laps
        note(_line(missions[-1]))
    result = {**summary_of(costs), "missions": missions}
    write_result(folder, result)
    print_result(result, as_json, _table(result))
    note(f"figures in {folder}")


def _run(
    options: WorldOptions,
    strategy: Strategy,
    fps: float,
    time_limit: float,
    costs: Costs,
    drive_on: bool,
) -> Result:
    """One mission to its end, and what it costs."""
    world = options.load()
    config = strategy.config()
    if drive_on:
        world = replace(world, samples=np.array([OUT_OF_SIGHT]))
        config = replace(config, time_limit=10 * time_limit, search_limit=10 * time_limit)
    simulation = Simulation(world, options.seed, frame_steps_of(fps))
    ends = (START_TIME + SPAN * (number + 1) for number in range(math.floor(time_limit / SPAN)))
    end = next(ends, math.inf)

    def watch(_: Decision) -> None:
        nonlocal end
        costs.planned.wait()
        if simulation.time >= end:
            costs.mark_span()
            end = next(ends, math.inf)

    loop = Loop(simulation, None, strategy.perception(), core=timed_core(config, costs))
    try:
        last = loop.run(START_TIME + time_limit, watch)
    finally:
        loop.close()
    by_span = costs.frame_ms_by_span()
    return {
        "world": world.name,
        "seed": options.seed,
        "strategy": str(strategy),
        "done": last.done,
        "time": round(simulation.time - START_TIME, 1),
        "frames": len(costs.frames.laps),
        "plans": len(costs.plans.laps),
        "plan_thread_ms_max": round(1000.0 * max(lap[1] for lap in costs.plans.laps), 3),
        "frame_ms_by_100_s": by_span,
        "growth": _growth(by_span),
    }


def _growth(by_span: list[float]) -> float | None:
    """The costs of the last spans as a multiple of those of the first; None in a short mission."""
    if len(by_span) < 2 * COMPARED:
        return None
    return round(sum(by_span[-COMPARED:]) / sum(by_span[:COMPARED]), 2)


def summary_of(costs: Costs) -> Result:
    """Counts, times [ms] by both clocks, and the share [%] of plans beyond the limit."""
    slow = np.array(costs.plans.laps) * 1000.0 > PLAN_LIMIT
    wall, thread = (100.0 * slow.mean(axis=0)).tolist()
    return {
        "frames": len(costs.frames.laps),
        **costs.frames.result("tick"),
        "plans": len(costs.plans.laps),
        **costs.plans.result("plan"),
        "plan_over_50_ms_percent": round(wall, 2),
        "plan_thread_over_50_ms_percent": round(thread, 2),
    }


def _table(result: Result) -> str:
    lines = [f"{'[ms]':16}" + "".join(f"{column:>9}" for column in COLUMNS)]
    for title, name in (("frame", "tick"), ("plan", "plan")):
        for clock, infix in (("wall", ""), ("thread", "_thread")):
            times = (result[f"{name}{infix}_ms_{column}"] for column in COLUMNS)
            lines.append(f"{title + ', ' + clock:16}" + "".join(f"{time:9.3f}" for time in times))
    wall, thread = (result[f"plan{clock}_over_50_ms_percent"] for clock in ("", "_thread"))
    lines += [
        "",
        f"plans over {PLAN_LIMIT:.0f} ms: {wall} % by the wall's clock, {thread} % by the thread's",
        *map(_line, result["missions"]),
        *(_costs_line(row) for row in result["missions"] if row["growth"] is not None),
    ]
    return "\n".join(lines)


def _line(row: Result) -> str:
    return (
        f"{row['world']}, {row['strategy']}: {'home' if row['done'] else 'given up'} after "
        f"{row['time']} s, {row['frames']} frames, {row['plans']} plans"
    )


def _costs_line(row: Result) -> str:
    costs = " ".join(f"{ms:.1f}" for ms in row["frame_ms_by_100_s"])
    return (
        f"{row['world']}, thread [ms] per frame with its share of the plans, by {SPAN:.0f} s: "
        f"{costs}; the last {COMPARED} are {row['growth']:.2f} of the first {COMPARED}"
    )
