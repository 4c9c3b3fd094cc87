"""Worlds: terrain, samples, how they are generated and loaded."""
