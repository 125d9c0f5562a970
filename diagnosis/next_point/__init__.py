"""The next operating point to record: operating box, forecast, choice."""
