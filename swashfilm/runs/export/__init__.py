"""An operating map for other programs: tables for Modelica, MATLAB, Amesim, CSV; a co-simulation unit (FMU)."""
