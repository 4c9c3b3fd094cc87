"""`rover test`."""

from __future__ import annotations

import os
import sys

import click

from rover_tools.cli.commands.launcher import checkout

PARALLEL = ("-n", "3", "--dist", "worksteal")


@click.command(
    "test", context_settings={"ignore_unknown_options": True, "allow_interspersed_args": False}
)
@click.argument("arguments", nargs=-1, metavar="[ARGUMENTS]...")
def command(arguments: tuple[str, ...]) -> None:
    """Run all tests with pytest, or those that ARGUMENTS choose.

    ARGUMENTS go to pytest, after `-n 3 --dist worksteal`; the exit code is pytest's.

    \b
    Examples:
      ./rover test
      ./rover test tests/bridge -k unity
      ./rover test --platform noble tests/bridge
    """
    os.chdir(checkout())
    os.execv(sys.executable, [sys.executable, "-m", "pytest", *PARALLEL, *arguments])
