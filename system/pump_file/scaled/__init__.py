"""Pumps of which little is known: the rest is that of REF90, scaled."""
