"""Where to go: the map, what is left to see on it, and the quickest tour over it. No ROS here."""
