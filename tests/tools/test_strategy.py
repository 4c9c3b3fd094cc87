"""Strategies by name, and from parameter files."""

from dataclasses import fields
from itertools import product
from pathlib import Path

import pytest

from rover_decision.missions.sample_return.config import DecisionConfig
from rover_perception.config import PerceptionConfig
from rover_tools.cli.main import main, rover
from rover_tools.cli.mission_options import MissionOptions
from rover_tools.evaluation.parameters import ParametersError
from rover_tools.evaluation.strategy import Strategy, StrategyError, choices
from rover_tools.scoreboard import run

SHIPPED = Path(__file__).resolve().parents[2] / "rover_bringup" / "config" / "rover.yaml"


def test_a_name_and_back():
    ways = choices(DecisionConfig, "way_home")
    recipes = choices(PerceptionConfig, "recipe")
    for each in product(choices(DecisionConfig, "explorer"), ways, recipes):
        strategy = Strategy(*each)
        assert Strategy.parse(str(strategy)) == strategy
        config = strategy.config()
        assert (config.explorer, config.way_home, strategy.perception().recipe) == each
    assert str(Strategy.parse("tour+breadcrumbs@exact")) == "tour"
    assert str(Strategy.parse("classic_b@exact")) == "classic_b@exact"


@pytest.mark.parametrize(
    ("name", "way_home", "share", "mapped"),
    [
        ("classic_a", "breadcrumbs", 0.98, (30.0, 1.6)),  # all that it sees, in every frame
        ("classic_b", "bearing", 0.0, (5.0, 0.012217)),  # 5 m, 0.7 degrees
    ],
)
def test_a_classic_comes_with_its_perception_and_its_way_home(name, way_home, share, mapped):
    strategy = Strategy.parse(name)
    assert strategy.way_home == way_home
    assert str(strategy) == name
    config, perception = strategy.config(), strategy.perception()
    assert (config.nav_cell, config.complete_at, config.complete_rule) == (0.1, share, "any")
    assert perception.recipe == "baseline"
    assert (perception.baseline_range, perception.baseline_tilt) == mapped
    assert Strategy().perception() == PerceptionConfig()


def test_the_truth_is_for_those_that_know_it(tmp_path):
    truth = tmp_path / "map.png"
    assert Strategy.parse("classic_a").config(truth).truth == str(truth)
    assert Strategy.parse("classic_b").config(truth).truth == ""
    assert Strategy().config(truth).truth == ""


@pytest.mark.parametrize(
    "text", ["", "dance", "tour+", "tour+dance", "+bearing", "tour@", "tour@dance"]
)
def test_a_name_that_there_is_not(text):
    with pytest.raises(StrategyError, match="there are"):
        Strategy.parse(text)


def test_of_the_parameters_that_ship():
    assert Strategy.of_parameters(SHIPPED) == Strategy()
    assert Strategy().config() == DecisionConfig()


def test_of_other_parameters(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("/**/decision_node:\n  ros__parameters:\n    explorer: frontier\n")
    assert str(Strategy.of_parameters(path)) == "frontier"
    path.write_text("/**/decision_node:\n  ros__parameters:\n    explorer: classic_b\n")
    of_file = Strategy.of_parameters(path)  # it says by itself what else is set
    assert of_file.perception() == PerceptionConfig()
    assert of_file.config().nav_cell == DecisionConfig().nav_cell
    path.write_text("[not, parameters]")
    with pytest.raises(ParametersError, match=r"mine\.yaml"):
        Strategy.of_parameters(path)


def test_broken_yaml_is_one_line(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("a: [1\nb: 2\n")
    with pytest.raises(ParametersError) as error:
        Strategy.of_parameters(path)
    assert "\n" not in str(error.value)


def parsed(command: str, *arguments: str) -> dict[str, object]:
    """The parameters of a command, as `rover COMMAND ARGUMENTS` parses them."""
    root = rover.make_context("rover", [command, *arguments])
    with root:
        _, found, rest = rover.resolve_command(root, [command, *arguments])
        assert found is not None
        return found.make_context(command, rest, parent=root).params


def options_of(command: str, *arguments: str) -> MissionOptions:
    """What `rover demo` or `rover mission` makes of its options."""
    given = parsed(command, *arguments)
    return MissionOptions(**{each.name: given[each.name] for each in fields(MissionOptions)})


@pytest.mark.parametrize("command", ["demo", "mission"])
def test_a_mission_takes_a_strategy_by_either_name(command):
    for option in ("--explorer", "--strategy"):
        options = options_of(command, option, "classic_b+breadcrumbs")
        assert options.chosen_strategy() == Strategy("classic_b", "breadcrumbs", "baseline")
    assert options_of(command).chosen_strategy() == Strategy()


def test_a_way_home_takes_the_place_of_the_strategys(tmp_path):
    parameters = tmp_path / "mine.yaml"
    parameters.write_text("decision_node: {ros__parameters: {explorer: frontier}}")
    options = options_of("demo", "--params", str(parameters), "--way-home", "bearing")
    assert options.chosen_strategy() == Strategy("frontier", "bearing")
    options = options_of("mission", "--explorer", "tour+bearing", "--way-home", "shortest_path")
    assert options.chosen_strategy() == Strategy("tour", "shortest_path")


def test_all_strategies_of_a_scoreboard_take_its_way_home(monkeypatch, tmp_path):
    jobs = []
    monkeypatch.setattr(run, "run_scoreboard", lambda made, *_: jobs.extend(made))
    names = "tour,frontier,tour+bearing"
    arguments = ["--worlds", "1", "--strategies", names, "--way-home", "bearing"]
    assert main(["scoreboard", *arguments, "--out", str(tmp_path)]) == 0
    assert [job.strategy for job in jobs] == ["tour+bearing", "frontier+bearing"]


def test_the_scoreboards_default_is_the_default_strategy():
    assert parsed("scoreboard")["strategies"] == (str(Strategy()),)
