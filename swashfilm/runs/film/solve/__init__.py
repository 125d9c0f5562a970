"""A film case solved: free, loaded, in time, gap of a pump."""
