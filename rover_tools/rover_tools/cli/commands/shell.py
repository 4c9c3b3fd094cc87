"""`rover shell`."""

from __future__ import annotations

import os

import click


@click.command(
    "shell", context_settings={"ignore_unknown_options": True, "allow_interspersed_args": False}
)
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED, metavar="[ARGUMENTS]...")
def command(arguments: tuple[str, ...]) -> None:
    """Open a shell in which the workspace is sourced.

    The shell is $SHELL, else bash; ARGUMENTS go to it.

    \b
    Examples:
      ./rover shell
      ./rover shell -c 'dask scheduler --port 8786'
    """
    shell = os.environ.get("SHELL") or "bash"
    os.execvp(shell, [shell, *arguments])
