"""Solution of a film case: free, loaded, in time, gap of a pump."""
