"""The maze and the robot as a model of MuJoCo."""
