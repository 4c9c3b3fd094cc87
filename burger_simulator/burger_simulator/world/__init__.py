"""Mazes: what stands where, drawn from a seed."""
