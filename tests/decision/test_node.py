"""The decision node in process: plans that fail, maps that do not come, a new run."""

from __future__ import annotations

import pytest
from frames_by_hand import AWAY, nanoseconds
from maps import straight_plan
from node_bench import NodeBench

from rover_common.types import SAFE_COMMAND, Command
from rover_decision import node as decision_node
from rover_navigation.planner import Planner
from rover_navigation.types import Plan, PlanRequest


@pytest.fixture
def planner(monkeypatch):
    """Plans straight ahead, or fails."""

    class HandPlanner:
        fails = False
        made = 0  # or failed

        def plan(self, request: PlanRequest) -> Plan:
            self.made += 1
            if self.fails:
                raise ZeroDivisionError("no such thing")
            return straight_plan(stamp=request.stamp)

    planner = HandPlanner()
    monkeypatch.setattr(Planner, "plan", lambda _, request: planner.plan(request))
    return planner


@pytest.fixture(params=[True, False], ids=["lockstep", "live"])
def bench(ros, request, planner) -> NodeBench:
    return NodeBench(ros, use_sim_time=request.param)


def planned_frame(bench: NodeBench, planner) -> Command:
    """A frame that orders a plan, which is made before the next one."""
    made = planner.made
    command = bench.frame(map_age=0.0)
    bench.send_map(nanoseconds(bench.time))
    assert bench.ros.spin_until(lambda: planner.made > made)
    return command


def step_until(bench: NodeBench, planner, state: str) -> None:
    """Frames with plans until the mission is in a state."""
    for _ in range(20):
        planned_frame(bench, planner)
        if bench.states and bench.states[-1].state_name == state:
            return
    raise AssertionError(f"never {state}: {[report.state_name for report in bench.states]}")


def drive(bench: NodeBench, planner) -> None:
    while not planned_frame(bench, planner).throttle:
        assert bench.time < 5.0


def test_a_planner_that_raises_does_not_end_the_node(bench, planner):
    drive(bench, planner)
    planner.fails = True
    step_until(bench, planner, "HOLD")
    assert planned_frame(bench, planner) == SAFE_COMMAND
    assert bench.states[-1].reason == "holds: the planner failed"
    assert bench.ros.spin_until(lambda: int(bench.reported("plans_failed") or 0) > 0)
    planner.fails = False
    step_until(bench, planner, "FORWARD")


def test_a_map_that_never_comes_does_not_end_the_node(ros, planner, monkeypatch):
    """In lockstep the frames wait for it, for a while."""
    monkeypatch.setattr(decision_node, "PATIENCE", 0.2)
    bench = NodeBench(ros, use_sim_time=True)
    bench.frame(map_age=0.0)
    bench.send()
    assert bench.ros.spin_until(lambda: len(bench.commands) == 2)
    assert bench.commands[-1].brake == 1.0
    assert bench.ros.spin_until(lambda: bench.states[-1].state_name == "HOLD")
    assert bench.ros.spin_until(lambda: bench.reported("plans_failed") == "1")
    step_until(bench, planner, "FORWARD")


def test_frames_wait_for_the_map_in_lockstep_only(bench):
    lockstep = bench.node.get_parameter("use_sim_time").value
    bench.frame(map_age=0.0)
    map_stamp = nanoseconds(bench.time)
    bench.send()
    answered = bench.ros.spin_until(lambda: len(bench.commands) == 2, timeout=0.5)
    assert answered is not lockstep
    bench.send_map(map_stamp)
    assert bench.ros.spin_until(lambda: len(bench.commands) == 2)


def test_a_frame_of_a_new_run_is_not_decided_with_the_old_plan(bench, planner):
    drive(bench, planner)
    assert bench.frame(pose=AWAY).throttle
    bench.begin_run()
    for _ in range(4):
        assert bench.frame(pose=AWAY) == SAFE_COMMAND
    assert bench.ros.spin_until(lambda: bench.states[-1].run == 2)
    assert bench.states[-1].elapsed < 2.0


def test_a_reset_brakes_and_asks_the_bridge_for_a_new_run(bench):
    bench.frame()
    assert bench.call("reset").success
    for _ in range(3):
        command = bench.frame(pose=AWAY)
        assert (command.brake, command.throttle, command.new_run) == (1.0, 0.0, True)
    bench.begin_run()
    assert not bench.frame(pose=AWAY).new_run


def test_requests_say_what_the_mission_does(bench):
    bench.frame()
    assert bench.call("pause").message == "pause: PAUSED"
    assert not bench.call("pause").success
    assert bench.call("resume").success
    assert bench.call("return_home").message == "return_home: RETURN_HOME"
    assert not bench.call("start").success
