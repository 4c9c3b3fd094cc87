"""The benchmark of decision: a short mission in a small canyon."""

import json
import math
import threading
from contextlib import redirect_stdout
from io import StringIO
from types import SimpleNamespace
from typing import Any

import pytest

from rover_decision.missions.sample_return.config import DecisionConfig
from rover_perception.config import PerceptionConfig
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.world.generator import generate_world
from rover_tools.benchmarks import decision
from rover_tools.benchmarks.costs import COLUMNS, Costs, Stopwatch
from rover_tools.benchmarks.decision import timed_core
from rover_tools.cli.main import main
from rover_tools.evaluation.closed_loop import Loop

SECONDS = 4.0
FRAMES_PER_MAP = math.ceil(PerceptionConfig().map_period * 12.5)
SMALL = ["bench", "decision", "--seeds", "2,3", "--size", "0.3", "--time-limit", str(SECONDS)]


@pytest.fixture(scope="module")
def printed_and_written(tmp_path_factory) -> tuple[str, dict[str, Any]]:
    """The table and the figures of one run."""
    folder = tmp_path_factory.mktemp("bench")
    with redirect_stdout(StringIO()) as output:
        assert main([*SMALL, "--out", str(folder)]) == 0
    return output.getvalue(), json.loads((folder / "result.json").read_text())


def test_the_benchmark_has_times_of_frames_and_plans(printed_and_written):
    _, result = printed_and_written
    for name in ("tick_ms", "tick_thread_ms", "plan_ms", "plan_thread_ms"):
        median, p99, longest = (result[f"{name}_{column}"] for column in COLUMNS)
        assert 0 < median <= p99 <= longest
    for name in ("plan_over_50_ms_percent", "plan_thread_over_50_ms_percent"):
        assert 0 <= result[name] <= 100
    missions = result["missions"]
    assert [row["seed"] for row in missions] == [2, 3]
    assert not any(row["done"] for row in missions)
    for row in missions:
        assert row["frames"] == pytest.approx(SECONDS * 12.5, abs=3)
        assert row["plans"] == pytest.approx(SECONDS * 12.5 / FRAMES_PER_MAP, abs=2)
        assert row["plan_thread_ms_max"] <= result["plan_thread_ms_max"]
    for count in ("frames", "plans"):
        assert result[count] == sum(row[count] for row in missions)


def test_the_table_is_for_people(printed_and_written):
    table, _ = printed_and_written
    assert table.startswith("[ms]")
    assert "plans over 50 ms" in table
    assert table.count("given up after") == 2


def test_json_is_what_is_written(monkeypatch, tmp_path, capsys):
    def run(
        world: object, strategy: object, fps: float, limit: float, costs: Costs, drive_on: bool
    ) -> dict:
        with costs.frames.lap(), costs.plans.lap():
            pass
        row = dict.fromkeys(("world", "strategy", "done", "time", "frames", "plans"), 1)
        return {**row, "growth": None}

    monkeypatch.setattr(decision, "_run", run)
    assert main([*SMALL, "--json", "--out", str(tmp_path)]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads((tmp_path / "result.json").read_text())
    assert len(printed["missions"]) == 2


def test_a_timed_mission_is_the_same_mission():
    world, config, costs = generate_world(2, 0.3), DecisionConfig(), Costs()
    timed = Loop(Simulation(world, 2, 4), core=timed_core(config, costs))
    made: list[list] = [[], []]
    for loop, decisions in zip((Loop(Simulation(world, 2, 4)), timed), made, strict=True):
        loop.run(START_TIME + SECONDS, decisions.append)
        loop.close()
    assert made[0] == made[1]
    assert len(made[0]) > SECONDS * 12
    assert len(costs.frames.laps) == len(made[0]) + 2  # two before the first step


def test_a_long_drive_lasts_and_has_its_costs_by_spans(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(decision, "SPAN", 2.0)
    long = ["bench", "decision", "--long", "--seeds", "2", "--size", "0.3", "--time-limit", "13"]
    assert main([*long, "--out", str(tmp_path)]) == 0
    (row,) = json.loads((tmp_path / "result.json").read_text())["missions"]
    by_span = row["frame_ms_by_100_s"]
    assert len(by_span) == 6
    assert min(by_span) > 0
    assert row["growth"] == pytest.approx(sum(by_span[-3:]) / sum(by_span[:3]), abs=0.01)
    assert not row["done"]
    assert "the last 3 are" in capsys.readouterr().out


def test_the_costs_of_a_span_are_those_of_its_frames_and_plans():
    costs = Costs()
    costs.frames.laps = [(0.0, 0.001)] * 4
    costs.plans.laps = [(0.0, 0.010)]
    costs.mark_span()
    costs.frames.laps += [(0.0, 0.002)] * 2
    costs.plans.laps += [(0.0, 0.020)] * 2
    costs.mark_span()
    assert costs.frame_ms_by_span() == [1.0 + 10 / 4, 2.0 + 20.0]


def test_waiting_counts_by_the_wall_clock_only():
    watch = Stopwatch()
    with watch.lap():
        threading.Event().wait(0.02)
    ((wall, thread),) = watch.laps
    assert wall >= 0.02
    assert thread < wall


def test_a_plan_that_fails_ends_the_wait_for_it(monkeypatch):
    def fail(_: object) -> None:
        raise AttributeError

    monkeypatch.setattr(decision, "make_planner", lambda _: SimpleNamespace(plan=fail))
    handed: list = []
    monkeypatch.setattr(decision, "TimedCore", lambda *parts: handed.append(parts))
    costs = Costs()
    costs.planned.clear()
    timed_core(DecisionConfig(), costs)
    with pytest.raises(AttributeError):
        handed[0][1](None)
    assert costs.planned.is_set()
    assert len(costs.plans.laps) == 1
