"""What deciding costs per frame, and what each plan costs.

Whole missions in one process without ROS. Plans are made in their thread as always, but the loop
waits for each before it goes on, so that no plan is timed while the simulator and perception take
the interpreter from it. `wall` is what a frame or a plan had to wait, `thread` what its thread
worked: on a busy machine the former counts other programs as well.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
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
from rover_tools.evaluation.closed_loop import Loop
from rover_tools.evaluation.results import Result
from rover_tools.evaluation.strategy import Strategy
from rover_tools.output import note, print_result, result_folder, write_result

PLAN_LIMIT = 50.0  # [ms] within which a plan should be made
COLUMNS = {"median": 50, "p99": 99, "max": 100}  # percentiles


class Stopwatch:
    """Times of something that is done again and again."""

    def __init__(self) -> None:
        self.laps: list[tuple[float, float]] = []  # [s] wall, thread

    @contextmanager
    def lap(self) -> Iterator[None]:
        """Time what is done inside."""
        wall, thread = time.perf_counter(), time.thread_time()
        try:
            yield
        finally:
            self.laps.append((time.perf_counter() - wall, time.thread_time() - thread))

    def result(self, name: str) -> Result:
        """Percentiles [ms]."""
        times = np.array(self.laps) * 1000.0
        return {
            f"{name}{clock}_ms_{column}": round(float(np.percentile(times[:, index], percent)), 3)
            for index, clock in enumerate(("", "_thread"))
            for column, percent in COLUMNS.items()
        }


class Costs:
    """Of all missions."""

    def __init__(self) -> None:
        self.frames, self.plans = Stopwatch(), Stopwatch()
        self.planned = threading.Event()  # unset from the request of a plan until it is made
        self.planned.set()


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
) -> None:
    """Run one mission in each world; write and print the costs of all of them together."""
    cv2.setNumThreads(1)
    folder = result_folder("bench-decision", out)
    costs = Costs()
    missions = []
    for world in worlds:
        missions.append(_run(world, strategy or Strategy(), fps, time_limit, costs))
        note(_line(missions[-1]))
    result = {**summary_of(costs), "missions": missions}
    write_result(folder, result)
    print_result(result, as_json, _table(result))
    note(f"figures in {folder}")


def _run(
    options: WorldOptions, strategy: Strategy, fps: float, time_limit: float, costs: Costs
) -> Result:
    """One mission to its end; its costs are added to the others'."""
    world = options.load()
    simulation = Simulation(world, options.seed, frame_steps_of(fps))
    config = strategy.config()
    frames, plans = len(costs.frames.laps), len(costs.plans.laps)
    loop = Loop(simulation, None, strategy.perception(), core=timed_core(config, costs))
    try:
        end = loop.run(START_TIME + time_limit, lambda _: costs.planned.wait())
    finally:
        loop.close()
    return {
        "world": world.name,
        "seed": options.seed,
        "strategy": str(strategy),
        "done": end.done,
        "time": round(simulation.time - START_TIME, 1),
        "frames": len(costs.frames.laps) - frames,
        "plans": len(costs.plans.laps) - plans,
        "plan_thread_ms_max": round(1000.0 * max(lap[1] for lap in costs.plans.laps[plans:]), 3),
    }


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
    ]
    return "\n".join(lines)


def _line(row: Result) -> str:
    return (
        f"{row['world']}, {row['strategy']}: {'home' if row['done'] else 'given up'} after "
        f"{row['time']} s, {row['frames']} frames, {row['plans']} plans"
    )
