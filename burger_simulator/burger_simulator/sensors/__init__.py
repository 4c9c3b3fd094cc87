"""What the robot measures, with the errors of the real sensors."""
