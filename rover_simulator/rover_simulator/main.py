"""`rover sim`: the embedded simulator, a client that any rover server can be driven by."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from rover_common.command_line import Real, Whole, run_command
from rover_simulator.options import WorldOptions, fps_option, time_limit_option, world_options

FAST = "fast"  # as the server answers
REALTIME = "realtime"


class Rate(click.ParamType):
    """Frames by the clock at a multiple of real time, or `fast`: None."""

    name = "rate"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | None:
        if value == FAST:
            return None
        try:
            rate = 1.0 if value == REALTIME else float(value)
        except ValueError:
            rate = math.nan
        if not (math.isfinite(rate) and rate > 0.0):
            self.fail(f"{value} is neither realtime nor fast nor a number above 0.", param, ctx)
        return rate


@click.command("sim", context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--host", default="127.0.0.1", show_default=True, help="Host of the server.")
@click.option("--port", type=Whole(1, 65535), default=4567, show_default=True,
              metavar="N", help="Of the server.")  # fmt: skip
@world_options
@click.option("--rate", type=Rate(), default=REALTIME, show_default=True, metavar="RATE",
              help="realtime, fast (as the server answers), or N times real time.")  # fmt: skip
@fps_option()
@time_limit_option(None, "End when the simulated time, which begins at 1 s, reaches this [s].")
@click.option("--dead-man", type=Real(0.0, 60.0), default=0.5, show_default=True, metavar="S",
              help="Brake after this simulated time without a command [s]; 0 never, as the "
              "original.")  # fmt: skip
@click.option("--save-insets", "insets", metavar="DIR",
              type=click.Path(file_okay=False, path_type=Path),
              help="Save the insets that the server sends, and the screen with them.")  # fmt: skip
@click.option("--state", metavar="FILE", type=click.Path(dir_okay=False, path_type=Path),
              help="Go on from this file, if it is there, and keep it up to date.")  # fmt: skip
@click.option("--progress", is_flag=True, help="Print a JSON line per simulated second.")
def command(
    host: str,
    port: int,
    world: WorldOptions,
    rate: float | None,
    fps: float,
    time_limit: float | None,
    dead_man: float,
    progress: bool,
    insets: Path | None,
    state: Path | None,
) -> None:
    """Run the embedded simulator alone, as a client of any rover server.

    It connects to the server on HOST:PORT, and again whenever the connection is lost, until it is
    stopped. SIGINT and SIGTERM are its usual end: the exit code is 0 then.

    \b
    Examples:
      ./rover sim --seed 3
      ./rover sim --rate fast --time-limit 600
      ./rover sim --save-insets insets
    """
    # Imported here: the renderer takes a second, which help and completion do not need.
    from rover_simulator.run import simulate

    simulate(
        world.load(), world.seed, host=host, port=port, rate=rate, fps=fps,
        time_limit=math.inf if time_limit is None else time_limit, dead_man=dead_man,
        progress=progress, insets=insets, state=state,
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Returns the exit code."""
    return run_command(command, "rover sim", sys.argv[1:] if arguments is None else arguments)


if __name__ == "__main__":
    sys.exit(main())
