"""3D pictures, drawn in a process of their own."""
