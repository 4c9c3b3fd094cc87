"""`rover heat NAME`: the second robot's mission."""
