"""What frames, plans, maps and the simulator cost, and how good they are."""
