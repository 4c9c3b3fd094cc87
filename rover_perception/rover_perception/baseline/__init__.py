"""Perception as published programs for this rover do it, to compare with."""
