"""Data of runs as files: names, CSV, NetCDF, and a workbook."""
