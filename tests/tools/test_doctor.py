"""Each likely mistake of a set-up is found and told with its remedy; a good one is not blamed."""

from __future__ import annotations

import errno
import shutil
import socket
from collections import namedtuple

import pytest
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

from rover_common.ros import qos
from rover_tools.doctor import environment, machine
from rover_tools.doctor.__main__ import report
from rover_tools.doctor.finding import Finding, Level, note, wrong
from rover_tools.doctor.graph import CLOCK, Endpoint, check_clock, check_qos
from rover_tools.doctor.node_look import look

Usage = namedtuple("Usage", "total used free")


def endpoint(topic="odom", node="n", reliable=True, latched=False):
    return Endpoint(topic, node, reliable, latched)


@pytest.mark.parametrize(
    ("check", "variables", "level", "remedy"),
    [
        (environment.check_domain, {}, Level.OK, ""),
        (environment.check_domain, {"ROS_DOMAIN_ID": "7"}, Level.NOTE, "unset it"),
        *(
            (environment.check_domain, {"ROS_DOMAIN_ID": bad}, Level.WRONG, "set 0 to 232")
            for bad in ("abc", "-1", "300", "1.5")
        ),
        (environment.check_discovery, {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, Level.OK, ""),
        *(
            (environment.check_discovery, variables, Level.WRONG, "unset it")
            for variables in (
                {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"},
                {"ROS_AUTOMATIC_DISCOVERY_RANGE": "local"},
                {"ROS_DISCOVERY_SERVER": "10.0.0.1:11811"},
                {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"},
                {"FASTRTPS_DEFAULT_PROFILES_FILE": "/none/profiles.xml"},
            )
        ),
        (environment.check_discovery, {"ROS_LOCALHOST_ONLY": "1"}, Level.NOTE, "LOCALHOST"),
        (environment.check_other_ros, {"ROS_DISTRO": "jazzy"}, Level.OK, ""),
        (environment.check_other_ros, {"ROS_DISTRO": "humble"}, Level.NOTE, "open a shell without"),
        (environment.check_python_path, {"PYTHONPATH": ""}, Level.OK, ""),
        (
            environment.check_python_path,
            {"PYTHONPATH": "/opt/ros/jazzy/lib:/ws/lib", "AMENT_PREFIX_PATH": "/opt/ros/jazzy:/ws"},
            Level.OK,
            "",
        ),
        (environment.check_python_path, {"PYTHONPATH": "/a:/b"}, Level.NOTE, "unset PYTHONPATH"),
    ],
)
def test_variables(check, variables, level, remedy):
    finding = check(variables)
    assert finding.level is level
    assert remedy in finding.text
    assert (finding.text == "") == (level is Level.OK)


def test_a_port_in_use():
    with socket.socket() as server:
        server.bind((machine.HOST, 0))
        server.listen(1)
        port = server.getsockname()[1]
        finding = machine.check_port(port)
        assert finding.level is Level.NOTE
        assert "end the program that has it" in finding.text
    assert machine.check_port(port).level is Level.OK


def test_no_shared_memory(tmp_path, monkeypatch):
    assert machine.check_shared_memory(tmp_path).level is Level.OK
    missing = machine.check_shared_memory(tmp_path / "none")
    assert missing.level is Level.WRONG
    assert "--ipc=host" in missing.text
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(2**26, 2**26, 2**20))
    full = machine.check_shared_memory(tmp_path)
    assert full.level is Level.WRONG
    assert "1 MB free" in full.text


def test_a_full_disk(tmp_path, monkeypatch):
    assert machine.check_disk(tmp_path / "made" / "later").level is Level.OK
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(2**40, 2**40, 3 * 2**20))
    finding = machine.check_disk(tmp_path)
    assert finding.level is Level.WRONG
    assert "3 MB free; delete old results" in finding.text


class Refusing(socket.socket):
    """A socket as behind a firewall: one of its calls is refused, or what it sends is lost."""

    refused = ""

    def sendto(self, *arguments):
        if self.refused == "drop":
            return 0
        return self._pass("sendto", *arguments)

    def connect(self, *arguments):
        return self._pass("connect", *arguments)

    def _pass(self, name, *arguments):
        if self.refused == name:
            raise OSError(errno.EPERM, "Operation not permitted")
        return getattr(super(), name)(*arguments)


@pytest.mark.parametrize("refused", ["sendto", "connect", "drop"])
def test_a_loopback_that_refuses(refused, monkeypatch):
    assert machine.check_loopback().level is Level.OK
    monkeypatch.setattr(machine, "TIMEOUT", 0.2)
    monkeypatch.setattr(Refusing, "refused", refused)
    finding = machine.check_loopback(Refusing)
    assert finding.level is Level.WRONG
    assert "iptables -A INPUT -i lo -j ACCEPT" in finding.text


def test_a_clock_that_does_not_run():
    waiting, clock = [endpoint(CLOCK, "decision_node")], [endpoint(CLOCK, "bridge_node")]
    assert check_clock([], [], False).level is Level.OK
    assert check_clock(clock, waiting, True).level is Level.OK
    nobody = check_clock([], waiting, False)
    assert nobody.level is Level.WRONG
    assert "decision_node waits for /clock, which nobody publishes" in nobody.text
    assert "stands still" in check_clock(clock, waiting * 2, False).text


@pytest.mark.parametrize(
    ("offered", "asked", "policy"),
    [
        ({"reliable": False}, {"reliable": True}, "reliable delivery"),
        ({"latched": False}, {"latched": True}, "transient local durability"),
        ({"reliable": True, "latched": True}, {"reliable": False}, None),
        ({"topic": "other", "reliable": False}, {"reliable": True}, None),
    ],
)
def test_qos_that_cannot_match(offered, asked, policy):
    finding = check_qos([endpoint(node="a", **offered)], [endpoint(node="b", **asked)])
    assert finding.level is (Level.WRONG if policy else Level.OK)
    if policy:
        assert f"b hears nothing of a on odom: it asks for {policy}" in finding.text


def test_the_running_graph_is_looked_at(ros):
    node = ros.add(lambda **kwargs: Node("talker", **kwargs))
    node.create_publisher(String, "/news", qos.SCAN)
    node.create_subscription(String, "/news", lambda _: None, qos.LATCHED)
    node.create_subscription(Clock, CLOCK, lambda _: None, qos.CLOCK)
    clock, match = look(ros.context.get_domain_id())
    assert "talker waits for /clock, which nobody publishes" in clock.text
    assert "talker hears nothing of talker on /news" in match.text


def test_the_exit_code_is_that_of_the_worst(capsys):
    assert report([Finding("a"), note("b", "careful")]) == 0
    assert report([Finding("a"), wrong("b", "bad")]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == "wrong    b: bad"
