"""Pumps of any size in scale-free closed forms, run through a course of pressure while the oil warms."""
