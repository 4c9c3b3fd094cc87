"""`rover new KIND NAME`."""

from __future__ import annotations

import shlex
import shutil
from pathlib import Path

import click


@click.command("new")
@click.argument("kind", type=click.Choice(["explorer", "perception"]), metavar="KIND")
@click.argument("name")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR",
              help="The folder to make.  [default: NAME, here]")  # fmt: skip
@click.option("--no-install", is_flag=True, help="Write the files only.")
def command(kind: str, name: str, out: Path | None, no_install: bool) -> None:
    """Make a package with an explorer or a perception of your own, and install it.

    KIND is explorer or perception. The package holds a small part that works, to be changed, and
    its test. It is installed where it lies, so that every command knows NAME at once.

    \b
    Examples:
      ./rover new explorer my_explorer
      ./rover new perception my_perception
    """
    from rover_tools.new_part.kinds import (
        KINDS,
        NewPartError,
        install,
        install_command,
        next_commands,
        write_skeleton,
    )
    from rover_tools.output import note

    made = KINDS[kind]
    folder = out or Path(name)
    write_skeleton(made, name, folder)
    if not no_install:
        try:
            install(folder)
        except NewPartError:
            shutil.rmtree(folder)
            raise
    note(f"the part is {folder / 'src' / name / made.module}.py; next:")
    commands = next_commands(made, name, folder)
    print("\n".join([shlex.join(install_command(folder)), *commands] if no_install else commands))
