"""heat_node again: it goes on before the same robot and in the same map, else it begins anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from heat_bench import ROOM, HeatBench
from mapped_rooms import map_of

from rover_common.geometry import Pose
from rover_common.same_robot import MARGIN, OLDEST
from rover_common.saved_state import StateFile
from rover_decision.types import Request
from rover_heat.mission.parts import HeatParts
from rover_heat.node_state import VERSION, VOID
from rover_heat.tilt import Lean
from rover_navigation.types import NO_POINTS

MAP = map_of(ROOM, [(1.5, 1.5), (3.0, 3.0)])
BEGUN, OTHER = 7_000_000_000, 9_000_000_000  # [ns] of maps
FAR = Pose(5.0, 5.0, 0.0)  # [m] beyond what a robot drives in some seconds


@pytest.fixture
def bench(ros) -> HeatBench:
    return HeatBench(ros)


def parts_of(bench: HeatBench) -> HeatParts:
    return bench.node._core.mission.parts


def spend(bench: HeatBench, begun: int | None) -> None:
    """It explores, has met a ramp, and has released a payload."""
    bench.robot.send_map(MAP, begun)
    bench.until(lambda: bench.state == "EXPLORING", 8.0)
    parts = parts_of(bench)
    parts.agenda.payloads -= 1
    parts.ramps.meet(Pose(3.0, 3.0, 0.5), Lean(0.0, -0.1), NO_POINTS)
    bench.seconds(1.5)


def has_places(bench: HeatBench) -> bool:
    return len(parts_of(bench).ramps.ramps) == 1


def has_payload(bench: HeatBench) -> bool:
    return parts_of(bench).agenda.payloads == 3


def test_the_next_one_goes_on_within_a_moment(bench):
    spend(bench, BEGUN)
    elapsed, trail = bench.node._decision.progress.elapsed, parts_of(bench).trail.points
    bench.again()
    bench.robot.send_map(MAP, BEGUN)
    bench.until(lambda: bench.state == "EXPLORING", 1.0)
    assert has_places(bench)
    assert has_payload(bench)
    assert bench.node._decision.progress.elapsed == pytest.approx(elapsed + 3.0, abs=1.0)
    assert np.array_equal(parts_of(bench).trail.points, trail)


def test_hazards_are_sent_again_with_the_first_map(bench):
    spend(bench, BEGUN)
    before = bench.node._hazards
    bench.again()
    bench.robot.send_map(MAP, BEGUN)
    bench.tick()
    bench.tick()
    assert bench.node._hazards == before == parts_of(bench).ramps.hazards


@pytest.mark.parametrize("other", ["far away", "too late", "earlier", "no folder"])
def test_before_another_robot_it_begins_anew(bench, other):
    spend(bench, BEGUN)
    if other == "far away":
        bench.robot.says, bench.robot.origin = FAR, Pose(-3.5, -3.5, 0.0)
    elif other == "no folder":
        bench._parameters = {"state_dir": ""}
    bench.again({"too late": OLDEST, "earlier": -3.0}.get(other, 3.0))
    bench.robot.send_map(MAP, BEGUN)
    bench.seconds(0.3)
    assert bench.state == "INITIALIZING"
    assert not has_places(bench)
    assert not has_payload(bench)


def test_what_is_saved_waits_for_the_map_and_is_not_written_over(bench):
    spend(bench, BEGUN)
    bench.again()
    bench.node._sensors.grid = None  # a navigator that sends none
    bench.seconds(1.5)
    bench.again()
    bench.robot.send_map(MAP, BEGUN)
    bench.until(lambda: has_places(bench), 0.3)


class TestAnotherMap:
    """Places are void, payloads and time go on."""

    def test_that_it_finds_when_it_is_started_again(self, bench):
        spend(bench, BEGUN)
        bench.again()
        bench.robot.send_map(MAP, OTHER)
        bench.until(lambda: has_payload(bench), 0.3)
        assert not has_places(bench)
        assert bench.node._decision.progress.elapsed > 3.0

    @pytest.mark.parametrize("far", [False, True])
    def test_by_the_pose_where_a_map_does_not_tell_its_beginning(self, bench, far):
        spend(bench, None)
        if far:
            bench.robot.origin = Pose(MARGIN + 1.0, 0.0, 0.0)
        bench.again()
        bench.robot.send_map(MAP)
        bench.until(lambda: has_payload(bench), 0.3)
        assert has_places(bench) is not far

    def test_that_comes_meanwhile(self, bench, capfd):
        spend(bench, BEGUN)
        elapsed = bench.node._decision.progress.elapsed
        bench.robot.send_map(MAP, BEGUN)
        bench.seconds(0.2)
        assert has_places(bench)
        bench.robot.send_map(MAP, OTHER)
        bench.until(lambda: not has_places(bench), 0.3)
        assert has_payload(bench)
        bench.until(lambda: bench.state == "EXPLORING", 1.0)
        bench.robot.send_map(MAP, OTHER)
        bench.seconds(0.2)
        assert bench.node._decision.progress.elapsed > elapsed
        assert capfd.readouterr().err.count(VOID) == 1

    def test_but_not_one_that_is_stamped_anew_each_time(self, bench):
        spend(bench, None)
        bench.robot.send_map(MAP)
        bench.seconds(0.3)
        assert has_places(bench)


def test_a_launch_is_written_before_it_is_signalled(ros, tmp_path):
    bench = HeatBench(ros, state_dir=str(tmp_path))
    spend(bench, BEGUN)
    parts_of(bench).agenda.payloads = 0
    bench.node._kept.keep(replace(bench.node._decision, launch=True))
    newest = StateFile(tmp_path / "heat_node.state", "heat", VERSION).read()[0][0]
    assert newest.values["mission"]["parts"]["robot"]["payloads"] == 0


def test_a_reset_forgets_what_was_saved(bench):
    spend(bench, BEGUN)
    bench.node._core.request(Request.RESET)
    bench.seconds(0.5)
    bench.again()
    bench.robot.send_map(MAP, BEGUN)
    bench.seconds(0.3)
    assert not has_places(bench)
    assert bench.node._frames.run.number == 2
