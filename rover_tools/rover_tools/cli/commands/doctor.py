"""`rover doctor`: the launcher's checks of the machine."""

from __future__ import annotations

import click

from rover_tools.cli.commands.launcher import call_launcher


@click.command("doctor")
def command() -> None:
    """Say what is missing or wrong on this machine, and what to do about it.

    One line per check: tools, variables, port, memory, disk, loopback, build, and, of the graph
    that runs in the domain, its clock and its QoS. The exit code is 1 if something is missing or
    wrong. Nothing is installed.

    \b
    Examples:
      ./rover doctor
    """
    call_launcher("doctor")
