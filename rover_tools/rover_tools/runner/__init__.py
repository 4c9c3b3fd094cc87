"""Starts the graph as processes and watches it."""
