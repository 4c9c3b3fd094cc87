"""The README is the package's contract: its tables say what the node does."""

from dataclasses import fields

import pytest
from node_endpoints import endpoints, listed
from readme_tables import ROOT, column, table
from scene import EXACT, draw

from rover_common.geometry import Pose
from rover_common.input_monitor import InputLimits
from rover_common.ros.message_checks import INVALID, ImageMessageError
from rover_common.types import CameraFrame
from rover_perception import config, node
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameError
from rover_perception.node import PerceptionNode
from rover_perception.perception import Perception

PACKAGE = ROOT / "rover_perception" / "rover_perception"
README = PACKAGE.parent / "README.md"


@pytest.mark.parametrize("heading", ["Publishes", "Subscribes"])
def test_the_topics_are_those_of_the_node(ros, heading):
    own = ros.add(PerceptionNode)
    of_node = own.publishers if heading == "Publishes" else own.subscriptions
    assert listed(README, heading) == endpoints(of_node)


def test_the_parameters_are_those_of_the_configuration():
    rows = table(README, "Parameters")
    declared = [*fields(PerceptionConfig), *fields(InputLimits)]
    assert [row["parameter"] for row in rows] == [field.name for field in declared]
    for row, field in zip(rows, declared, strict=True):
        info = field.metadata["parameter"]
        assert row["default"] == str(field.default), field.name
        choices = ", ".join(info.choices)
        limits = "" if info.minimum is None else f"{info.minimum} to {info.maximum}"
        assert row["range"].replace("`", "") == (choices or limits), field.name
        if choices or not limits:
            continue
        unit = info.description.split("]")[0].strip("[") if "[" in info.description else "frames"
        assert row["unit"].split()[0] == unit, field.name


def test_the_counters_are_those_counted():
    of_errors = {error.counter for error in FrameError.__subclasses__()}
    of_node = {node.FRAMES, node.FRAMES_INCOMPLETE, INVALID, ImageMessageError.counter}
    listed = column(README, "Counters", "counter")
    assert len(listed) == len(set(listed))
    assert set(listed) == of_errors | of_node


def test_the_errors_are_those_raised():
    of_frames = {error.__name__ for error in FrameError.__subclasses__()}
    assert set(column(README, "Errors", "error")) == of_frames | {config.ResolutionError.__name__}


def test_the_flow_names_all_modules():
    flow = README.read_text().split("## The flow of one frame\n")[1].split("\n## ")[0]
    modules = {str(path.relative_to(PACKAGE)) for path in PACKAGE.rglob("*.py")}
    aside = {name for name in modules if name.endswith("__init__.py")} | {"config.py"}
    assert {name for name in modules if f"`{name}`" in flow} == modules - aside


def test_the_scan_has_the_bearings_and_limits_described():
    pose = Pose(90.0, 100.0, 0.0)
    scan = Perception(EXACT).process(CameraFrame(1, pose, draw(pose, lambda x, y: x < 94))).scan
    text = README.read_text()
    degrees = round(-scan.angle_min * 57.29578)
    assert f"{len(scan.ranges)} bearings from -{degrees} to {degrees} degrees" in text
    assert f"`range_min` is {scan.range_min} m" in text


@pytest.mark.parametrize("values", [(1.0, 0.3), (0.25, 0.5), (0.7, 0.7)])
def test_resolutions_that_do_not_fit_are_refused(values):
    with pytest.raises(config.ResolutionError):
        PerceptionConfig(*values)


def test_resolutions_that_fit_up_to_rounding_are_accepted():
    assert PerceptionConfig(0.3, 0.1).map_resolution == 0.3
