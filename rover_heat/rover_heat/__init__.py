"""The heat mission: find what is warm, deliver a payload to each, climb the ramp."""
