"""Scores maps and missions, in the graph and in one process."""
