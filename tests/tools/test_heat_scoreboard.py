"""Heat missions on the scoreboard: which ones, their table and page, the command."""

from __future__ import annotations

import json
import pickle
from contextlib import nullcontext

import pytest
from heat_runs import MAZE, result_of
from tqdm import tqdm

from burger_simulator.options import BurgerOptions
from burger_simulator.world.families import FAMILIES
from rover_tools.cli.heat import options as cli
from rover_tools.cli.main import main
from rover_tools.evaluation import heat_setup
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.scoreboard import run as scoreboard
from rover_tools.scoreboard.board import as_text, summaries
from rover_tools.scoreboard.heat_acceptance import acceptance_table
from rover_tools.scoreboard.heat_board import HEAT_BOARD
from rover_tools.scoreboard.heat_job import HeatJob, make_heat_jobs
from rover_tools.scoreboard.heat_run import HEAT_ROW_KEYS, failed_heat_row
from rover_tools.scoreboard.heat_table import HeatSummary
from rover_tools.scoreboard.missions import CompletedMission
from rover_tools.scoreboard.report import write_report
from rover_tools.scoreboard.store import Entry

FILES = {".svg": b"<svg/>", ".csv": b"time\n", ".html": b"<!doctype html>"}


def row_of(job: HeatJob, **changes) -> dict:
    """A success, in 250 s."""
    row = result_of() | {"world": job.world_name, "seed": job.seed, "times_real_time": 8.0}
    costs = {"ticks": 5000, "tick_ms_p99": 4.0, "tick_ms_max": 9.0, "memory_mb": 200.0}
    return row | costs | {"parameters": job.setup.label} | changes


def entry_of(seed: int, **changes) -> Entry:
    job = HeatJob(HeatSetup(), seed, "challenge")
    return Entry(job.name, job.settings(), False, row_of(job, **changes))


def failed_entry(seed: int) -> Entry:
    job = HeatJob(HeatSetup(), seed, "challenge")
    return Entry(job.name, job.settings(), True, failed_heat_row(job, ValueError("too warm")))


# Which missions


@pytest.fixture
def jobs_of(monkeypatch, tmp_path):
    """The jobs that a command line asks for."""

    def jobs_of(*arguments: str) -> list[HeatJob]:
        asked: list[HeatJob] = []
        monkeypatch.setattr(scoreboard, "run_scoreboard", lambda jobs, *_: asked.extend(jobs))
        assert main(["heat", "scoreboard", *arguments, "--out", str(tmp_path)]) == 0
        return asked

    return jobs_of


def test_each_preset_runs_in_each_maze(jobs_of):
    names = [job.name for job in jobs_of("--worlds", "1,2", "--preset", "heat,reference")]
    assert names == [
        "challenge-1-heat", "challenge-1-reference", "challenge-2-heat", "challenge-2-reference",
    ]  # fmt: skip


def test_a_variant_is_in_the_name_and_on_the_robot(jobs_of):
    faults = ["--thermal-rate", "1", "--offset", "-2.5", "--dead-sensor", "2", "--box"]
    (job,) = jobs_of("--worlds", "3", *faults, "--scan-rate", "5", "--thermal-delay", "0.35")
    options = job.setup.options
    assert (options.scan_rate, options.thermal_rate, options.thermal_delay) == (5.0, 1.0, 0.35)
    assert (options.thermal_offset_1, options.thermal_offset_2) == (-2.5, -2.5)
    assert (options.thermal_dead, options.box_body) == (2, True)
    assert job.setup.label == (
        "heat+scan-rate-5+thermal-rate-1+thermal-delay-0.35+dead-sensor-2+offset--2.5+box-1"
    )
    assert job.setup.config == HeatSetup().config  # the mission is told of none of it


def test_the_robot_is_built_as_the_parameters_say(jobs_of):
    (job,) = jobs_of("--worlds", "1", "--preset", "page", "--time-limit", "300")
    options, config = job.setup.options, job.setup.config
    assert options.thermal_yaw_1 == config.thermal_yaw_1 == 0.5236
    assert options.thermal_yaw_2 == config.thermal_yaw_2 == -0.5236
    assert config.time_limit == 300.0
    assert job.settings()["changed"] == {
        "thermal_yaw_1": 0.5236, "thermal_yaw_2": -0.5236, "time_limit": 300.0,
    }  # fmt: skip


def test_a_file_of_parameters_takes_the_presets_place(jobs_of, tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text("/**/heat_node:\n  ros__parameters:\n    payloads: 2\n")
    arguments = ["--worlds", "1", "--params", str(file), "--preset", "heat,reference"]
    assert [(job.name, job.setup.config.payloads) for job in jobs_of(*arguments)] == [
        ("challenge-1-mine", 2)
    ]


def test_a_saved_maze_takes_the_place_of_generated_ones(jobs_of, tmp_path):
    MAZE.save(tmp_path / "room.yaml")
    jobs = jobs_of("--worlds", "1-2", "--world", str(tmp_path / "room.yaml"))
    assert [job.name for job in jobs] == ["room-1-1-heat", "room-1-2-heat"]
    assert pickle.loads(pickle.dumps(jobs[0])).world() == MAZE
    shas = {job.settings()["maze_sha256"] for job in jobs}
    assert len(shas) == 1
    assert None not in shas


def test_what_cannot_be_is_refused(capsys, tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("/**/heat_node:\n  ros__parameters:\n    stand_off: 9.0\n")
    assert main(["heat", "scoreboard", "--params", str(file), "--out", str(tmp_path)]) == 1
    assert "stand_off: 9.0 is not within" in capsys.readouterr().err
    assert main(["heat", "scoreboard", "--preset", "warm"]) == 2
    assert main(["heat", "mission", "--family", "huge"]) == 2


def test_names_on_the_command_line_are_those_of_the_simulator():
    assert tuple(FAMILIES) == cli.FAMILIES
    assert heat_setup.PRESETS == cli.PRESETS
    for options in heat_setup.VARIANTS.values():
        assert all(hasattr(BurgerOptions, name) for name in options)


# Table and page


def test_summary_by_hand():
    entries = [
        entry_of(1),
        entry_of(2, success=False, sources_found=1, delivered=1, time=450.0, contacts=2),
        entry_of(3, success=False, sources_false=1, launches_wrong=1, early_ascent=0.16),
        entry_of(4, stop_seconds_max=0.31, ramp_done=None),
        entry_of(5, stop_seconds_max=None, done=False, ramp_done=False, success=False),
        failed_entry(6),
    ]
    summary = HeatSummary.of("heat", "challenge", entries)
    counts = {name: (share.count, share.total) for name, share in summary.shares.items()}
    assert counts == {
        "success": (2, 6), "all sources found": (4, 6), "sources found": (9, 10),
        "none false": (4, 6), "all delivered": (4, 6), "launches right": (4, 6),
        "no early ascent": (4, 6), "stops in time": (4, 6), "ramp done": (3, 5),
        "launches standing": (5, 6), "no contact": (4, 6), "one contact at most": (4, 6),
        "in time": (5, 6), "done": (4, 6),
    }  # fmt: skip
    assert (summary.missions, summary.failed) == (6, 1)
    assert summary.spreads["time [s]"][0].worst == 450.0
    assert summary.spreads["contacts"][0].mean == pytest.approx(0.4)
    text = as_text(summaries(HEAT_BOARD, entries), HEAT_BOARD.legend)
    assert "2 of 6 (10-70 %)" in text
    assert "6, 1 failed" in text
    assert "290 / 250 / 450" in text


def test_the_page_shows_each_mission(tmp_path):
    entries = [entry_of(1), entry_of(2, success=False, contacts=3), failed_entry(3)]
    write_report(tmp_path, HEAT_BOARD, entries, summaries(HEAT_BOARD, entries))
    page = (tmp_path / "report.html").read_text()
    for text in ("challenge-1", "3 contacts", "failed: ValueError: too warm", "1 of 3 (6-79 %)"):
        assert text in page
    assert page.count("<img") == 2
    columns = len(HEAT_BOARD.headings)
    assert all(len(HEAT_BOARD.cells(entry)) == columns for entry in entries)


def criteria_missed(*entries: Entry) -> set[str]:
    """The figures of the table that carry the mark."""
    lines = acceptance_table([HeatSummary.of("heat", "challenge", entries)]).splitlines()
    return {
        line.split("|")[1].strip() for line in lines if line.startswith("|") and "**No**" in line
    }


@pytest.mark.parametrize(
    ("changes", "missed"),
    [
        ({}, set()),
        ({"stop_seconds_max": None, "walls_right": None, "pose_rmse": None}, set()),
        ({"success": False}, {"whole mission: success"}),
        ({"sources_found": 1}, {"all sources found, each within 0.15 m",
                                "sources found within 0.15 m"}),
        ({"sources_false": 1}, {"no false source"}),
        ({"launches_wrong": 1}, {"each payload at a stand-off pose, facing, standing"}),
        ({"launches_moving": 1}, {"no launch while moving"}),
        ({"early_ascent": 0.16}, {"no early ascent: 0.15 m beyond the foot at most"}),
        ({"stop_seconds_max": 0.35}, {"stands within 0.3 s of each interrupt"}),
        ({"ramp_done": False}, {"ramp: stands on top, nothing touched, payload released"}),
        ({"contacts": 1}, {"no contact"}),
        ({"contacts": 2}, {"no contact", "one contact at most"}),
        ({"walls_right": 96.0}, {"map: cells within 0.05 m of a wall [%]"}),
        ({"pose_rmse": 0.031}, {"pose error, rms [cm]"}),
        ({"time": 481.0}, {"time [s]"}),
        ({"in_time": False}, {"ended before the time limit"}),
        ({"times_real_time": 4.9}, {"times real time, one core"}),
        ({"tick_ms_p99": 10.5}, {"a tick's time, 99 % [ms]"}),
    ],
)  # fmt: skip
def test_the_acceptance_table_marks_what_is_not_met(changes, missed):
    assert criteria_missed(entry_of(1, **changes)) == missed


def test_the_acceptance_table_has_a_column_for_each_set_of_parameters(tmp_path):
    reference = HeatJob(HeatSetup("reference"), 1, "challenge")
    row = row_of(reference, success=False)
    entries = [entry_of(1), failed_entry(2),
               Entry(reference.name, reference.settings(), False, row)]  # fmt: skip
    write_report(tmp_path, HEAT_BOARD, entries, summaries(HEAT_BOARD, entries))
    table = (tmp_path / "acceptance.md").read_text()
    assert "| heat, challenge: 2 missions " in table
    assert "| reference, challenge: 1 missions " in table
    assert "| 1 of 2 (9-91 %) **No** " in table


# The command, with missions made up


def test_each_mission_is_a_row_and_a_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(tqdm, "monitor_interval", 0)  # its thread would outlive the test

    def run_all(_, jobs, run, on_start, while_waiting):
        for job in jobs:
            good = job.seed != 2
            yield job, CompletedMission(row_of(job), FILES) if good else ValueError("too warm")

    monkeypatch.setattr(scoreboard, "cluster", lambda *_: nullcontext())
    monkeypatch.setattr(scoreboard, "run_all", run_all)
    arguments = ["heat", "scoreboard", "--worlds", "1-3", "--out", str(tmp_path), "--json"]
    assert main(arguments) == 1
    output = capsys.readouterr()
    rows = json.loads(output.out)
    assert [row["success"] for row in rows] == [True, False, True]
    assert all(tuple(row) == HEAT_ROW_KEYS for row in rows)
    assert "challenge-1 heat: success" in output.err
    assert "1 of 3 missions failed" in output.err
    assert {path.suffix for path in (tmp_path / "missions").iterdir()} == {*FILES, ".json"}


def test_jobs_are_in_the_order_of_their_mazes():
    setups = [HeatSetup("a"), HeatSetup("b")]
    jobs = make_heat_jobs((2, 1), "demo", None, setups)
    assert [job.name for job in jobs] == ["demo-2-a", "demo-2-b", "demo-1-a", "demo-1-b"]
