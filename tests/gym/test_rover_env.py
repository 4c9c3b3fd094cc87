"""The step API: Gymnasium's own checker, determinism, units, ends of an episode, the example."""

from __future__ import annotations

import importlib.util
import math
import warnings
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import rover_tools.gym
from rover_common.vehicle import ROVER
from rover_simulator.simulation import START_TIME
from rover_tools.gym import rover_env
from rover_tools.gym.rover_env import RoverEnv

EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "agent.py"
SIZE = 0.2
AHEAD, BRAKE = np.array([1, 0, 0, 0], np.float32), np.array([0, 1, 0, 0], np.float32)
PICKUP = np.array([0, 0, 0, 1], np.float32)


@pytest.fixture
def env():
    env = RoverEnv(size=SIZE)
    yield env
    env.close()


def test_gymnasiums_own_checker_has_nothing_to_say(monkeypatch):
    monkeypatch.setattr(rover_env, "WORLDS", 1)  # for all of its ten seeds: each costs seconds
    env = gymnasium.make(rover_tools.gym.ID, size=SIZE, render_mode="rgb_array").unwrapped
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env)


def episode(env: RoverEnv, seed: int, steps: int) -> list[np.ndarray]:
    """Poses and images of an episode in which everything is drawn from the seed."""
    observation, info = env.reset(seed=seed)
    env.action_space.seed(seed)
    seen = [np.array([info["world"]]), observation["pose"], observation["image"]]
    for _ in range(steps):
        observation, *_ = env.step(env.action_space.sample())
        seen += [observation["pose"], observation["image"], observation["free_scan"]]
    return seen


def test_the_same_seed_gives_the_same_episode_and_another_one_another(env):
    first, second, other = (episode(env, seed, 10) for seed in (3, 3, 4))
    assert all((a == b).all() for a, b in zip(first, second, strict=True))
    assert any((a != b).any() for a, b in zip(first, other, strict=True))


def test_a_reset_without_a_seed_gives_another_canyon_and_an_option_chooses_one(env):
    worlds = [env.reset(seed=1)[1]["world"], *(env.reset()[1]["world"] for _ in range(2))]
    assert len(set(worlds)) == 3
    assert env.reset(options={"world": 7})[1]["world"] == 7


def test_actions_and_observations_are_in_their_units(env):
    start, _ = env.reset(options={"world": 1})
    for _ in range(25):  # of 0.08 s
        observation, *_, info = env.step(AHEAD)
    speed = observation["pose"][5]
    assert info["time"] == pytest.approx(2.0)
    assert speed == pytest.approx(0.852 * 2.0, rel=0.1)  # [m/s] full throttle, as measured
    moved = math.dist(observation["pose"][:2], start["pose"][:2])
    assert moved == pytest.approx(info["distance"], rel=0.05)
    for _ in range(25):
        env.step(BRAKE)
    turn = np.array([0, 0, ROVER.max_steering, 0], np.float32)
    before = env.step(turn)[0]["pose"][2]
    for _ in range(5):
        observation, *_ = env.step(turn)
    turned = math.remainder(float(observation["pose"][2] - before), 2 * math.pi)
    assert turned == pytest.approx(math.radians(45.0) * 5 * 0.08, rel=0.02)  # to the left


def test_the_time_limit_truncates(env):
    env = RoverEnv(size=SIZE, time_limit=0.4)
    env.reset(options={"world": 1})
    ends = [env.step(BRAKE)[2:4] for _ in range(5)]
    assert ends == [(False, False)] * 4 + [(False, True)]


def test_a_pickup_without_a_sample_brakes_instead_of_freezing(env):
    env.reset(options={"world": 1})
    assert env.step(PICKUP)[0]["picking_up"] == 0
    before = env.step(AHEAD)[0]["pose"][5]
    assert env.step(AHEAD)[0]["pose"][5] > before


def test_a_sample_is_worth_one_and_home_with_all_of_them_ends_the_episode(env):
    observation, _ = env.reset(options={"world": 1})
    simulation = env._simulation
    pose = simulation.pose
    ahead = ROVER.arm_forward
    place = pose.x + ahead * math.cos(pose.yaw), pose.y + ahead * math.sin(pose.yaw)
    simulation._arm.samples[:] = [place]  # the only one lies at the arm, and the rover is at home
    env.step(BRAKE)
    rewards, terminated = [], False
    while not terminated and simulation.time < START_TIME + 20.0:
        observation, reward, terminated, *_ = env.step(PICKUP)
        rewards.append(reward)
    assert terminated
    assert observation["samples_left"] == 0
    assert sum(rewards) == 2.0
    assert 10.0 < simulation.time - START_TIME < 11.0  # the arm's sequence


def test_it_is_to_be_reset_first(env):
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step(BRAKE)
    assert env.render() is None


def test_the_example_agent_gets_on():
    spec = importlib.util.spec_from_file_location("agent", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    info = module.run(world=1, size=SIZE, time_limit=20.0)
    assert info["distance"] > 10.0
    assert len(EXAMPLE.read_text().splitlines()) <= 60
