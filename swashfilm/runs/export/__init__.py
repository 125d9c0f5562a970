"""An operating map as tables of other programs: Modelica, MATLAB, Amesim, CSV."""
