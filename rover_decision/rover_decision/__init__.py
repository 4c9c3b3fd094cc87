"""The mission's state machine: explore, collect the rocks, come home."""
