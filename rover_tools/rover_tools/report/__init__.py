"""What a mission leaves behind to look at: its track over time, a page, a video."""
