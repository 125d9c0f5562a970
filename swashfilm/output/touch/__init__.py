"""Figures of a page that the reader can touch: hover, zoom, units, choices, views that turn."""
