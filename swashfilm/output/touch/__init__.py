"""Interactive figures of a page: hover, zoom, units, choices, rotating views."""
