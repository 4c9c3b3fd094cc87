"""Options that commands share, each declared once; those of worlds are rover_simulator.options."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from rover_common.command_line import Whole
from rover_common.errors import RoverError
from rover_simulator.options import FILE

if TYPE_CHECKING:
    from rover_tools.evaluation.strategy import Strategy

F = TypeVar("F", bound=Callable[..., Any])

SYNTAX = "EXPLORER[+WAY_HOME][@RECIPE], as in tour or frontier+bearing@baseline"
FILE_OR_FOLDER = click.Path(exists=True, path_type=Path)
MOST_SEEDS = 10_000  # in one range; more is a slip of the keyboard

json_option = click.option(
    "--json", "as_json", is_flag=True, help="Print the result as one line of JSON."
)
out_option = click.option(
    "--out", type=click.Path(file_okay=False, path_type=Path), metavar="DIR",
    help="Result folder.  [default: a new one in ./results]",
)  # fmt: skip
params_option = click.option(
    "--params", type=FILE, metavar="YAML", help="Parameters instead of those that ship."
)
no_dashboard_option = click.option(
    "--no-dashboard", is_flag=True, help="Do not serve the live page."
)
truth_option = click.option(
    "--truth", type=FILE, metavar="PNG", help="The true map: 200 x 200, two values."
)
samples_option = click.option(
    "--samples", type=FILE, metavar="CSV", help="True positions of the rocks in view: x,y [m]."
)
no_record_option = click.option(
    "--no-record", is_flag=True, help="Do not record the run: no recording, no report, no video."
)
open_option = click.option(
    "--open", "open_page", is_flag=True, help="Show the live page in a browser."
)

workers_option = click.option(
    "--workers", type=Whole(1, 10_000), metavar="N",
    help="Processes on this machine.  [default: one per core]",
)  # fmt: skip
scheduler_option = click.option(
    "--scheduler", metavar="ADDRESS",
    help="A Dask scheduler that runs already, as tcp://host:8786, instead of processes on this "
    "machine.",
)  # fmt: skip


class SeedsType(click.ParamType):
    """`101-140`, `1,5,9` or `1-3,7` as seeds, each once, in the order given."""

    name = "seeds"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        if not isinstance(value, str):
            return tuple(value)
        seeds: dict[int, None] = {}
        for part in value.split(","):
            first, dash, last = part.strip().partition("-")
            if not first.isdecimal() or (dash and not last.isdecimal()):
                self.fail(f"'{part}' is no seed or range of seeds; write 101-140 or 1,5,9.")
            low, high = int(first), int(last or first)
            if not low <= high < low + MOST_SEEDS:
                self.fail(f"'{part}' is no range from low to high of at most {MOST_SEEDS} seeds.")
            seeds |= dict.fromkeys(range(low, high + 1))
        return tuple(seeds)


class NamesType(click.ParamType):
    """Names separated by commas, each once and each one of the choices."""

    name = "names"

    def __init__(self, choices: Sequence[str]) -> None:
        self._choices = choices

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, ...]:
        names = dict.fromkeys(part.strip() for part in value.split(","))
        for name in names:
            if name not in self._choices:
                self.fail(f"'{name}' is not one of {', '.join(self._choices)}.")
        return tuple(names)


class StrategyType(click.ParamType):
    """A Strategy by its name."""

    name = "strategy"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Strategy:
        from rover_tools.evaluation.strategy import Strategy

        try:
            return Strategy.parse(value)
        except RoverError as error:
            self.fail(f"{error}.")


class WayHomeType(click.ParamType):
    """A value of the parameter `way_home`."""

    name = "way home"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        from rover_tools.evaluation.strategy import Strategy

        try:
            return Strategy().coming_home(value).way_home
        except RoverError as error:
            self.fail(f"{error}.")


class StrategiesType(click.ParamType):
    """Strategies separated by commas, each once, by their shortest names."""

    name = "strategies"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, ...]:
        parse = StrategyType().convert
        return tuple(dict.fromkeys(str(parse(part, param, ctx)) for part in value.split(",")))


way_home_option = click.option(
    "--way-home", type=WayHomeType(), metavar="NAME",
    help="breadcrumbs, shortest_path or bearing, instead of the strategy's.",
)  # fmt: skip


def picture_option(text: str) -> Callable[[F], F]:
    """--out for a command that gives one picture."""
    return click.option(
        "--out", type=click.Path(dir_okay=False, path_type=Path), metavar="PNG", help=text
    )


def strategy_option(default: str) -> Callable[[F], F]:
    """By either name; a default in words, for help."""
    return click.option(
        "--explorer", "--strategy", "strategy", type=StrategyType(), metavar="NAME",
        help=f"{SYNTAX}.  [default: {default}]",
    )  # fmt: skip


def seeds_option(default: str, text: str) -> Callable[[F], F]:
    return click.option(
        "--seeds", type=SeedsType(), default=default, show_default=True, metavar="SEEDS",
        help=f"{text}, as 101-140 or 1,5,9.",
    )  # fmt: skip
