"""The doors of the program: command line, run folders, report. Computes nothing."""
