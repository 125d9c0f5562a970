"""The rotating group as bodies and joints: forces between all parts, and the swash plate in motion."""
