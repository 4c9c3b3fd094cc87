"""From rock pixels to rock tracks."""
