"""The oracle: the time that a rover would need that knew the map."""
