"""Recordings of the graph in MCAP: written, salvaged, read."""
