"""The `rover` command line: runs, evaluation, scoreboard and benchmarks."""
