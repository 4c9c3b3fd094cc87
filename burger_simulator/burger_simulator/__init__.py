"""The second robot in its maze: physics, sensors, and the node that speaks for them."""
