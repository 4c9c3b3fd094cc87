"""The benchmarks of `rover bench`, declared like the other commands."""
