"""The help of every command as text files, which ./rover prints before anything is set up.

python -m rover_tools.cli.help_pages     # write them again, after a change of a command
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click

from rover_tools.cli.main import NAME, rover

FOLDER = Path(__file__).resolve().parents[2] / "help"
WIDTH = 80


def pages() -> dict[str, str]:
    """Each help text by the name of its file: rover, rover-mission, rover-bench-graph, ..."""
    root = click.Context(rover, info_name=NAME, terminal_width=WIDTH, **rover.context_settings)
    return dict(_pages_of(root))


def _pages_of(ctx: click.Context) -> Iterator[tuple[str, str]]:
    yield ctx.command_path.replace(" ", "-"), ctx.get_help() + "\n"
    if not isinstance(ctx.command, click.Group):
        return
    for name in ctx.command.list_commands(ctx):
        command = ctx.command.get_command(ctx, name)
        assert command is not None
        inner = click.Context(command, parent=ctx, info_name=name, **command.context_settings)
        yield from _pages_of(inner)


def write() -> None:
    """Write the files, and delete those of commands that are gone."""
    FOLDER.mkdir(exist_ok=True)
    wanted = pages()
    for path in FOLDER.glob("*.txt"):
        if path.stem not in wanted:
            path.unlink()
    for name, text in wanted.items():
        (FOLDER / f"{name}.txt").write_text(text)


if __name__ == "__main__":
    write()
