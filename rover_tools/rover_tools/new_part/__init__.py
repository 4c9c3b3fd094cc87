"""Skeletons of parts that a package of its own adds to the rover."""
