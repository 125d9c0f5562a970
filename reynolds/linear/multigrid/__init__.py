"""Semicoarsening multigrid on logically rectangular meshes."""
