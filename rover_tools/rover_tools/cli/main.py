"""The `rover` command line: its subcommands by name."""

from __future__ import annotations

import importlib
import sys

# Imported only when called: each needs other libraries, and start-up time is felt.
COMMANDS = {
    "demo": ("rover_tools.cli.demo", "a whole mission in a small generated canyon, scored"),
    "mission": ("rover_tools.cli.mission", "a mission in the embedded simulator, to its end"),
    "scoreboard": ("rover_tools.scoreboard.main", "many missions without ROS, and their table"),
    "sim": ("rover_simulator.main", "the embedded simulator alone, for any rover server"),
    "replay": ("rover_tools.cli.replay", "play a recorded run through the graph, score the map"),
    "bench": (
        "rover_tools.benchmarks.bench",
        "benchmarks: graph, perception, decision, simulator, tours",
    ),
}


def main() -> int:
    """Run the subcommand named first on the command line."""
    arguments = sys.argv[1:]
    if not arguments or arguments[0] in ("-h", "--help"):
        print(usage())
        return 0
    name, *rest = arguments
    if name not in COMMANDS:
        print(f"rover: no command '{name}'\n\n{usage()}", file=sys.stderr)
        return 2
    module = importlib.import_module(COMMANDS[name][0])
    return module.main(rest)


def usage() -> str:
    lines = [f"  {name:10} {text}" for name, (_, text) in COMMANDS.items()]
    return "usage: rover COMMAND [options]   (rover COMMAND --help)\n\n" + "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
