"""A pump file read and checked: every check has a name."""
