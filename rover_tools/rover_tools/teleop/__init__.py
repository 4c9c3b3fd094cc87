"""Driving by hand: keys of a terminal, and the velocity that they ask for."""
