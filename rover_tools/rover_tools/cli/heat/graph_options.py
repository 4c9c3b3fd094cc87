"""How one heat mission runs in the graph: the options of `demo` and `mission`."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rover_tools.cli.options import (
    F,
    json_option,
    no_dashboard_option,
    no_record_option,
    open_option,
    out_option,
)
from rover_tools.output import print_result, result_folder

if TYPE_CHECKING:
    from burger_simulator.world.maze import Maze
    from rover_tools.evaluation.heat_setup import HeatSetup
    from rover_tools.evaluation.results import Result


@dataclass(frozen=True)
class GraphOptions:
    """What is left behind, and what is shown."""

    no_record: bool
    no_dashboard: bool
    open_page: bool
    out: Path | None
    as_json: bool

    def run(
        self, kind: str, maze: Maze, seed: int, setup: HeatSetup, in_process: bool
    ) -> tuple[Result, Path]:
        """Run the mission and print its result; returns it and its folder, named by its kind."""
        from rover_tools.evaluation.results import summary

        folder = result_folder(kind, self.out)
        result = self._complete(maze, seed, setup, folder, in_process)
        print_result(result, self.as_json, summary(result))
        return result, folder

    def _complete(
        self, maze: Maze, seed: int, setup: HeatSetup, folder: Path, in_process: bool
    ) -> Result:
        if in_process:
            from rover_tools.scoreboard.heat_job import HeatJob
            from rover_tools.scoreboard.heat_run import complete

            return complete(HeatJob(setup, seed, "", maze), folder)
        from rover_tools.runner.heat_mission import run_heat_graph

        return run_heat_graph(
            maze, seed, setup, folder, page=not self.no_dashboard, open_page=self.open_page,
            record=not self.no_record,
        )  # fmt: skip


def graph_options(function: F) -> F:
    """All of them, which reach the function as `graph`, a GraphOptions."""
    declared: tuple[Callable[[Any], Any], ...] = (
        no_record_option, no_dashboard_option, open_option, out_option, json_option,
    )  # fmt: skip
    names = [field.name for field in fields(GraphOptions)]

    @functools.wraps(function)
    def with_options(**given: Any) -> Any:
        graph = GraphOptions(**{name: given.pop(name) for name in names})
        return function(graph=graph, **given)

    decorated: Any = with_options
    for option in reversed(declared):
        decorated = option(decorated)
    return decorated  # type: ignore[no-any-return]
