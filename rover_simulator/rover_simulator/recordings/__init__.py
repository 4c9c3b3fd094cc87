"""Recorded runs: written, read, played."""
