"""What to do next, from a map: frontiers, walls to examine, stand-off poses, the ramp."""
