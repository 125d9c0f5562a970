"""The errors of every function: faults of the input, and solutions that do not converge."""

from reynolds.errors import NotConverged as NotConverged
from system.inputs.faults import InputFaults as InputFaults
