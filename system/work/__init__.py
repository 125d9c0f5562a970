"""Work in parts: processes, cluster, kept results, sampled points, progress."""
