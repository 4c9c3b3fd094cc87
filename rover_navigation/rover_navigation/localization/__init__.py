"""Where the robot is, and the map that it makes: laser scans matched to an occupancy grid."""
