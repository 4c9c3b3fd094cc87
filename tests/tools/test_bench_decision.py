"""The benchmark of decision: a short mission in a small canyon."""

import json
import math
import threading

import pytest

from rover_decision.config import DecisionConfig
from rover_perception.config import PerceptionConfig
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.world.generator import generate_world
from rover_tools.benchmarks.decision import COLUMNS, Costs, Stopwatch, TimedMission, TimedPlanner
from rover_tools.cli.main import main
from rover_tools.evaluation.closed_loop import Loop

SECONDS = 4.0
FRAMES_PER_MAP = math.ceil(PerceptionConfig().map_period * 12.5)
SMALL = ["bench", "decision", "--seeds", "2,3", "--size", "0.3", "--time-limit", str(SECONDS)]


def test_the_benchmark_has_times_of_frames_and_plans(tmp_path, capsys):
    assert main([*SMALL, "--json", "--out", str(tmp_path)]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result == json.loads((tmp_path / "result.json").read_text())
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


def test_the_table_is_for_people(tmp_path, capsys):
    assert main([*SMALL, "--out", str(tmp_path)]) == 0
    table = capsys.readouterr().out
    assert table.startswith("[ms]")
    assert "plans over 50 ms" in table
    assert table.count("given up after") == 2


def test_a_timed_mission_is_the_same_mission():
    world, config, costs = generate_world(2, 0.3), DecisionConfig(), Costs()
    planner = TimedPlanner(config.explorer, costs)
    timed = Loop(Simulation(world, 2, 4), mission=TimedMission(config, costs), planner=planner)
    made: list[list] = [[], []]
    for loop, decisions in zip((Loop(Simulation(world, 2, 4)), timed), made, strict=True):
        loop.run(START_TIME + SECONDS, decisions.append)
        loop.close()
    assert made[0] == made[1]
    assert len(made[0]) > SECONDS * 12
    assert len(costs.frames.laps) == len(made[0]) + 2  # two before the first step


def test_a_lap_that_goes_on_counts_once():
    watch = Stopwatch()
    with watch.lap():
        pass
    ((wall, _),) = watch.laps
    with watch.lap(goes_on=True):
        threading.Event().wait(0.02)
    ((more_wall, more_thread),) = watch.laps
    assert more_wall >= wall + 0.02
    assert more_thread < more_wall  # a thread that waits does not work


def test_a_plan_that_fails_keeps_nobody_waiting():
    costs = Costs()
    costs.planned.clear()
    with pytest.raises(AttributeError):
        TimedPlanner("tour", costs).plan(None)
    assert costs.planned.is_set()
