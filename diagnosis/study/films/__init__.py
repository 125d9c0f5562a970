"""Solved films in a study: the box of their tables, and the tables' error."""
