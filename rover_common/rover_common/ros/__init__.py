"""What the nodes share: the only part of this package that knows ROS."""
