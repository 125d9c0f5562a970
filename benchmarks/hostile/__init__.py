"""Hostile input: mutated files of every kind that the program reads, and the outcome of each."""
