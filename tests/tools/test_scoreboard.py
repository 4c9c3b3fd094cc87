"""The scoreboard: which missions, what is kept, the command with missions made up."""

from __future__ import annotations

import json
import pickle
from contextlib import nullcontext
from types import SimpleNamespace
from unittest.mock import Mock

import numpy as np
import pytest
from scoreboard_rows import FILES, job_of, row_of, store_in
from tqdm import tqdm

from rover_common.geometry import Pose
from rover_simulator.world.generator import world_of_map
from rover_simulator.world.world import World
from rover_tools import progress
from rover_tools.cli.commands import scoreboard as command
from rover_tools.cli.main import main
from rover_tools.evaluation.mission_result import (
    RESULT_KEYS,
    MissionRun,
    mission_result,
)
from rover_tools.scoreboard import cluster
from rover_tools.scoreboard import run as scoreboard
from rover_tools.scoreboard.errors import ScoreboardError
from rover_tools.scoreboard.job import Ground, Job, make_jobs
from rover_tools.scoreboard.mission_run import ROW_KEYS, failed_row
from rover_tools.scoreboard.missions import CompletedMission


@pytest.fixture
def world() -> World:
    navigable = np.zeros((200, 200), bool)
    navigable[80:120, 95:105] = True
    samples = np.array([(96.5, 82.5), (103.5, 118.5), (96.5, 117.5)])
    return World("drawn", navigable, samples, Pose(100.0, 100.0, 0.0))


# Which missions


@pytest.fixture
def jobs_of(monkeypatch, tmp_path):
    """The jobs that a command line asks for."""

    def jobs_of(*arguments: str) -> list[Job]:
        asked: list[Job] = []
        monkeypatch.setattr(scoreboard, "run_scoreboard", lambda jobs, *_: asked.extend(jobs))
        assert main(["scoreboard", *arguments, "--out", str(tmp_path)]) == 0
        return asked

    return jobs_of


def test_defaults_are_a_few_generated_canyons(jobs_of):
    jobs = jobs_of()
    assert [(job.strategy, job.seed, job.group) for job in jobs] == [
        ("tour", seed, "generated") for seed in command.DEFAULT_WORLDS
    ]
    assert {(job.fps, job.time_limit, job.size) for job in jobs} == {(25.0, 900.0, 1.0)}


def test_worlds_and_map_with_each_strategy(tmp_path, world, jobs_of):
    world.save(tmp_path)
    options = ["--map", str(tmp_path / "map.png"), "--seeds", "8,9", "--fps", "12.5"]
    strategies = ["--strategies", "tour,classic_a+bearing,tour+breadcrumbs"]
    assert [job.name for job in jobs_of(*options, *strategies)] == [
        "map-8-tour", "map-8-classic_a+bearing", "map-9-tour", "map-9-classic_a+bearing",
    ]  # fmt: skip
    assert [job.name for job in jobs_of(*options, "--worlds", "1")] == [
        "generated-1-tour", "map-8-tour", "map-9-tour",
    ]  # fmt: skip


def test_a_map_travels_as_plain_data(tmp_path, world):
    world.save(tmp_path)
    path = tmp_path / "map.png"
    ground = Ground.load(path)
    there = world_of_map(path, 5)
    path.unlink()
    (job,) = make_jobs([], ground, [5], ["tour"], size=1.0, fps=25.0, time_limit=9.0)
    here = pickle.loads(pickle.dumps(job)).world()
    assert (here.name, here.start) == (there.name, there.start) == (job.world_name, there.start)
    assert np.array_equal(here.navigable, there.navigable)
    assert np.array_equal(here.samples, there.samples)


# What is kept


def test_only_what_is_missing_is_left(tmp_path):
    jobs = [job_of(seed=seed) for seed in (1, 2, 3)]
    store = store_in(tmp_path)
    assert store.missing(jobs) == jobs
    store.add(jobs[0], row_of(jobs[0]), FILES)
    store.add(jobs[1], failed_row(jobs[1], RuntimeError("no way")), None)
    assert store.missing(jobs) == jobs[1:]  # what failed is tried again
    store.add(jobs[1], row_of(jobs[1]), FILES)
    assert store.missing(jobs) == jobs[2:]
    assert [entry.name for entry in store.entries()] == [job.name for job in jobs[:2]]


def test_a_file_that_was_being_written_does_not_count(tmp_path):
    store = store_in(tmp_path)
    (tmp_path / "missions" / ".generated-1-tour.json.77").write_text("{")
    assert store.missing([job_of()]) == [job_of()]


@pytest.mark.parametrize(
    "other",
    [
        job_of(size=1.0),
        job_of(fps=25.0),
        job_of(time_limit=60.0),
        job_of(seed=2, fps=25.0),  # another mission, yet not to be in one table with the first
    ],
)
def test_missions_of_other_settings_are_not_mixed(tmp_path, other):
    store = store_in(tmp_path)
    store.add(job_of(), row_of(job_of()), FILES)
    with pytest.raises(ScoreboardError, match="choose another --out"):
        store.missing([other])


def test_a_broken_file_is_one_sentence(tmp_path):
    store = store_in(tmp_path)
    (tmp_path / "missions" / "generated-1-tour.json").write_text("[]")
    with pytest.raises(ScoreboardError, match=r"generated-1-tour\.json is not a mission"):
        store.entries()


# The result


def test_the_result_of_a_mission_has_the_same_keys_however_it_ended(world):
    track = np.array([(world.start.x + 3.0, world.start.y + 4.0)])
    result = mission_result(
        world, "tour", 1, done=False, run=MissionRun(60.04, 75.52, 3, 2, track), grid=None,
        rocks=(), recoveries=1, wall_seconds=9.99,
    )  # fmt: skip
    assert tuple(result) == RESULT_KEYS
    assert (result["time"], result["distance"], result["home_distance"]) == (60.0, 75.5, 5.0)
    assert (result["samples_collected"], result["samples_total"]) == (1, 3)
    assert result["reason"] == "the time is up"
    assert tuple(failed_row(job_of(), RuntimeError("no way"))) == ROW_KEYS


# The command, with missions made up


@pytest.fixture
def made_up(monkeypatch):
    """Missions that do not run: those of seed 2 raise. The names of those asked for."""
    monkeypatch.setattr(tqdm, "monitor_interval", 0)  # its thread would outlive the test
    asked: list[str] = []

    def run_all(_, jobs, run, on_start, while_waiting):
        on_start("the first missions have started")
        for job in jobs:
            asked.append(job.name)
            while_waiting()
            good = job.seed != 2
            yield job, CompletedMission(row_of(job), FILES) if good else ValueError("too steep")

    monkeypatch.setattr(scoreboard, "cluster", lambda *_: nullcontext())
    monkeypatch.setattr(scoreboard, "run_all", run_all)
    return asked


def test_a_mission_that_raises_is_a_row_and_an_exit_code(tmp_path, made_up, capsys):
    arguments = ["scoreboard", "--worlds", "1-3", "--out", str(tmp_path), "--json"]
    assert main(arguments) == 1
    output = capsys.readouterr()
    assert "the first missions have started" in output.err
    rows = json.loads(output.out)
    assert [row["reason"] for row in rows] == ["home", "failed: ValueError: too steep", "home"]
    assert all(set(row) == set(ROW_KEYS) for row in rows)
    assert "1 of 3 missions failed" in output.err
    assert "too steep" in (tmp_path / "report.html").read_text()


def test_a_second_run_runs_failed_and_new_missions_only(tmp_path, made_up, capsys):
    assert main(["scoreboard", "--worlds", "1,2", "--out", str(tmp_path)]) == 1
    made_up.clear()
    assert main(["scoreboard", "--worlds", "1-3", "--out", str(tmp_path), "--json"]) == 1
    assert made_up == ["generated-2-tour", "generated-3-tour"]
    made_up.clear()
    capsys.readouterr()
    assert main(["scoreboard", "--worlds", "1", "--out", str(tmp_path), "--json"]) == 0
    assert made_up == []
    output = capsys.readouterr()
    assert [row["seed"] for row in json.loads(output.out)] == [1]  # what was asked for
    assert "1 missions, 1 already completed" in output.err


def test_progress_is_shown_while_no_mission_is_over(tmp_path, made_up, capsys, monkeypatch):
    monkeypatch.setattr(progress, "LINE_SECONDS", 0.0)
    assert main(["scoreboard", "--worlds", "1,3", "--out", str(tmp_path)]) == 0
    shown = [line for line in capsys.readouterr().err.splitlines() if "completed " in line]
    assert [line.split("completed ")[1] for line in shown] == [
        f"{completed}/2 missions" for completed in (0, 1, 1, 2)
    ]


def test_waiting_for_missions_is_interrupted_every_second(monkeypatch):
    job = job_of()
    future = Mock(**{"exception.return_value": None, "result.return_value": "over"})
    client = Mock(**{"submit.return_value": future, "nthreads.return_value": {}})
    answers = [TimeoutError, TimeoutError, SimpleNamespace(done={future})]

    def wait(*_):
        answer = answers.pop(0)
        if isinstance(answer, type):
            raise answer
        return answer

    monkeypatch.setattr(cluster, "wait", wait)
    ticks: list[int] = []
    outcomes = cluster.run_all(
        client, [job], run=Mock(), while_waiting=lambda: ticks.append(len(answers))
    )
    assert list(outcomes) == [(job, "over")]
    assert ticks == [2, 1, 0]


def test_the_table_is_printed(tmp_path, made_up, capsys):
    assert main(["scoreboard", "--worlds", "1,3", "--out", str(tmp_path)]) == 0
    assert "2 of 2 (34-100 %)" in capsys.readouterr().out
