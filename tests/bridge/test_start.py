"""A bridge that cannot start ends with one sentence, by an ordinary end of its process."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from rover_common.errors import CANNOT_START

PROGRAM = "from rover_bridge.node import main; main()"


@pytest.mark.parametrize(
    ("parameter", "environment", "text"),
    [
        ("port:=80000", {}, "port has to be an integer from 0 to 65535"),
        ("host:=192.0.2.7", {}, "cannot listen on '192.0.2.7'"),
        ("host:='2001:db8::1'", {}, "cannot listen on '2001:db8::1'"),
        ("allowed_origins:='http://*'", {}, "allowed_origins: 'http://*'"),
        ("port:=0", {"ROS_DOMAIN_ID": "abc"}, "ROS_DOMAIN_ID is 'abc', not a number"),
        ("port:=0", {"ROS_DOMAIN_ID": "999"}, "ROS_DOMAIN_ID is '999', not a number"),
        ("port", {}, "parse"),
    ],
)
def test_one_sentence_says_why(domain_id, parameter, environment, text):
    ended = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, "--ros-args", "-p", parameter],
        env=os.environ | {"ROS_DOMAIN_ID": str(domain_id)} | environment,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert ended.returncode == CANNOT_START, ended.stderr
    lines = ended.stderr.strip().splitlines()
    (line,) = [line for line in lines if not line.startswith("[")]  # but what ROS itself logs
    assert text in line
