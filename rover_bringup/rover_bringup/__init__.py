"""What the launch files start, and with which arguments: plain data, but for `launching`."""
