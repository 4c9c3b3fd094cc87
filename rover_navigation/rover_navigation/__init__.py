"""Where to go and how to get there, without ROS: the part that both missions share."""
