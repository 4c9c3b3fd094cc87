"""Names that people type for something that is called otherwise."""

from __future__ import annotations

# Command: what it is called here
COMMANDS = {
    "fly": "mission",
    "start": "mission",
    "launch": "mission",
    "faults": "chaos",
    "worldmap": "map",
    "stages": "explain",
    "show": "explain",
    "benchmark": "bench",
    "benchmarks": "bench",
    "perception": "bench perception",
    "decision": "bench decision",
    "graph": "bench graph",
    "tours": "bench tours",
    "simulate": "sim",
    "simulator": "sim",
    "play": "replay",
    "playback": "replay",
    "score": "scoreboard",
    "scores": "scoreboard",
    "evaluate": "scoreboard",
    "teleop": "drive",
    "keyboard": "drive",
    "create": "new",
    "init": "new",
    "tests": "test",
    "pytest": "test",
    "exec": "run",
    "bash": "shell",
    "install": "build",
    "setup": "build",
    "check": "doctor",
    "completions": "completion",
    "help": "--help",
}

MANY = "one mission has one {0}; for many, use scoreboard {1}"

# Command and option: what to write instead
OPTIONS = {
    ("mission", "--worlds"): MANY.format("world", "--worlds 1-4"),
    ("mission", "--seeds"): MANY.format("seed", "--worlds 1-4, or --map PNG --seeds 1-4"),
    ("mission", "--strategies"): MANY.format("strategy", "--strategies tour,frontier"),
    ("demo", "--worlds"): MANY.format("world", "--worlds 1-4"),
    ("scoreboard", "--seed"): "write --worlds N, or --map PNG --seeds N",
    ("scoreboard", "--world"): "write --worlds N for generated canyons, or --map PNG",
    ("scoreboard", "--strategy"): "write --strategies NAMES",
    ("scoreboard", "--explorer"): "write --strategies NAMES",
    ("scoreboard", "--params"): "the missions of a table have the default parameters; use mission",
    ("replay", "--recording"): "write it alone: replay RUN",
    ("replay", "--map"): "write --truth PNG for the true map",
    ("sim", "--speed"): "write --rate N",
    ("decision", "--seed"): "write --seeds N",
    ("perception", "--seed"): "write --seeds N",
    ("tours", "--seed"): "write --seeds N",
    ("tours", "--driver"): "write --drivers NAMES",
}
