"""A group of commands whose modules are imported only when they are called."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, NamedTuple, NoReturn

import click

from rover_tools.cli.hints import COMMANDS, OPTIONS


class Entry(NamedTuple):
    """Where a command is declared, and what the list of commands says about it."""

    module: str  # its variable `command` is the command
    summary: str


class LazyGroup(click.Group):
    """Commands by name; an unknown command or option is answered with the nearest one."""

    def __init__(self, *, table: Mapping[str, Entry], **attributes: Any) -> None:
        super().__init__(no_args_is_help=False, **attributes)
        self._table = table

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        if not args and not ctx.resilient_parsing:
            raise click.UsageError(f"name one of {', '.join(self._table)}", ctx)
        return super().parse_args(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(self._table)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in self._table:
            return None
        entry = self._table[cmd_name]
        command: click.Command = importlib.import_module(entry.module).command
        command.short_help = entry.summary
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """From the table: a command is not imported to be listed."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, entry.summary) for name, entry in self._table.items()])

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if name in self._table or name.startswith("-") or ctx.resilient_parsing:
            return super().resolve_command(ctx, args)
        near = get_close_matches(name, {*self._table, *COMMANDS}, n=1)
        hint = ""
        if near:
            hint = f"; did you mean '{near[0] if near[0] in self._table else COMMANDS[near[0]]}'?"
        raise click.UsageError(f"no command '{name}'{hint}", ctx)

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except click.NoSuchOption as error:
            self._explain(error)

    def _explain(self, error: click.NoSuchOption) -> NoReturn:
        """Raise the error with a hint: of a written list, a near option, or another command."""
        ctx, option = error.ctx, error.option_name
        assert ctx is not None
        command = ctx.command.name or ""
        owners = [name for name in self._table if option in self._options_of(ctx, name)]
        hint = OPTIONS.get((command, option))
        if hint is None and owners:
            hint = f"it is an option of {', '.join(owners)}"
        if hint is None and error.possibilities:
            hint = f"did you mean {error.possibilities[0]}?"
        raise click.UsageError(f"no option {option}" + (f"; {hint}" if hint else ""), ctx)

    def _options_of(self, ctx: click.Context, name: str) -> set[str]:
        command = self.get_command(ctx, name)
        assert command is not None
        return {option for parameter in command.params for option in parameter.opts}
