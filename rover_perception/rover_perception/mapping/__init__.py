"""From classified ground to maps and scans."""
