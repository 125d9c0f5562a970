"""Front door: each command as a function that returns its result.

Arguments are those of the command line (`swashfilm COMMAND --help`): text with a unit ("350 bar") or a number in
SI; pressures are gauge. InputFaults lists every fault of the input.
"""
