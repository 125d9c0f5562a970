"""The pump as its file describes it."""
