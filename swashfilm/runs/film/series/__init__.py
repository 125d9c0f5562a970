"""A study: a series of film cases."""
