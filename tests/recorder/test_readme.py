"""The README is the package's contract."""

from __future__ import annotations

from dataclasses import fields

from rclpy.qos import QoSProfile
from readme_tables import ROOT, column, table

from rover_common.ros import qos
from rover_recorder.config import RecorderConfig
from rover_recorder.conversions import JPEG_QUALITY
from rover_recorder.node import FLUSH_PERIOD, SEARCH_PERIOD, RecorderNode
from rover_recorder.writer import CHUNK_SIZE

README = ROOT / "rover_recorder" / "README.md"
PACKAGE = ROOT / "rover_recorder" / "rover_recorder"
OF_EVERY_NODE = {"/rosout", "/parameter_events"}
PROFILES = {name: value for name, value in vars(qos).items() if isinstance(value, QoSProfile)}


def test_the_topics_and_counters_are_the_nodes(ros, tmp_path):
    node = ros.add(RecorderNode, folder=str(tmp_path / "run"))
    found = {
        (p.topic_name, next(n for n, value in PROFILES.items() if value is p.qos_profile))
        for p in node.publishers
        if p.topic_name not in OF_EVERY_NODE
    }
    assert {(row["topic"], row["QoS"]) for row in table(README, "Publishes")} == found
    assert ros.spin_until(lambda: node._diagnostics.counts)
    assert column(README, "Counters", "counter") == list(node._diagnostics.counts)


def test_the_parameters_are_those_of_the_configuration():
    rows = table(README, "Parameters")
    assert [row["parameter"] for row in rows] == [field.name for field in fields(RecorderConfig)]
    for row, field in zip(rows, fields(RecorderConfig), strict=True):
        assert (row["default"], row["range"]) == (str(field.default) or "none", "")
        assert row["meaning"] == field.metadata["parameter"].description


def test_the_numbers_are_those_of_the_code():
    text = README.read_text()
    assert f"quality {JPEG_QUALITY} " in text
    assert SEARCH_PERIOD == 0.5
    assert "found twice a\n  second" in text
    assert FLUSH_PERIOD == 1.0
    assert f"each second, or after {CHUNK_SIZE >> 20} MB" in text


def test_the_flow_names_all_modules():
    flow = README.read_text().split("## The flow of one message\n")[1].split("\n## ")[0]
    modules = {path.name for path in PACKAGE.glob("*.py")}
    assert {name for name in modules if f"`{name}`" in flow} == modules - {
        "__init__.py",
        "config.py",
        "errors.py",
    }
    assert column(README, "Times", "time in the file") == ["log_time", "publish_time"]
