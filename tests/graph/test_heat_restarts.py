"""Navigator and mission of the second robot are killed, started again, and end the mission."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator

import pytest
from heat_lane import lane
from waiting import holds

from rover_heat.mission.chart import State
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.report.heat_truth import MAZE, HeatTruth
from rover_tools.runner import heat_graph, mission_state
from rover_tools.runner.heat_graph import KEPT, HeatProcesses
from rover_tools.runner.node_heat_watch import SIMULATOR, StateReport

SEED, WAIT = 3, 60.0  # [s]
# [s] of wall time in which the simulator waits for a mission that was killed; longer than that
# waits for its navigator.
DEADLINE = 15.0


@pytest.fixture
def run(tmp_path, monkeypatch) -> Iterator[HeatProcesses]:
    monkeypatch.setattr(heat_graph, "ANSWER_DEADLINE", DEADLINE)
    lane().save(tmp_path / MAZE)
    with heat_graph.heat_graph(tmp_path, SEED, HeatSetup.of(deliver="at_once")) as run:
        run.processes.respawn(KEPT)
        run.watch.resume_simulator()
        yield run


def wait(run: HeatProcesses, reached: Callable[[StateReport], bool]) -> StateReport:
    """Until a report is as it should be; what ends is started again meanwhile."""

    def is_reached() -> bool:
        run.processes.check()
        return run.watch.newest is not None and reached(run.watch.newest)

    assert holds(is_reached, WAIT), run.watch.newest
    return run.watch.newest


def log_of(run: HeatProcesses, node: str) -> str:
    return (run.folder / "log" / f"{node}.log").read_text()


def test_a_mission_ends_well_though_both_nodes_were_killed(run):
    wait(run, lambda report: report.state is State.EXPLORING and report.sources_delivered == 1)
    for node in KEPT:
        before = run.watch.newest
        os.kill(run.processes.pid(node), signal.SIGKILL)
        wait(run, lambda _, node=node: "goes on with run 1" in log_of(run, node))
        after = wait(run, lambda report, at=before.elapsed: report.elapsed > at + 3.0)
        assert after.state not in (State.DONE, State.FAILED)
        assert after.sources_delivered == 1
        assert after.interrupts >= before.interrupts
    last = wait(run, lambda report: report.state in (State.DONE, State.FAILED))
    run.processes.end(SIMULATOR)
    truth = HeatTruth.load(run.folder).ticks[-1]
    assert (last.state, last.sources_delivered) == (State.DONE, 1)
    assert len(truth.launches) == 2
    assert truth.on_flat
    assert {path.name for path in (run.folder / mission_state.STATE).glob("*.state")} == {
        f"{node}.state" for node in KEPT
    }


def test_what_the_nodes_have_saved_goes_with_the_graph(tmp_path):
    lane().save(tmp_path / MAZE)
    with heat_graph.heat_graph(tmp_path, SEED, HeatSetup()) as run:
        run.watch.resume_simulator()
        wait(run, lambda report: report.state is State.EXPLORING)
        assert holds(lambda: any((tmp_path / mission_state.STATE).glob("*.state")), WAIT)
    assert not (tmp_path / mission_state.STATE).exists()
