"""From segmented ground to maps and scans."""
