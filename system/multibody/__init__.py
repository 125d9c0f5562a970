"""The rotating group as bodies and joints: forces between all parts."""
