"""Stands in for the Unity simulator on its own wire protocol: embedded worlds and recorded runs."""
