"""`rover doctor`: the launcher's checks of the machine."""

from __future__ import annotations

import click

from rover_tools.cli.commands.launcher import call_launcher


@click.command("doctor")
def command() -> None:
    """Say what is missing on this machine.

    One line per check; the exit code is 1 if something is missing. Nothing is installed.

    \b
    Examples:
      ./rover doctor
    """
    call_launcher("doctor")
