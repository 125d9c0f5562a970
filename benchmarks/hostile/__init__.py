"""Hostile input: mutated files of every kind that the program reads, and what each comes to."""
