"""Command line: the parser, and the commands without a run."""
