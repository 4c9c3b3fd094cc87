"""Faults come one after the other, each when the one before has no effect any more."""

from __future__ import annotations

from collections.abc import Callable

from rover_tools.chaos.executor import PATIENCE, Executor, Outcome
from rover_tools.chaos.losses import Loss
from rover_tools.chaos.plan import Fault, Kind

STOP = Fault(1, 8.0, Kind.STOP, "decision_node", 2.0)
KILL = Fault(2, 12.0, Kind.KILL, "bridge_node", 0.0)
START = 1000.0  # [s] of the clock
SAMPLES = Loss("samples", "2 of 6 samples became 0 of 6")


class Bench:
    """An executor with a mission by hand, and what came to pass, in its order."""

    def __init__(self, *faults: Fault) -> None:
        self.story: list[str] = []
        self.at_work = True
        self.lost: list[Loss] = []
        self.told: list[Outcome] = []
        self.executor = Executor(faults, self.begin, self, self.told.append)

    def begin(self, fault: Fault) -> Callable[[], None]:
        self.story.append(f"begin {fault.number}")
        return lambda: self.story.append(f"end {fault.number}")

    def mark(self) -> None:
        self.story.append("mark")

    def recovered(self) -> bool:
        return self.at_work

    def losses(self) -> list[Loss]:
        lost, self.lost = self.lost, []
        return lost

    def tick(self, *times: float) -> None:
        for time in times:
            self.executor.tick(START + time)


def test_a_fault_comes_at_its_time_and_lasts_as_planned():
    bench = Bench(STOP)
    bench.tick(0.0, 7.9)
    assert bench.story == []
    bench.tick(8.1, 10.0)
    assert bench.story == ["begin 1"]
    bench.tick(10.2)
    assert bench.story == ["begin 1", "end 1", "mark"]
    assert bench.told == []
    bench.tick(11.0, 12.0)
    (outcome,) = bench.told
    assert (outcome.fault, outcome.losses) == (STOP, [])
    assert round(outcome.began, 3) == 8.1
    assert round(outcome.ended, 3) == 10.2
    assert outcome.recovered is not None
    assert round(outcome.recovered, 3) == 0.8


def test_the_next_fault_waits_until_all_nodes_are_at_work():
    bench = Bench(STOP, KILL)
    bench.tick(0.0, 8.0, 10.0)
    bench.at_work = False
    bench.tick(12.0, 20.0)
    assert "begin 2" not in bench.story
    bench.at_work = True
    bench.tick(21.0, 21.1)
    assert bench.story[-1] == "begin 2"


def test_what_was_lost_is_told_with_the_fault():
    bench = Bench(STOP, KILL)
    bench.tick(0.0, 8.0, 10.0)
    bench.lost = [SAMPLES]
    bench.tick(11.0, 12.0, 12.1, 12.2)
    assert [outcome.losses for outcome in bench.told] == [[SAMPLES], []]


def test_nodes_that_do_not_work_again_are_a_loss():
    bench = Bench(STOP)
    bench.tick(0.0, 8.0, 10.0)
    bench.at_work = False
    bench.tick(10.0 + PATIENCE - 1.0)
    assert bench.told == []
    bench.tick(10.0 + PATIENCE)
    (outcome,) = bench.told
    assert outcome.recovered is None
    assert [loss.name for loss in outcome.losses] == ["recovery"]


def test_the_end_of_the_mission_ends_the_fault_and_the_plan():
    bench = Bench(STOP, KILL)
    bench.tick(0.0, 8.0)
    bench.lost = [SAMPLES]
    bench.executor.close(START + 9.0)
    assert bench.story == ["begin 1", "end 1", "mark"]
    assert [outcome.losses for outcome in bench.told] == [[SAMPLES]]
    bench.tick(12.0, 13.0)
    assert [outcome.fault for outcome in bench.executor.outcomes] == [STOP]


def test_a_mission_without_faults_is_left_alone():
    bench = Bench()
    bench.tick(0.0, 100.0)
    bench.executor.close(START + 101.0)
    assert (bench.story, bench.told) == ([], [])
