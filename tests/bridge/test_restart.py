"""A bridge that is started again goes on with the run of a simulator that goes on."""

from __future__ import annotations

from pathlib import Path

import pytest
from telemetry import START, telemetry
from wire_clients import Decider, answers_to

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions

AWAY = Pose(START.x + 2.5, START.y, 0.0)


class Restarts:
    """One bridge after another, and the statuses that they publish."""

    def __init__(self, ros, folder: str) -> None:
        self._ros, self._folder = ros, folder
        self._decider = ros.add(Decider)

    def bridge(self, *wires) -> list[tuple[int, int, int]]:
        """A bridge that gets these telemetries and ends; number, start and stamp of each."""
        ros, statuses = self._ros, self._decider.statuses
        statuses.clear()
        node = ros.add(BridgeNode, port=0, answer_deadline=5.0, state_dir=self._folder)
        assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
        assert ros.spin_until(lambda: self._decider.count_publishers(topics.STATUS) > 0)
        answers_to(ros, node.port, *wires)
        assert ros.spin_until(lambda: bool(statuses))
        ros.end(node)
        runs = [conversions.run_of(status) for status in statuses]
        stamps = [conversions.stamp_of(status.header.stamp) for status in statuses]
        return [(run.number, run.start, stamp) for run, stamp in zip(runs, stamps, strict=True)]


@pytest.fixture(params=["auto", "folder"])
def restarts(ros, request, tmp_path) -> Restarts:
    folder = request.param if request.param == "auto" else str(tmp_path / request.param)
    return Restarts(ros, folder)


@pytest.mark.parametrize("clock", [True, False], ids=["sim_time", "no clock"])
def test_the_run_goes_on_with_the_simulator(restarts, clock):
    def wire(time: float, pose: Pose):
        return telemetry(pose=pose, **({"sim_time": time} if clock else {}))

    first = restarts.bridge(wire(5.0, START), wire(6.0, AWAY))
    second = restarts.bridge(wire(6.0, AWAY), wire(6.1, AWAY))
    assert {(number, start) for number, start, _ in first + second} == {first[0][:2]}
    stamps = [stamp for _, _, stamp in first + second]
    assert stamps == sorted(set(stamps))


def test_another_simulator_begins_the_next_run(restarts):
    restarts.bridge(telemetry(sim_time=5.0), telemetry(sim_time=6.0, pose=AWAY))
    second = restarts.bridge(*[telemetry(sim_time=1.0)] * 3)
    assert {number for number, _, _ in second} == {2}


def test_torn_files_are_told_and_the_count_begins_anew(ros, tmp_path, capfd):
    restarts = Restarts(ros, str(tmp_path))
    restarts.bridge(telemetry(sim_time=5.0))
    for path in tmp_path.iterdir():
        path.write_bytes(path.read_bytes()[:-3])
    assert {number for number, _, _ in restarts.bridge(telemetry(sim_time=6.0))} == {1}
    lines = [line for line in capfd.readouterr().err.splitlines() if "is not used" in line]
    assert lines
    assert all("torn" in line for line in lines)


def test_without_a_folder_nothing_is_kept_or_written(ros, tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    restarts = Restarts(ros, "")
    restarts.bridge(telemetry(sim_time=5.0), telemetry(sim_time=6.0, pose=AWAY))
    ((number, start, stamp),) = restarts.bridge(telemetry(sim_time=6.1, pose=AWAY))
    assert (number, start) == (1, stamp)
    assert not any(Path(tmp_path).iterdir())
