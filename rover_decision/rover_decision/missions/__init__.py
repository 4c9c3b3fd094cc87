"""The missions: what each robot is to do."""
