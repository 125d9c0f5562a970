"""Data of runs as files: CSV, NetCDF, and a workbook."""
