"""Breaks in the order of a recording: another unit or another pump from one row on."""
