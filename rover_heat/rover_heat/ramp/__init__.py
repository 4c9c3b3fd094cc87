"""The ramp: where it is, what is kept free of the robot around it, and the climb."""
