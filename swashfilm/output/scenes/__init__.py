"""3D pictures of films between solids, drawn by a process of its own."""
