"""Port opening areas and orifice laws."""
