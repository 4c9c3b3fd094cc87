"""Turns camera frames and poses into a world map, polar arrays and rock positions."""
