"""`rover build`: what the launcher does before Python exists."""

from __future__ import annotations

import click

from rover_tools.cli.commands.launcher import call_launcher


@click.command("build")
def command() -> None:
    """Set up and build what is missing, nothing more.

    Libraries go into .venv, the workspace into install; nothing outside of the checkout changes.
    PYTHON chooses the interpreter. With `--platform noble` both are below .noble.

    \b
    Examples:
      ./rover build
      PYTHON=python3.12 ./rover build
      ./rover build --platform noble
    """
    call_launcher("build")
