"""`rover record`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from rover_tools.cli.options import out_option
from rover_tools.output import result_folder


@click.command("record")
@out_option
def command(out: Path | None) -> None:
    """Record all topics of the running graph, until Ctrl-C.

    DIR becomes a folder as rosbag2 has it, with one MCAP file. ROS_DOMAIN_ID names the graph's
    domain, which a mission prints at its start.

    \b
    Examples:
      ./rover record
      ROS_DOMAIN_ID=104 ./rover record --out recordings/first
    """
    from rover_tools.runner.recording import recorder_command

    path, *arguments = recorder_command(result_folder("recording", out))
    os.execv(path, [path, *arguments])
