"""How one mission runs in the graph: the options of `demo` and `mission`, declared once."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rover_simulator.options import WorldOptions, fps_option, time_limit_option
from rover_tools.cli.options import (
    F,
    json_option,
    no_dashboard_option,
    no_record_option,
    open_option,
    out_option,
    params_option,
    strategy_option,
    way_home_option,
)
from rover_tools.output import note, print_result, result_folder

if TYPE_CHECKING:
    from rover_tools.evaluation.results import Result
    from rover_tools.evaluation.strategy import Strategy


@dataclass(frozen=True)
class MissionOptions:
    """What is driven by, for how long, and what is left behind."""

    strategy: Strategy | None  # that of the parameters
    way_home: str | None  # the strategy's
    fps: float
    time_limit: float  # [s] simulated
    params: Path | None
    no_record: bool
    no_dashboard: bool
    open_page: bool
    out: Path | None
    as_json: bool

    def chosen_strategy(self) -> Strategy:
        """Raises ParametersError."""
        from rover_tools.evaluation.strategy import Strategy
        from rover_tools.runner.graph import default_parameters

        of_file = Strategy.of_parameters(self.params or default_parameters())
        chosen = self.strategy or of_file
        return chosen.coming_home(self.way_home)

    def run(self, kind: str, world: WorldOptions) -> tuple[Result, Path]:
        """Run the mission and print its result; returns it and its folder, named by its kind."""
        from rover_tools.evaluation.results import summary
        from rover_tools.runner.mission import run_mission
        from rover_tools.runner.mission_state import STATE

        loaded, strategy = world.load(), self.chosen_strategy()
        folder = result_folder(kind, self.out)
        try:
            result = run_mission(
                loaded, world.seed, self.time_limit, folder, parameters=self.params,
                strategy=strategy, fps=self.fps, page=not self.no_dashboard,
                open_page=self.open_page, record=not self.no_record,
            )  # fmt: skip
        except BaseException:
            if (folder / STATE).exists():
                note(f"interrupted; go on with: ./rover mission --resume {folder}")
            raise
        print_result(result, self.as_json, summary(result))
        return result, folder

    def resume(self, folder: Path) -> Result:
        """Go on with the mission that was interrupted there, as it was started.

        Raises ResumeError, TruthError or WorldError.
        """
        from rover_simulator.world.world import World
        from rover_tools.evaluation.results import summary
        from rover_tools.runner.mission import run_mission
        from rover_tools.runner.mission_state import begun

        setup = begun(folder)
        result = run_mission(
            World.load(folder / "world"), setup.seed, setup.time_limit, folder,
            parameters=setup.parameters_file, strategy=setup.strategy, fps=setup.fps,
            page=not self.no_dashboard, open_page=self.open_page, record=not self.no_record,
            resume=True,
        )  # fmt: skip
        print_result(result, self.as_json, summary(result))
        return result


def mission_options(time_limit: float) -> Callable[[F], F]:
    """All of them, which reach the function as `options`, a MissionOptions."""
    declared = (
        strategy_option("that of the parameters"), way_home_option, fps_option(),
        time_limit_option(time_limit, "Give up after this simulated time [s]."), params_option,
        no_record_option, no_dashboard_option, open_option, out_option, json_option,
    )  # fmt: skip
    names = [field.name for field in fields(MissionOptions)]

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def with_options(**given: Any) -> Any:
            options = MissionOptions(**{name: given.pop(name) for name in names})
            return function(options=options, **given)

        decorated: Any = with_options
        for option in reversed(declared):
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return decorate
