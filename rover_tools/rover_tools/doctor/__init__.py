"""Finds mistakes in the set-up of this machine and of the running graph."""
