"""Pumps with few known values: the others are those of REF90, scaled."""
