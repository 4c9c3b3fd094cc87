"""Files of parameters: what ROS would ignore, or end a node for, is one line before it starts."""

import pytest

from rover_tools.cli.main import main
from rover_tools.evaluation.parameters import ParametersError, read_parameters
from rover_tools.runner.graph import default_parameters


def write(folder, text, node="decision_node"):
    path = folder / "mine.yaml"
    path.write_text(f"/**/{node}:\n  ros__parameters:\n    {text}\n")
    return path


def test_the_file_that_ships_is_right():
    assert read_parameters(default_parameters())["bridge_node"]["port"] == 4567


def test_values_for_all_nodes_reach_those_that_have_them(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("/**:\n  ros__parameters: {use_sim_time: true, explorer: frontier}\n")
    assert read_parameters(path)["decision_node"]["explorer"] == "frontier"


def test_sections_of_other_nodes_are_left_alone(tmp_path):
    assert read_parameters(write(tmp_path, "port: eighty", "camera_driver"))["bridge_node"] == {}


@pytest.mark.parametrize(
    ("node", "text", "reason"),
    [
        ("decision_node", "explorrer: tour", "no parameter 'explorrer'; did you mean 'explorer'?"),
        ("decision_node", "xyzzy: 1", "there is no parameter 'xyzzy'"),
        ("decison_node", "explorer: tour", "no node 'decison_node'; did you mean 'decision_node'"),
        ("bridge_node", "port: 80000", "port: 80000 is not within 0 to 65535"),
        ("bridge_node", "port: -1", "port: -1 is not within"),
        ("bridge_node", "port: 80.5", "port: 80.5 is no int"),
        ("bridge_node", "answer_deadline: .inf", "inf is no finite number"),
        ("bridge_node", "answer_deadline: .nan", "nan is no finite number"),
        ("bridge_node", "insets: perhaps", "'perhaps' is not one of auto, always, never"),
        ("bridge_node", "port: [", "line "),
    ],
)
def test_what_no_node_takes_is_one_line(tmp_path, node, text, reason, capsys):
    path = write(tmp_path, text, node)
    with pytest.raises(ParametersError) as caught:
        read_parameters(path)
    assert str(caught.value).startswith(str(path))
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("content", [b"\x96\x00\xff", b"", b"[1, 2]", b"a: 1", b"a: {b: 1}"])
def test_a_file_of_something_else_is_one_line_of_the_command(tmp_path, content, capsys):
    path = tmp_path / "mine.yaml"
    path.write_bytes(content)
    arguments = ["mission", "--params", str(path), "--out", str(tmp_path / "out"), "--size", "0.2"]
    if not content:  # no section changes nothing
        assert read_parameters(path)["bridge_node"] == {}
        return
    assert main(arguments) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "not a parameter file" in error
    assert not (tmp_path / "out").exists()
    assert main(["heat", "mission", "--params", str(path), "--out", str(tmp_path / "out")]) == 1
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "out").exists()
