"""The rover as an environment of Gymnasium: import this, and make "Rover-v0"."""

import gymnasium

ID = "Rover-v0"

if ID not in gymnasium.registry:
    gymnasium.register(ID, entry_point="rover_tools.gym.rover_env:RoverEnv")
