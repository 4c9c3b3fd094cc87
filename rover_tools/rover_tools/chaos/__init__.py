"""Faults that come while a mission runs, and what the mission loses by them."""
