"""Cases of a pump gap at one shaft angle or over the turn."""
