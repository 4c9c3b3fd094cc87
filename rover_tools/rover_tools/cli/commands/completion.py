"""`rover completion SHELL`."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from rover_tools.cli.lazy_group import LazyGroup

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_ROVER_COMPLETE"  # click looks for this one when it is called as `rover`
# Click's scripts of zsh and fish call `rover` from the path; ours call what was typed.
REPLACED = (
    ("    (( ! $+commands[rover] )) && return 1\n", ""),
    ("zsh_complete rover)", 'zsh_complete "${words[1]}")'),
    ("(commandline -t) rover)", "(commandline -t) (commandline -opc)[1])"),
)


@click.command("completion")
@click.argument("shell", type=click.Choice(SHELLS))
@click.pass_context
def command(ctx: click.Context, shell: str) -> None:
    """Print the completion script of a shell.

    It completes commands and options of ./rover in any checkout, and of rover.

    \b
    Examples:
      source <(./rover completion bash)
      ./rover completion fish > ~/.config/fish/completions/rover.fish
    """
    group = ctx.find_root().command
    assert isinstance(group, LazyGroup)
    click.echo(script(group, shell))


def script(group: click.Command, shell: str) -> str:
    """Click's script, changed to call the program by the path that was typed."""
    completion = get_completion_class(shell)
    assert completion is not None
    text = completion(group, {}, "rover", VARIABLE).source()
    for theirs, ours in REPLACED:
        text = text.replace(theirs, ours)
    return text
