"""Run folder, figures, 3D pictures, field maps, page templates."""
