"""Whole missions of the planar rover."""

from __future__ import annotations

import numpy as np
import pytest
from frames_by_hand import CONFIG
from planar_rover import PERIOD, bends, rover_in_bends, rover_in_ring, run_mission

from rover_common.geometry import Pose
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return import make_core
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Decision


@pytest.mark.parametrize(
    ("make_rover", "explorer", "way_home"),
    [  # in each world, every explorer
        (rover_in_ring, "tour", "shortest_path"),
        (rover_in_ring, "frontier", "bearing"),
        (rover_in_ring, "classic_b", "shortest_path"),
        (rover_in_bends, "tour", "bearing"),
        (rover_in_bends, "frontier", "breadcrumbs"),
        (rover_in_bends, "classic_b", "bearing"),
    ],
)
def test_a_mission_brings_all_samples_home(make_rover, explorer, way_home):
    rover = make_rover()
    total = len(rover.samples)
    decision = run_mission(rover, DecisionConfig(explorer=explorer, way_home=way_home), 400)
    assert rover.samples == []
    assert rover.unsafe_pickups == 0
    assert decision.state is State.DONE
    assert decision.progress.home_distance < 2.0
    assert decision.progress.samples_collected == total
    assert PERIOD < decision.progress.elapsed < 400


def test_the_tour_observes_all_of_a_world():
    rover = rover_in_bends()
    run_mission(rover, CONFIG, 400)
    free = rover.map().cells == 0
    assert np.count_nonzero(free) > 0.97 * 16 * np.count_nonzero(bends())


def test_the_same_mission_twice():
    def track() -> list[Pose]:
        poses: list[Pose] = []
        run_mission(rover_in_bends(), CONFIG, 40, lambda frame, _: poses.append(frame.pose))
        return poses

    assert track() == track()


def test_a_new_run_is_driven_as_a_fresh_core_drives_it():
    """Though it begins in the middle of a mission that knows the world by then."""

    def second_run(core: DecisionCore) -> list[Decision]:
        rover, decisions = rover_in_bends(), []
        rover.time = 100.0
        rover.begin_run()
        run_mission(rover, CONFIG, 140.0, lambda _, made: decisions.append(made), core)
        core.close()
        return decisions

    used, fresh = (make_core(CONFIG, lockstep=True) for _ in range(2))
    run_mission(rover_in_bends(), CONFIG, 40.0, core=used)
    decisions = second_run(used)
    assert decisions == second_run(fresh)
    assert decisions[-1].progress.distance > 20.0
